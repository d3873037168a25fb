#pragma once

// The columns of the light of sunlit and shaded parts.

#include <cstddef>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "runfile/run_file.h"
#include "runfile/written.h"

namespace quasimc {

/// A column of a quantity of parts.
struct PartColumn {
    SunShadeEntry entry;
    std::size_t band = 0;  ///< the first for a quantity that has no bands

    [[nodiscard]] Estimate of(const SunShadeLight& light, std::size_t row) const {
        return light.empty() ? kUnknownEstimate : light.at(row, entry.quantity, band);
    }
};

/// Band by band, then those that have no bands.
[[nodiscard]] std::vector<PartColumn> part_columns(const WrittenColumns& columns);
/// "incident_upper_sunlit", "sunlit_fraction_upper"; in sums "sunlit_hours_upper".
[[nodiscard]] std::string quantity_of(const PartColumn& column, CsvTimes times);
/// The same with its band: "incident_upper_sunlit_PAR".
[[nodiscard]] std::string name_of(const RunFile& run, const PartColumn& column, CsvTimes times);
/// The unit; of sums in a table of days.
[[nodiscard]] std::string unit_of(const RunFile& run, const PartColumn& column, CsvTimes times);
/// " d-1" for sums over a day, "" for means.
[[nodiscard]] std::string per_day(const PartColumn& column, CsvTimes times);
/// One line on the quantity.
[[nodiscard]] std::string summary_of(const PartColumn& column, CsvTimes times);

/// Appends the columns of an organ or a group to a row of CSV.
void append_parts(
    std::string& out, const WrittenColumns& columns, const SunShadeLight& light, std::size_t row);
/// The comments on the columns.
[[nodiscard]] std::string csv_part_columns(const RunFile& run, CsvTimes times);

}  // namespace quasimc
