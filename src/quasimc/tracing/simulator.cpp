#include "quasimc/tracing/simulator.h"

#include "quasimc/samplers/catalogue.h"

namespace quasimc {

std::shared_ptr<const RayCaster> Simulator::caster_for(const Scene& scene, Engine engine) {
    const auto triangles = scene.shared_triangles();
    const bool same = caster_ && engine == engine_ && scene.cell() == cell_ &&
                      (triangles == triangles_ || *triangles == *triangles_);
    if (!same) {
        caster_ = std::make_shared<const RayCaster>(*triangles, scene.cell(), engine);
        cell_ = scene.cell();
        engine_ = engine;
        ++builds_;
    }
    triangles_ = triangles;
    return caster_;
}

const Sampler& Simulator::sampler_for(const std::string& name) {
    if (!sampler_ || name != sampler_name_) {
        sampler_ = make_sampler(name);
        sampler_name_ = name;
    }
    return *sampler_;
}

}  // namespace quasimc
