#include "resultio/stored_columns.h"

#include <algorithm>
#include <memory>

#include "resultio/part_columns.h"
#include "results/evaluate.h"
#include "results/fraction_table.h"
#include "runfile/table_rows.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// Puts a column, which may have fewer rows, into every `step`-th of the values.
void put_column(
    const std::vector<Estimate>& column,
    std::vector<Estimate>& values,
    std::size_t first,
    std::size_t step) {
    const std::size_t rows = std::min(values.size() / step, column.size());
    for (std::size_t i = 0; i < rows; ++i) {
        values[first + i * step] = column[i];
    }
}

/// A column with all of its rows.
std::vector<Estimate> whole_column(const std::vector<Estimate>& column, std::size_t rows) {
    std::vector<Estimate> all = column;
    all.resize(rows, kUnknownEstimate);
    return all;
}

}  // namespace

void put_fluence(
    const std::vector<bool>& is_sphere,
    std::vector<Estimate>& upper,
    std::vector<Estimate>& fluence) {
    if (fluence.empty()) {
        return;
    }
    upper.resize(is_sphere.size(), kUnknownEstimate);
    fluence.resize(is_sphere.size(), kUnknownEstimate);
    for (std::size_t i = 0; i < is_sphere.size(); ++i) {
        upper[i] = (is_sphere[i] ? fluence : upper)[i];
    }
}

StoredColumns::StoredColumns(const RunFile& run)
    : run_(run),
      written_(written_columns(run)),
      organs_(run.scene.organs().size()),
      bands_(run.scene.bands().size()),
      ratios_(run.spec.ratios.size()),
      groups_(make_groups(run.scene, group_spec(run.spec))),
      is_sphere_(spheres_of(run.scene)) {
    add_light({});
    sunlit_ = names_.size();
    names_.push_back({"sunlit_fraction"});
    for (const std::string& ratio : run.spec.ratios) {
        names_.push_back({"ratios", ratio});
    }
    parts_ = names_.size();
    add_parts(CsvTimes::time_steps);
    day_parts_ = names_.size();
    add_parts(CsvTimes::days);
    hours_ = names_.size();
    names_.push_back({std::string(kSunlitHours)});
    areas_ = names_.size();
    names_.push_back({"sunlit_area"});
    names_.push_back({std::string(kSunlitAreaHours)});
    shares_ = names_.size();
    for (const ShareEntry& entry : share_table()) {
        for (const std::size_t b : written_.bands) {
            names_.push_back({std::string(entry.name), run.scene.bands()[b].name});
        }
    }
    for (const std::string& origin : written_.origins) {
        first_of_origins_.push_back(names_.size());
        add_light({"origins", origin});
    }
}

/// Adds the columns of the quantities. @param first  keys that lead to them
void StoredColumns::add_light(const std::vector<std::string>& first) {
    const auto add = [&](std::string_view quantity, std::size_t band) {
        std::vector<std::string> path = first;
        path.insert(path.end(), {std::string(quantity), run_.scene.bands()[band].name});
        names_.push_back(std::move(path));
        return names_.size() - 1;
    };
    std::vector<std::size_t> upper;
    for (const std::size_t b : written_.bands) {
        for (const QuantityEntry& entry : written_.quantities) {
            const std::size_t column = add(entry.name, b);
            if (entry.quantity == Quantity::incident_upper) {
                upper.push_back(column);
            }
        }
    }
    for (std::size_t i = 0; i < upper.size(); ++i) {
        fluences_.emplace_back(upper[i], add(kFluenceRate, written_.bands[i]));
    }
}

void StoredColumns::add_parts(CsvTimes times) {
    for (const PartColumn& part : part_columns(written_)) {
        std::vector<std::string> path{quantity_of(part, times)};
        if (part.entry.has_bands()) {
            path.push_back(run_.scene.bands()[part.band].name);
        }
        names_.push_back(std::move(path));
    }
}

Result StoredColumns::result(const RowColumns& columns) const {
    Result result = result_of_rows(columns, organs_);
    result.names = run_.scene.names();
    result.sun_shade = parts(columns, organs_, CsvTimes::time_steps);
    return result;
}

SeriesSum StoredColumns::sum(const RowColumns& columns) const {
    SeriesSum sum = sum_of_rows(columns, organs_);
    sum.sun_shade = parts(columns, organs_, CsvTimes::days);
    return sum;
}

void StoredColumns::add_groups(const RowColumns& columns, Result& result) const {
    add_groups_of(columns, CsvTimes::time_steps, result);
}

void StoredColumns::add_groups(const RowColumns& columns, SeriesSum& sum) const {
    add_groups_of(columns, CsvTimes::days, sum);
}

/// @param light  a Result or a SeriesSum
template <typename Light>
void StoredColumns::add_groups_of(const RowColumns& columns, CsvTimes times, Light& light) const {
    if (columns.empty()) {
        return;
    }
    light.groups = groups(columns, times);
    for (std::size_t i = 0; i < light.origins.size(); ++i) {
        GroupResults& own = light.origins[i].light.groups;
        own.groups = groups_;
        own.bands = bands_;
        own.values = this->light(columns, groups_.size(), first_of_origins_[i]);
    }
}

