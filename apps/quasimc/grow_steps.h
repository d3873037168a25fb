#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grow_environment.h"
#include "grow_plant.h"
#include "quasimc/sums.h"

/// The light that all organs absorb, per band; empty if there is none.
[[nodiscard]] std::vector<quasimc::Estimate> absorbed_light(const quasimc::StepLight& light);

/// A table with a line for each step of a plant.
class StepTable {
  public:
    /// Adds a step, or replaces it.
    void add(GrownPlant& plant);
    /// Enters the light of the last pass into the line of its step, if there is one.
    /// @param environment  has light
    void set_light(const GrowEnvironment& environment);
    /// The table in CSV.
    [[nodiscard]] std::string text() const;

  private:
    struct Row {
        std::int64_t step = 0;
        std::size_t modules = 0, organs = 0;
        double area = 0;
        std::vector<quasimc::Estimate> absorbed = {};
    };

    std::vector<Row> rows_;
    std::vector<quasimc::Band> bands_;  // of the light
};
