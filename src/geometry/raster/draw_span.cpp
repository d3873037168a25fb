// Compiled once for each vector unit: foreach_target.h includes this file again and again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/raster/draw_span.cpp"
#include "geometry/raster/draw_span.h"

#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quasimc {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// All lanes at once: spans are too short to be worth a branch for each pixel. A product and a sum,
/// not MulAdd, which rounds otherwise on machines that have a fused one.
void draw_span(
    float* depths, std::int32_t* ids, std::int32_t count, float z, float step, std::int32_t id) {
    const hn::CappedTag<float, kSpanLanes> floats;
    const hn::RebindToSigned<decltype(floats)> words;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(floats));
    const auto start = hn::Set(floats, z);
    const auto slope = hn::Set(floats, step);
    const auto end = hn::Set(words, count);
    const auto drawn = hn::Set(words, id);
    auto pixel = hn::Iota(words, 0);
    for (std::int32_t first = 0; first < count; first += lanes) {
        const auto depth = hn::Add(start, hn::Mul(slope, hn::ConvertTo(floats, pixel)));
        const auto seen = hn::LoadU(floats, depths + first);
        const auto nearer =
            hn::And(hn::RebindMask(floats, hn::Lt(pixel, end)), hn::Lt(depth, seen));
        hn::StoreU(hn::IfThenElse(nearer, depth, seen), floats, depths + first);
        const auto ids_seen = hn::LoadU(words, ids + first);
        hn::StoreU(
            hn::IfThenElse(hn::RebindMask(words, nearer), drawn, ids_seen), words, ids + first);
        pixel = hn::Add(pixel, hn::Set(words, lanes));
    }
}

DrawSpan* variant_of_draw_span() {
    return &draw_span;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quasimc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quasimc {

HWY_EXPORT(variant_of_draw_span);

DrawSpan* best_draw_span() {
    return HWY_DYNAMIC_DISPATCH(variant_of_draw_span)();
}

}  // namespace quasimc
#endif
