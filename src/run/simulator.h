#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/cast/ray_caster.h"
#include "run/run.h"
#include "samplers/sampler.h"
#include "sums/sums.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Runs one after the other, as growth or the hours of a day ask for: keeps what the next run can
/// use again. The acceleration structure serves as long as triangles, cell and engine stay the same
/// (whatever happens to optics, sources or the specification), the samplers' tables always. A
/// result is bit for bit that of quasimc::run.
class Simulator {
  public:
    /// As quasimc::run. Not for several threads at a time.
    /// @throws InputError  for a specification that can't be run: every fault at once
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const std::function<void(const Progress&)>& on_progress = {});

    /// The sums of one round of RunSpec::paths, as a value: they can be saved, added to those of
    /// other rounds of the same run, and evaluated (results/evaluate.h). Their digest is set.
    /// Targets and budgets of time or paths are left alone.
    /// @param first  the round's first path: a multiple of the paths; of a point set whose rounds
    ///        are powers of two 0, or as many as the paths
    /// @throws InputError  as run() does
    [[nodiscard]] Sums sums(
        const Scene& scene, const Sources& sources, const RunSpec& spec, std::uint64_t first = 0);

    /// How often an acceleration structure had to be built.
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
