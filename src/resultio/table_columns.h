#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The light of a table: of a time step, or summed over a day; that on sensors is a part of it.
struct RowLight {
    const Result* result = nullptr;
    const SeriesSum* sum = nullptr;
};

/// An estimate of each row of a table.
struct TableColumn {
    std::string quantity;
    std::string band;  ///< "": none
    std::string unit, summary;
    std::function<Estimate(const RowLight& light, std::size_t row)> at;
    std::string origin = {};  ///< "": all light

    /// "absorbed_flux_PAR"
    [[nodiscard]] std::string name() const {
        return (band.empty() ? quantity : quantity + "_" + band) +
               (origin.empty() ? "" : "_from_" + origin);
    }
};

/// Whether a list of names, of which none means all, has one.
[[nodiscard]] bool is_selected(const std::vector<std::string>& names, std::string_view name);
/// Whether the light of an origin of the run belongs to a table.
[[nodiscard]] bool is_of_table(const TableSpec& table, const std::string& origin);

inline constexpr std::size_t kAllLight = SeriesSums::kAllLight;
/// The light of an origin by its index, or for kAllLight that of all. @param light  a Result or a
/// SeriesSum
template <typename Light>
[[nodiscard]] const Light& of_origin(const Light& light, std::size_t origin) {
    return origin == kAllLight ? light : light.origins[origin].light;
}

/// The estimates of a table of organs or groups, with those of each origin.
[[nodiscard]] std::vector<TableColumn> table_columns(const RunFile& run, const TableSpec& table);
/// The estimates of a table of sensors, with those of each origin.
[[nodiscard]] std::vector<TableColumn> sensor_columns(const RunFile& run, const TableSpec& table);

/// The unit of a column: that of a rate, or of its sum over the times of a day or period.
[[nodiscard]] std::string column_unit(
    const RunFile& run, CsvTimes times, const std::string& of_rate);

}  // namespace quasimc
