#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "growth/environment.h"
#include "growth/turtle/mesh_drawing.h"
#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Sources of a stand, and the options of the computation of their light.
struct StandLight {
    Sources sources;
    RunSpec spec;
};

/// Light for a plant that grows in a stand: in a pass all shapes that the plant draws are organs,
/// one for each module of the string. The answer to a query is the light on the organ of the module
/// that follows it, one value for each band; without shapes of that module the query keeps its
/// values. As for the program QuasiMC, queries without parameters, and those with a negative first
/// one, have no answer.
///
/// The plant is upright in the stand: its axes are permuted as those of files with y up. Its
/// lengths have the stand's unit. Organs are named and labelled as by plant_organs(); they follow
/// those of the stand, and so do their ids.
class LightOnStand final : public PlantEnvironment {
  public:
    /// Returns the light for the scene of the first pass, after it was built.
    using LightOfScene = std::function<StandLight(const Scene& scene)>;

    struct Options {
        /// Names of materials by the symbols of modules. For other modules it is the material whose
        /// name is the symbol, if there is one, or else the default material.
        std::map<char, std::string> materials = {};
        std::string default_material = {};  ///< "": the first one of the stand
        /// The answer to queries.
        Quantity quantity = Quantity::absorbed_flux_density;
        int sides = 8;  ///< sides of cylinders, spheres and discs
        /// Makes the listeners and the means to stop for the run of a pass.
        std::function<RunControl()> control = [] { return RunControl{}; };
    };

    /// @param stand  bands, materials, ground, cell and constant organs
    /// @param light  called once; it may throw InputError, which ends the pass. The seed of a pass
    ///        is the given seed plus the number of steps
    /// @throws InputError  if the stand has no materials, or not the ones that are named
    LightOnStand(SceneBuilder stand, LightOfScene light, Options options);
    /// The same with light that does not depend on the scene.
    LightOnStand(SceneBuilder stand, StandLight light, Options options);

    Drawing* drawing() override { return &drawing_; }
    Drawing* query(const PlantQuery& query) override;
    /// Computes the light of a pass, unless the plant has no shapes.
    /// @throws InputError  for errors of the scene or the light
    /// @throws Stopped  if it is stopped
    [[nodiscard]] std::vector<PlantAnswer> answers(std::int64_t step) override;

    /// The scene of the last pass; null if the plant had no shapes, or before the first pass.
    [[nodiscard]] const std::shared_ptr<const Scene>& scene() const { return scene_; }
    /// The light of scene(); null without one.
    [[nodiscard]] const std::shared_ptr<const Result>& result() const { return result_; }
    /// The number of organs of the plant in scene(), the last ones before the ground.
    [[nodiscard]] std::size_t organs_of_plant() const { return organs_.size(); }
    /// Steps before the last pass; negative before the first one.
    [[nodiscard]] std::int64_t pass_step() const { return pass_step_; }
    /// The indices in scene() of the organs that the last pass queried, in the order of the
    /// queries; nothing for those without shapes.
    [[nodiscard]] const std::vector<std::optional<std::size_t>>& queried() const {
        return queried_;
    }
    /// The sources and options of runs; empty before the first pass with shapes.
    [[nodiscard]] const std::optional<StandLight>& light() const { return light_; }
    /// The id in scene() of an organ with an id of plant_organs().
    [[nodiscard]] std::int64_t id_of(std::int64_t drawn) const { return drawn + first_id_ - 1; }
    /// Warnings of lint() for scene(). They take time proportional to all triangles.
    [[nodiscard]] std::vector<Warning> warnings();

  private:
    /// A query of a pass.
    struct Asked {
        std::int64_t query = 0;
        std::size_t parameters = 0;
        bool asks = true;
        std::int64_t organ = 0;  ///< id
    };

    [[nodiscard]] std::vector<OrganSpec> organs_of_pass(std::int64_t step);
    [[nodiscard]] const std::string& material_of(char symbol) const;
    /// Replaces the organs of the session.
    void set_organs(std::vector<OrganSpec> organs);
    void compute(std::int64_t step);
    [[nodiscard]] PlantAnswer answer_to(const Asked& asked, std::size_t organ) const;

    LightOfScene light_of_scene_;
    Options options_;
    std::vector<std::string> material_names_;
    bool is_z_up_ = true;
    std::int64_t first_id_ = 1;  // of the plant's organs
    GrowthSession session_;
    std::optional<StandLight> light_;
    MeshDrawing drawing_;
    std::vector<Asked> asked_;          // in the current pass
    std::vector<std::int64_t> organs_;  // ids in the session
    std::vector<std::optional<std::size_t>> queried_;
    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const Result> result_;
    std::int64_t pass_step_ = -1;
};

}  // namespace quasimc
