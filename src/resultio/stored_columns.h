#pragma once

// The estimates of a JSON result, as columns of rows.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "resultio/read_rows.h"
#include "runfile/run_file.h"
#include "runfile/written.h"

namespace quasimc {

/// Puts the fluence rate of sensors that are spheres in the column of their upper side, which has
/// all of their light. Either column may be empty.
void put_fluence(
    const std::vector<bool>& is_sphere,
    std::vector<Estimate>& upper,
    std::vector<Estimate>& fluence);

/// The estimates of organs, groups and sensors that a result has, and their positions in a Result.
class StoredColumns {
  public:
    /// @param run  must outlive this
    explicit StoredColumns(const RunFile& run);

    /// The paths of keys to the columns, for RowsQuery.
    [[nodiscard]] const std::vector<std::vector<std::string>>& names() const { return names_; }

    /// The light on organs. Unknown estimates, and those that are not written, are NaN.
    [[nodiscard]] Result result(const RowColumns& columns) const;
    [[nodiscard]] SeriesSum sum(const RowColumns& columns) const;
    /// Sets the light of groups, also of each origin. It stays empty if there are no columns.
    void add_groups(const RowColumns& columns, Result& result) const;
    void add_groups(const RowColumns& columns, SeriesSum& sum) const;
    /// The light on sensors, as Result::sensors.
    [[nodiscard]] Result result_of_sensors(RowColumns columns) const;
    [[nodiscard]] SeriesSum sum_of_sensors(RowColumns columns) const;

  private:
    [[nodiscard]] Result result_of_rows(const RowColumns& columns, std::size_t rows) const;
    [[nodiscard]] SeriesSum sum_of_rows(const RowColumns& columns, std::size_t rows) const;
    [[nodiscard]] std::vector<Estimate> light(
        const RowColumns& columns, std::size_t rows, std::size_t number = 0) const;
    template <typename Origin>
    void add_origins(
        const RowColumns& columns, std::size_t rows, std::vector<Origin>& origins) const;
    [[nodiscard]] SunShadeLight parts(
        const RowColumns& columns, std::size_t rows, CsvTimes times) const;
    template <typename Light>
    void add_groups_of(const RowColumns& columns, CsvTimes times, Light& light) const;
    [[nodiscard]] GroupResults groups(const RowColumns& columns, CsvTimes times) const;
    void put_ratios(
        const RowColumns& columns, std::size_t rows, std::vector<Estimate>& values) const;
    void put_shares(const RowColumns& columns, GroupResults& all) const;
    [[nodiscard]] RowColumns with_spheres(RowColumns columns) const;
    void add_light(const std::vector<std::string>& first);
    void add_parts(CsvTimes times);

    const RunFile& run_;
    WrittenColumns written_;
    std::size_t organs_, bands_, ratios_;
    std::vector<OrganGroup> groups_;
    std::vector<bool> is_sphere_;  // by sensor
    std::vector<std::vector<std::string>> names_;
    std::size_t sunlit_ = 0, parts_ = 0, day_parts_ = 0, hours_ = 0, areas_ = 0, shares_ = 0;
    std::vector<std::size_t> first_of_origins_;
    // Columns of the upper side, and of the fluence rate that spheres have instead.
    std::vector<std::pair<std::size_t, std::size_t>> fluences_;
};

}  // namespace quasimc
