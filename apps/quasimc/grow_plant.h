#pragma once

#include <cstdint>
#include <memory>

#include "grow_environment.h"
#include "growth/plant.h"
#include "growth/turtle/mesh_drawing.h"
#include "quasimc/scene.h"

/// A plant after a step, drawn when its shapes are first requested.
class GrownPlant {
  public:
    /// All outlive the object; the plant does not grow during its life.
    /// @param environment  may be null
    GrownPlant(quasimc::Plant& plant, const quasimc::View& view, const GrowEnvironment* environment)
        : plant_(&plant), view_(&view), environment_(environment) {}

    [[nodiscard]] quasimc::Plant& plant() const { return *plant_; }
    [[nodiscard]] const quasimc::View& view() const { return *view_; }
    [[nodiscard]] std::int64_t step() const { return plant_->step(); }
    /// The string, or its homomorphic image.
    [[nodiscard]] quasimc::ModuleString string(bool with_homomorphism) const;
    /// Bounds of the plant: those of the view file, if it has some.
    [[nodiscard]] quasimc::Bounds bounds();
    /// The shapes; null if no module has any.
    /// @throws InputError  for invalid coordinates
    [[nodiscard]] const std::shared_ptr<const quasimc::Scene>& scene();
    [[nodiscard]] bool is_drawn() const { return is_drawn_; }
    /// The environment with the light of the last pass, or null: no light is known.
    [[nodiscard]] const GrowEnvironment* lit() const {
        return environment_ != nullptr && environment_->has_light() ? environment_ : nullptr;
    }
    /// Whether the last pass was over this string, so that its light belongs to the shapes.
    [[nodiscard]] bool has_own_light() const {
        return lit() != nullptr && environment_->pass_step() == step();
    }

  private:
    quasimc::Plant* plant_;
    const quasimc::View* view_;
    const GrowEnvironment* environment_;
    bool is_drawn_ = false;
    std::shared_ptr<const quasimc::Scene> scene_;
};
