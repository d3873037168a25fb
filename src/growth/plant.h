#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/notices.h"
#include "growth/environment.h"
#include "growth/module_string.h"
#include "growth/plant_model.h"

namespace quasimc {

/// Limits of growth.
struct GrowthLimits {
    std::size_t string_bytes = std::size_t{1} << 30U;  ///< for one string
    std::uint64_t loop_rounds = 100'000'000;           ///< in all loops of a block
    std::size_t open_files = 64;                       ///< at a time
};

struct GrowthOptions {
    std::int64_t steps = -1;  ///< negative: those of the model
    /// Seed of the choice among stochastic productions; by default that of cpfg without a window.
    std::optional<std::uint16_t> seed = {};
    GrowthLimits limits = {};
    /// Base of the names of files that the model opens, below which it may write; by default the
    /// current folder.
    std::string folder = {};
    /// Takes what the model prints; it is dropped by default.
    std::function<void(std::string_view)> print = {};
};

/// A growing plant.
class Plant {
  public:
    /// Runs the block Start and makes the axiom.
    /// @param environment  null: queries have no answers
    /// @param notices, environment  outlive the plant
    Plant(
        std::shared_ptr<const PlantModel> model,
        PlantEnvironment* environment,
        Notices& notices,
        GrowthOptions options = {});
    ~Plant();
    Plant(const Plant&) = delete;
    Plant& operator=(const Plant&) = delete;

    /// Derivation steps made.
    [[nodiscard]] std::int64_t step() const;
    /// Whether the last step is made, or the model has called stop().
    [[nodiscard]] bool is_grown() const;
    /// Makes the next derivation step, with the environment pass before it.
    /// @returns false, and nothing is done, after the last step
    /// @throws InputError  for infinite loops and recursion, and strings over the limit; the string
    ///         is that before the step
    bool grow();
    /// Ends the growth: the passes after the last step ("environment display: before"), and the
    /// positions in the final string. To be called once.
    void finish();

    [[nodiscard]] const ModuleString& string() const;

    // These change neither variables nor random numbers, and print nothing.

    /// Makes a pass of the current string whose answers the plant does not receive.
    void observe(PlantEnvironment& environment);
    /// The string with its homomorphism.
    [[nodiscard]] ModuleString homomorphic_image();
    /// Draws the plant. The organs of a drawing are the modules of the string.
    void draw(Drawing& drawing);
    /// Bounds of the plant as drawn last.
    [[nodiscard]] const Bounds& bounds() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quasimc
