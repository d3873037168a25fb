#include "run/simulator.h"

#include "samplers/catalogue.h"

namespace quasimc {

std::shared_ptr<const RayCaster> Simulator::caster_for(const Scene& scene, Engine engine) {
    const auto triangles = scene.shared_triangles();
    const bool same = caster_ && engine == engine_ && scene.cell() == cell_ &&
                      (triangles == triangles_ || *triangles == *triangles_);
    if (!same) {
        caster_.reset();  // their memory first
        triangles_.reset();
        caster_ = std::make_shared<const RayCaster>(triangles, scene.cell(), engine);
        cell_ = scene.cell();
        engine_ = engine;
        ++builds_;
    }
    triangles_ = triangles;
    return caster_;
}

const Sampler& Simulator::sampler_for(const std::string& name) {
    std::unique_ptr<Sampler>& sampler = samplers_[name];
    if (!sampler) {
        sampler = make_sampler(name);
    }
    return *sampler;
}

}  // namespace quasimc
