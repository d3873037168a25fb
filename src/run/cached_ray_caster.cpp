#include "run/cached_ray_caster.h"

#include <fmt/format.h>

#include "base/memory_need.h"

namespace quasimc {

std::shared_ptr<const RayCaster> CachedRayCaster::caster_for(
    const Scene& scene, Accelerator accelerator, const std::stop_token& stop) {
    const auto triangles = data_of(scene).geometry;
    const bool same = caster_ && accelerator == accelerator_ && scene.cell() == cell_ &&
                      (triangles == triangles_ || *triangles == *triangles_);
    if (!same) {
        forget();  // releases the old one before the new one is allocated

        constexpr double kBytesOfTriangle = 150;  // docs/develop/architecture.md
        caster_ = make_big(
            fmt::format("the ray caster of {} triangles", triangles->size()),
            kBytesOfTriangle * static_cast<double>(triangles->size()), [&] {
                return std::make_shared<const RayCaster>(
                    triangles, scene.cell(), accelerator, stop);
            });
        cell_ = scene.cell();
        accelerator_ = accelerator;
        ++builds_;
    }
    triangles_ = triangles;
    return caster_;
}

void CachedRayCaster::forget() {
    caster_.reset();
    triangles_.reset();
}

}  // namespace quasimc
