#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "coupling/lighting.h"
#include "coupling/plant_scene.h"
#include "coupling/protocol/session.h"
#include "coupling/step_light.h"
#include "coupling/vlab/organ_shapes.h"
#include "coupling/vlab/specification.h"
#include "run/simulator.h"

namespace quasimc {

/// Computes the answers to the queries of a plant, step after step, by its specification.
class PlantLight {
  public:
    /// @param notices  outlives the object
    PlantLight(Specification spec, Notices& notices);
    PlantLight(const PlantLight&) = delete;
    PlantLight& operator=(const PlantLight&) = delete;
    ~PlantLight() = default;

    /// Computes the light on the organs of a step and answers its queries, in their order. Settings
    /// among them (Q, J) apply from this step on and have no answer. Writes the output files of the
    /// specification.
    /// @param check  called repeatedly during the computation; an exception of it ends the
    /// computation
    void answer(const Pass& pass, const std::function<void()>& check, Answers& answers);

    /// Reports, once, that no light reached the plant in the last step, if that is so.
    void report_if_unlit();

    /// The light of the last step; a shared copy stays valid after the next step.
    [[nodiscard]] const StepLight& last() const { return *light_; }
    [[nodiscard]] std::shared_ptr<const StepLight> shared_last() const { return light_; }
    /// The sources of the last step.
    [[nodiscard]] const Lighting& lighting() const { return lighting_; }
    [[nodiscard]] const Specification& specification() const { return spec_; }
    /// Number of acceleration structures built.
    [[nodiscard]] std::size_t builds() const { return simulator_.builds(); }

    /// Sets the number of the next step, counted from 0; its seed and file names follow from it.
    /// Steps that could not be read or answered count too.
    void set_step(std::uint64_t step) { steps_ = step; }

  private:
    void apply_settings(const Pass& pass);
    void set_day(std::span<const double> parameters);
    void set_rays(std::span<const double> parameters);
    [[nodiscard]] bool is_sensor(const Query& query) const {
        return query.asks && spec_.sensor_half_angle_deg.has_value();
    }
    [[nodiscard]] bool is_dark() const;
    /// Whether the light of a shape is requested or shown.
    [[nodiscard]] bool anything_is_measured(
        const Pass& pass, std::span<const PlacedShape> shapes) const;

    [[nodiscard]] std::vector<PlacedShape> position_shapes(const Pass& pass);
    /// Reports the warnings of lint() for a computed step, each check once.
    void report_warnings();
    [[nodiscard]] StepLight trace(
        const Pass& pass,
        std::span<const PlacedShape> shapes,
        Simulator& simulator,
        const std::function<void()>& check);
    /// Light on the sensors alone, without organs.
    [[nodiscard]] StepLight trace_unshaded(
        const Pass& pass,
        const std::vector<PlacedShape>& shapes,
        const std::function<void()>& check);
    void fill(const Query& query, std::uint32_t index, std::vector<double>& values) const;
    /// The quantity that the return type of a band names. @param index  of the query
    [[nodiscard]] Estimate returned(
        const Query& query, std::uint32_t index, std::size_t band) const;
    [[nodiscard]] Estimate of_sensor(std::uint32_t index, ReturnType type, std::size_t band) const;
    [[nodiscard]] Estimate of_organ(std::uint32_t index, ReturnType type, std::size_t band) const;
    void write_files(const Pass& pass) const;

    Specification spec_;
    Notices& notices_;
    OrganShapes shapes_;
    std::optional<SkyOfDay> sky_;
    Lighting lighting_;
    Simulator simulator_, unshaded_simulator_;
    std::shared_ptr<const StepLight> light_ = std::make_shared<StepLight>();
    StepLight unshaded_;
    std::uint64_t steps_ = 0;  ///< number of the next step
};

}  // namespace quasimc
