#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "geometry/cast/ray_caster.h"
#include "quasimc/run.h"
#include "samplers/sampler.h"
#include "scene/scene.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// What a Simulator keeps from run to run, and what it does with it.
class Simulator::State {
  public:
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const std::function<void(const Progress&)>& on_progress);
    [[nodiscard]] Sums sums(
        const Scene& scene, const Sources& sources, const RunSpec& spec, std::uint64_t first);
    [[nodiscard]] std::size_t builds() const { return builds_; }

  private:
    /// Traces a specification that was checked and planned.
    [[nodiscard]] Result trace(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const std::function<void(const Progress&)>& on_progress);
    [[nodiscard]] PreparedScene prepare(
        const Scene& scene, const Sources& sources, const RunSpec& spec);
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(const Scene& scene, Engine engine);
    [[nodiscard]] const Sampler& sampler_for(const std::string& name);

    std::shared_ptr<const RayCaster> caster_;
    std::shared_ptr<const SceneGeometry> triangles_;  // of caster_, with cell and engine:
    Cell cell_;
    Engine engine_ = Engine::embree;
    std::map<std::string, std::unique_ptr<Sampler>> samplers_;
    std::size_t builds_ = 0;
};

}  // namespace quasimc
