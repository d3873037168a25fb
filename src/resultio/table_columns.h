#pragma once

#include <functional>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The light of the rows of a table: of a time step, or summed over a day.
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

    /// "absorbed_flux_PAR"
    [[nodiscard]] std::string name() const {
        return band.empty() ? quantity : quantity + "_" + band;
    }
};

/// The estimates of a table of organs or groups, in their order.
[[nodiscard]] std::vector<TableColumn> table_columns(const RunFile& run, const TableSpec& table);

}  // namespace quasimc
