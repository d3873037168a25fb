#pragma once

#include <array>

#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "solvers/ray_bundles/suits_bundles.h"

namespace quasimc::bench {

inline constexpr std::array kMethods{
    Method::light_tracing, Method::first_hits, Method::from_organs, Method::ray_bundles};
inline constexpr std::array kMethodNames{
    "light_tracing", "first_hits", "from_organs", "ray_bundles"};

inline bool can_run(Method method, const Scene& scene) {
    return method != Method::ray_bundles || is_diffuse(scene);
}

}  // namespace quasimc::bench
