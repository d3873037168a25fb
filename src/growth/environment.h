#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "growth/turtle/drawing.h"

namespace quasimc {

/// A query module ?E(p...) of a plant, in a pass of the environment.
struct PlantQuery {
    std::int64_t id = 0;  ///< its offset in the string, as cpfg counts it
    std::span<const float> parameters;
    std::string following;  ///< "" at the end of the string, else the next module: "P", "~l"
    std::span<const float> following_parameters;
    TurtleFrame frame;
    double line_width = 0, scale = 1;
    DrawnModule module;       ///< the module of the string that it is in
    bool is_answered = true;  ///< false in a homomorphism: its answer is dropped
};

/// Values for the parameters of a query; empty ones leave their parameters.
struct PlantAnswer {
    std::int64_t id = 0;
    std::vector<std::optional<float>> values;
};

/// The environment of a plant.
class PlantEnvironment {
  public:
    virtual ~PlantEnvironment() = default;
    PlantEnvironment() = default;
    PlantEnvironment(const PlantEnvironment&) = delete;
    PlantEnvironment& operator=(const PlantEnvironment&) = delete;

    /// Where the shapes of the whole plant go in a pass; null: nowhere.
    virtual Drawing* drawing() { return nullptr; }
    /// Called for every query of a pass, in the order of the string.
    /// @returns where the shapes of the following module go until the next query; or null
    virtual Drawing* query(const PlantQuery& query) = 0;
    /// Ends a pass. @param step  derivation steps before it
    /// @returns answers, in any order. @throws InputError  if there is no environment any more
    [[nodiscard]] virtual std::vector<PlantAnswer> answers(std::int64_t step) = 0;
};

}  // namespace quasimc
