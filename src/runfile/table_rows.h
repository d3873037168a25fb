#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run_file.h"
#include "results/organ_values.h"
#include "results/where_expression.h"

namespace quasimc {

/// Selects the rows of a table by its `where`.
class TableRows {
  public:
    TableRows() = default;
    /// @param run  must outlive this
    /// @throws InputError  if the condition has an error or unknown names; its location is "where"
    TableRows(const RunFile& run, const TableSpec& table);

    /// Whether the organ or sensor with an index has a row.
    [[nodiscard]] bool has_organ(std::size_t organ) const {
        return organs_.empty() || organs_[organ];
    }
    [[nodiscard]] bool has(const OrganGroup& group) const;
    /// Whether there is no row. @param run  that of the constructor
    [[nodiscard]] bool is_empty(const RunFile& run) const;

  private:
    void select_sensors(const Scene& scene, const WhereExpression& where);

    std::optional<WhereExpression> where_;  // of groups
    std::vector<bool> organs_;              // or sensors; empty: all
};

/// The keys of the groups of a run, each once, in their order; without "layer" of layers.
[[nodiscard]] std::vector<std::string> group_keys(const RunFile& run);

/// The light on a sphere, from all directions.
inline constexpr std::string_view kFluenceRate = "fluence_rate";

/// Whether sensors have a quantity: they absorb nothing.
[[nodiscard]] constexpr bool is_of_sensors(Quantity quantity) {
    return quantity != Quantity::absorbed_flux && quantity != Quantity::absorbed_flux_density;
}

/// Selects the quantities that sensors have, with their names: on a sphere all light is on its
/// upper side, and is called the fluence rate.
[[nodiscard]] std::vector<QuantityEntry> sensor_quantities(
    const std::vector<QuantityEntry>& quantities, Receiver receiver);

/// The shape of the results of a set: none for a mean; lines and columns of an array, which the
/// labels i and j of points also make; else the number of points.
[[nodiscard]] std::vector<std::size_t> sensor_shape(const SensorSet& set);

/// The names of the quantities that a table can have. @param has_times  of a run with [time]
[[nodiscard]] std::vector<std::string_view> table_quantities(
    CsvRows rows, CsvTimes times, bool has_times);

}  // namespace quasimc