GroupResults StoredColumns::groups(const RowColumns& columns, CsvTimes times) const {
    const bool is_sum = times == CsvTimes::days;
    const std::size_t rows = groups_.size();
    GroupResults all;
    all.groups = groups_;
    all.bands = bands_;
    all.values = light(columns, rows);
    if (const auto& sunlit = columns[is_sum ? hours_ : sunlit_]; !sunlit.empty()) {
        all.sunlit_fraction = whole_column(sunlit, rows);
        all.sunlit_area = whole_column(columns[is_sum ? areas_ + 1 : areas_], rows);
    }
    if (!is_sum) {
        all.ratios = ratios_;
        put_ratios(columns, rows, all.ratio_values);
    }
    put_shares(columns, all);
    all.sun_shade = parts(columns, rows, times);
    return all;
}

void StoredColumns::put_shares(const RowColumns& columns, GroupResults& all) const {
    const auto end = columns.begin() +
                     static_cast<std::ptrdiff_t>(shares_ + kGroupShares * written_.bands.size());
    const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(shares_);
    if (std::all_of(begin, end, [](const auto& column) { return column.empty(); })) {
        return;
    }
    all.shares.assign(groups_.size() * kGroupShares * bands_, kUnknownEstimate);
    std::size_t number = shares_;
    for (std::size_t share = 0; share < kGroupShares; ++share) {
        for (const std::size_t b : written_.bands) {
            put_column(columns[number++], all.shares, share * bands_ + b, kGroupShares * bands_);
        }
    }
}

Result StoredColumns::result_of_sensors(RowColumns columns) const {
    Result result = result_of_rows(with_spheres(std::move(columns)), is_sphere_.size());
    result.names = scene_of_sensors(run_.scene).names();
    return result;
}

SeriesSum StoredColumns::sum_of_sensors(RowColumns columns) const {
    return sum_of_rows(with_spheres(std::move(columns)), is_sphere_.size());
}

Result StoredColumns::result_of_rows(const RowColumns& columns, std::size_t rows) const {
    Result result;
    result.paths = 1;  // it was computed, or else it would not be written
    result.bands = bands_;
    result.ratios = ratios_;
    result.values = light(columns, rows);
    add_origins(columns, rows, result.origins);
    if (!columns[sunlit_].empty()) {
        result.sunlit_fraction = whole_column(columns[sunlit_], rows);
    }
    put_ratios(columns, rows, result.ratio_values);
    return result;
}

void StoredColumns::put_ratios(
    const RowColumns& columns, std::size_t rows, std::vector<Estimate>& values) const {
    values.assign(rows * ratios_, kUnknownEstimate);
    for (std::size_t i = 0; i < ratios_; ++i) {
        put_column(columns[sunlit_ + 1 + i], values, i, ratios_);
    }
}

SeriesSum StoredColumns::sum_of_rows(const RowColumns& columns, std::size_t rows) const {
    SeriesSum sum;
    sum.bands = bands_;
    sum.values = light(columns, rows);
    if (written_.has_sunlit_hours) {
        sum.sunlit_hours = whole_column(columns[hours_], rows);
    }
    add_origins(columns, rows, sum.origins);
    return sum;
}

/// The estimates in the order of Result::values. @param number  of the first column
std::vector<Estimate> StoredColumns::light(
    const RowColumns& columns, std::size_t rows, std::size_t number) const {
    std::vector<Estimate> all(rows * kQuantities * bands_, kUnknownEstimate);
    for (const std::size_t b : written_.bands) {
        for (const QuantityEntry& entry : written_.quantities) {
            const auto q = static_cast<std::size_t>(entry.quantity);
            put_column(columns[number++], all, q * bands_ + b, kQuantities * bands_);
        }
    }
    return all;
}

/// @param origins  of a Result or a SeriesSum
template <typename Origin>
void StoredColumns::add_origins(
    const RowColumns& columns, std::size_t rows, std::vector<Origin>& origins) const {
    for (std::size_t i = 0; i < written_.origins.size(); ++i) {
        Origin& origin = origins.emplace_back();
        origin.name = written_.origins[i];
        origin.light.bands = bands_;
        origin.light.values = light(columns, rows, first_of_origins_[i]);
    }
}

/// The light of sunlit and shaded parts.
SunShadeLight StoredColumns::parts(
    const RowColumns& columns, std::size_t rows, CsvTimes times) const {
    SunShadeLight light{bands_};
    const std::size_t per_row = light.values_per_row();
    std::size_t number = times == CsvTimes::days ? day_parts_ : parts_;
    light.values.assign(written_.parts.empty() ? 0 : rows * per_row, kUnknownEstimate);
    for (const PartColumn& part : part_columns(written_)) {
        const std::size_t first = static_cast<std::size_t>(part.entry.quantity) * bands_;
        const std::size_t end = part.entry.has_bands() ? part.band + 1 : bands_;
        for (std::size_t b = part.band; b < end; ++b) {
            put_column(columns[number], light.values, first + b, per_row);
        }
        ++number;
    }
    return light;
}

RowColumns StoredColumns::with_spheres(RowColumns columns) const {
    for (const auto& [upper, fluence] : fluences_) {
        put_fluence(is_sphere_, columns[upper], columns[fluence]);
    }
    return columns;
}

}  // namespace quasimc
