// Compiled once for each vector unit: foreach_target.h includes this file repeatedly.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/draw_span.cpp"
#include "raster/draw_span.h"

#include <bit>

#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quasimc {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Draws with all lanes: spans are too short for a branch per pixel or a call. A product and a sum
/// are used, not MulAdd, which rounds differently on machines with a fused one.
struct Pencil {
    using Floats = hn::CappedTag<float, kSpanLanes>;
    using Ints = hn::RebindToSigned<Floats>;
    static constexpr Floats kFloats{};
    static constexpr Ints kInts{};

    hn::Vec<Floats> slope;
    hn::Vec<Ints> id;

    Pencil(float step, std::int32_t drawn)
        : slope(hn::Set(kFloats, step)), id(hn::Set(kInts, drawn)) {}

    void draw(float* depths, std::int32_t* ids, std::int32_t count, float z) const {
        const auto lanes = static_cast<std::int32_t>(hn::Lanes(kFloats));
        const auto start = hn::Set(kFloats, z);
        const auto end = hn::Set(kInts, count);
        auto pixel = hn::Iota(kInts, 0);
        for (std::int32_t i = 0; i < count; i += lanes) {
            const auto depth = hn::Add(start, hn::Mul(slope, hn::ConvertTo(kFloats, pixel)));
            const auto seen = hn::LoadU(kFloats, depths + i);
            const auto ids_seen = hn::LoadU(kInts, ids + i);
            const auto is_first =
                hn::And(hn::Eq(depth, seen), hn::RebindMask(kFloats, hn::Lt(id, ids_seen)));
            const auto nearer = hn::And(
                hn::RebindMask(kFloats, hn::Lt(pixel, end)), hn::Or(hn::Lt(depth, seen), is_first));
            hn::StoreU(hn::IfThenElse(nearer, depth, seen), kFloats, depths + i);
            hn::StoreU(hn::IfThenElse(hn::RebindMask(kInts, nearer), id, ids_seen), kInts, ids + i);
            pixel = hn::Add(pixel, hn::Set(kInts, lanes));
        }
    }
};

/// Begin, length and first depth of each row of a block.
struct RowStarts {
    alignas(64) std::int32_t pixels[BlockSpans::kMost];
    alignas(64) std::int32_t counts[BlockSpans::kMost];
    alignas(64) float depths[BlockSpans::kMost];
};

void set_starts(const BlockSpans& spans, std::size_t row, double columns, RowStarts& starts) {
    const hn::CappedTag<double, kBlockLanes> numbers;
    const hn::Rebind<float, decltype(numbers)> floats;
    const hn::Rebind<std::int32_t, decltype(numbers)> words;
    for (std::size_t lane = 0; lane < kBlockLanes; lane += hn::Lanes(numbers)) {
        const std::size_t i = row * kBlockLanes + lane;
        const auto from = [&](const double* of_lanes) {
            return hn::Load(numbers, of_lanes + lane);
        };
        const auto first = hn::Load(numbers, spans.first + i);
        const auto y = hn::Load(numbers, spans.y + i);
        const auto by_x = hn::Mul(hn::Sub(first, from(spans.first_x)), from(spans.depth.by_x));
        const auto by_y = hn::Mul(hn::Sub(y, from(spans.first_y)), from(spans.depth.by_y));
        const auto depth = hn::Add(hn::Add(from(spans.first_depth), by_x), by_y);
        const auto pixel = hn::Add(hn::Mul(hn::Set(numbers, columns), y), first);
        const auto count = hn::Sub(hn::Load(numbers, spans.last + i), first);
        hn::Store(hn::DemoteTo(words, pixel), words, starts.pixels + i);
        hn::Store(hn::DemoteTo(words, count), words, starts.counts + i);
        hn::Store(hn::DemoteTo(floats, depth), floats, starts.depths + i);
    }
}

void draw_rows(const DepthBuffer& to, const BlockSpans& spans, std::int32_t first_id) {
    RowStarts starts;
    for (std::size_t row = 0; row < spans.rows; ++row) {
        set_starts(spans, row, to.columns, starts);
    }
    spans.for_each([&](std::size_t lane, std::size_t i) {
        const Pencil pencil(
            static_cast<float>(spans.depth.by_x[lane]), first_id + static_cast<std::int32_t>(lane));
        const std::int32_t at = starts.pixels[i];
        pencil.draw(to.depths + at, to.ids + at, starts.counts[i], starts.depths[i]);
    });
}

/// Bits of a word.
constexpr std::uint32_t kBits = 64;

/// Bit i is set where ids[i + 1] differs from ids[i].
std::uint64_t changes_of(const std::int32_t* ids) {
    const hn::CappedTag<std::int32_t, 16> words;
    std::uint64_t changes = 0;
    for (std::size_t i = 0; i < kBits; i += hn::Lanes(words)) {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(
            words, hn::Ne(hn::LoadU(words, ids + i), hn::LoadU(words, ids + i + 1)), bits);
        changes |= std::uint64_t{bits[0] | std::uint32_t{bits[1]} << 8U} << i;
    }
    return changes;
}

std::size_t run_ends(const std::int32_t* ids, std::uint32_t count, std::uint32_t* ends) {
    std::uint32_t* end = ends;
    std::uint32_t i = 0;
    for (; i + kBits <= count; i += kBits) {
        for (std::uint64_t left = changes_of(ids + i); left != 0; left &= left - 1) {
            *end++ = i + static_cast<std::uint32_t>(std::countr_zero(left)) + 1;
        }
    }
    for (; i < count; ++i) {
        *end = i + 1;
        end += ids[i] != ids[i + 1] ? 1 : 0;
    }
    return static_cast<std::size_t>(end - ends);
}

DrawLoops variant_of_draw_loops() {
    return {&draw_rows, &run_ends};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quasimc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quasimc {

HWY_EXPORT(variant_of_draw_loops);

DrawLoops best_draw_loops() {
    return HWY_DYNAMIC_DISPATCH(variant_of_draw_loops)();
}

}  // namespace quasimc
#endif
