#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "coupling/environment.h"
#include "grow_flags.h"
#include "growth/environment.h"
#include "show_values.h"

namespace quasimc {
class LightInProcess;  // coupling/plants/light_in_process.h
class LightOnStand;    // coupling/plants/light_on_stand.h
}  // namespace quasimc

/// The environment of a plant on the command line: light in this process, or a program. It records
/// which modules asked in the last pass.
class GrowEnvironment final : public quasimc::PlantEnvironment {
  public:
    /// @param arguments  with --light or --environment
    /// @param notices  outlives the object
    /// @param stop  ends the computation of light
    /// @param sides  of cylinders, spheres and discs that a run file lights
    /// @throws InputError  for errors in its file
    GrowEnvironment(
        const GrowArguments& arguments,
        quasimc::Notices& notices,
        const std::stop_token& stop,
        int sides);
    ~GrowEnvironment() override;
    GrowEnvironment(const GrowEnvironment&) = delete;
    GrowEnvironment& operator=(const GrowEnvironment&) = delete;

    quasimc::Drawing* drawing() override { return inner_->drawing(); }
    quasimc::Drawing* query(const quasimc::PlantQuery& query) override;
    /// @throws Stopped  after a stop
    [[nodiscard]] std::vector<quasimc::PlantAnswer> answers(std::int64_t step) override;

    /// Whether light of a pass is known: not with a program, nor before the first pass.
    [[nodiscard]] bool has_light() const {
        return pass_step_ >= 0 && (light_ != nullptr || stand_ != nullptr);
    }
    /// Whether the plant grows in a stand: all its shapes have light.
    [[nodiscard]] bool has_stand() const { return stand_ != nullptr; }
    /// The light of the last pass; has_light() must be true.
    [[nodiscard]] quasimc::StepSnapshot light() const;
    /// Derivation steps before the last pass with queries; negative before the first one.
    [[nodiscard]] std::int64_t pass_step() const { return pass_step_; }
    /// Files that the specification names.
    [[nodiscard]] const std::vector<quasimc::InputFile>& inputs() const { return inputs_; }
    /// Whether the program could not be started, or the light of a pass not be computed.
    [[nodiscard]] bool has_failed() const;
    /// For every organ of a drawn plant the index of its light in StepLight::scene: that of the
    /// query before its module; or quasimc::kNoOrgan.
    /// @param drawn  of the string of the last pass, whose light is known
    [[nodiscard]] std::vector<std::uint32_t> light_of(const quasimc::Scene& drawn) const;

  private:
    /// A query of a pass: its module, and the symbol of the next one.
    struct Asked {
        std::size_t module = 0;
        std::string following = {};
    };

    /// The light of a stand as that of a specification.
    struct StandStep {
        quasimc::Specification specification;  ///< bands alone
        quasimc::Lighting lighting;
        std::shared_ptr<const quasimc::StepLight> light;
    };

    void add_specification(
        const std::string& file, quasimc::Notices& notices, const std::stop_token& stop);
    /// Records the light of a pass of stand_.
    void note_stand(std::int64_t step);

    std::unique_ptr<quasimc::PlantEnvironment> inner_;
    const quasimc::LightInProcess* light_ = nullptr;  // inner_, with a specification
    const quasimc::LightOnStand* stand_ = nullptr;    // inner_, with a run file
    StandStep stand_step_;                            // with a run file
    std::vector<Asked> asked_;                        // in the current pass
    std::vector<Asked> answered_;                     // in the last pass with queries
    std::int64_t pass_step_ = -1;
    std::vector<quasimc::InputFile> inputs_;
    quasimc::Notices& notices_;
    bool has_started_ = true;  // the program, if there is one
};

/// The numbers of light, for every quantity and band.
/// @param organs  indices in StepLight::scene; NaN for kNoOrgan
[[nodiscard]] std::vector<ShownValues> light_values(
    const quasimc::StepSnapshot& light, std::span<const std::uint32_t> organs);
