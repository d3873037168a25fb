#include "run/kept_caster.h"

#include <fmt/format.h>

#include "base/memory_need.h"

namespace quasimc {

std::shared_ptr<const RayCaster> KeptCaster::caster_for(
    const Scene& scene, Engine engine, const std::stop_token& stop) {
    const auto triangles = data_of(scene).geometry;
    const bool same = caster_ && engine == engine_ && scene.cell() == cell_ &&
                      (triangles == triangles_ || *triangles == *triangles_);
    if (!same) {
        forget();  // before as much is taken again

        constexpr double kBytesOfTriangle = 150;  // docs/develop/architecture.md
        caster_ = make_big(
            fmt::format("the ray caster of {} triangles", triangles->size()),
            kBytesOfTriangle * static_cast<double>(triangles->size()), [&] {
                return std::make_shared<const RayCaster>(triangles, scene.cell(), engine, stop);
            });
        cell_ = scene.cell();
        engine_ = engine;
        ++builds_;
    }
    triangles_ = triangles;
    return caster_;
}

void KeptCaster::forget() {
    caster_.reset();
    triangles_.reset();
}

}  // namespace quasimc
