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

/// All lanes at once: spans are too short to be worth a branch for each pixel, and a call. A
/// product and a sum, not MulAdd, which rounds otherwise on machines that have a fused one.
void draw_spans(
    float* depths,
    std::int32_t* ids,
    std::span<const PixelSpan> spans,
    float step,
    std::int32_t id) {
    const hn::CappedTag<float, kSpanLanes> floats;
    const hn::RebindToSigned<decltype(floats)> words;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(floats));
    const auto slope = hn::Set(floats, step);
    const auto drawn = hn::Set(words, id);
    for (const PixelSpan& span : spans) {
        const auto start = hn::Set(floats, span.z);
        const auto end = hn::Set(words, span.count);
        auto pixel = hn::Iota(words, 0);
        for (std::int32_t i = 0; i < span.count; i += lanes) {
            float* const depths_here = depths + span.first + i;
            std::int32_t* const ids_here = ids + span.first + i;
            const auto depth = hn::Add(start, hn::Mul(slope, hn::ConvertTo(floats, pixel)));
            const auto seen = hn::LoadU(floats, depths_here);
            const auto nearer =
                hn::And(hn::RebindMask(floats, hn::Lt(pixel, end)), hn::Lt(depth, seen));
            hn::StoreU(hn::IfThenElse(nearer, depth, seen), floats, depths_here);
            const auto ids_seen = hn::LoadU(words, ids_here);
            hn::StoreU(
                hn::IfThenElse(hn::RebindMask(words, nearer), drawn, ids_seen), words, ids_here);
            pixel = hn::Add(pixel, hn::Set(words, lanes));
        }
    }
}

DrawSpans* variant_of_draw_spans() {
    return &draw_spans;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quasimc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quasimc {

HWY_EXPORT(variant_of_draw_spans);

DrawSpans* best_draw_spans() {
    return HWY_DYNAMIC_DISPATCH(variant_of_draw_spans)();
}

}  // namespace quasimc
#endif
