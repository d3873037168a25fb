#include "resultio/table_columns.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "resultio/describe_series.h"
#include "resultio/part_columns.h"
#include "results/fraction_table.h"
#include "results/units.h"

namespace quasimc {
namespace {

Estimate value_at(const std::vector<Estimate>& values, std::size_t row) {
    return values.empty() ? kUnknownEstimate : values[row];
}

/// Collects the columns of a table.
class ColumnList {
  public:
    ColumnList(const RunFile& run, const TableSpec& table)
        : run_(run),
          table_(table),
          is_of_groups_(table.rows == CsvRows::groups),
          times_(
              table.times != CsvTimes::sweep ? table.times
              : run.series                   ? CsvTimes::period
                                             : CsvTimes::time_steps) {}

    std::vector<TableColumn> make() {
        const std::vector<Band>& bands = run_.scene.bands();
        for (std::size_t b = 0; b < bands.size(); ++b) {
            if (is_selected(table_.bands, bands[b].name)) {
                add_light(b, kAllLight);
            }
        }
        const std::vector<std::string> origins = written_columns(run_).origins;
        for (std::size_t i = 0; i < origins.size(); ++i) {
            for (std::size_t b = 0; is_of_table(table_, origins[i]) && b < bands.size(); ++b) {
                if (is_selected(table_.bands, bands[b].name)) {
                    add_light(b, i, origins[i]);
                }
            }
        }
        add_parts();
        is_summed(times_) ? add_hours() : add_traits();
        for (std::size_t b = 0; is_of_groups_ && b < bands.size(); ++b) {
            if (is_selected(table_.bands, bands[b].name)) {
                add_shares(b);
                add_fractions(b);
            }
        }
        return std::move(columns_);
    }

  private:
    using At = std::function<Estimate(const RowLight& light, std::size_t row)>;

    void add(
        std::string_view quantity,
        std::string band,
        std::string unit,
        std::string_view summary,
        At at,
        const std::string& origin = {}) {
        columns_.push_back(
            {std::string(quantity), std::move(band), std::move(unit), std::string(summary),
             std::move(at), origin});
    }

    /// @param origin  index, or kAllLight
    void add_light(std::size_t b, std::size_t origin, const std::string& name = {}) {
        const Band& band = run_.scene.bands()[b];
        for (const QuantityEntry& entry : quantity_table()) {
            if (!is_selected(table_.quantities, entry.name)) {
                continue;
            }
            const Quantity q = entry.quantity;
            const bool of_groups = is_of_groups_;
            add(
                entry.name, band.name,
                column_unit(run_, table_.times, unit_of(entry, band, run_.scene.length_unit())),
                entry.summary,
                [q, b, origin, of_groups](const RowLight& light, std::size_t row) {
                    const auto at = [&](const auto& own) {
                        return of_groups ? own.groups.at(row, q, b) : own.at(row, q, b);
                    };
                    return light.sum != nullptr ? at(of_origin(*light.sum, origin))
                                                : at(of_origin(*light.result, origin));
                },
                name);
        }
    }

    void add_parts() {
        WrittenColumns all = all_columns(run_);
        std::erase_if(all.bands, [&](std::size_t b) {
            return !is_selected(table_.bands, run_.scene.bands()[b].name);
        });
        const bool of_groups = is_of_groups_;
        for (const PartColumn& part : part_columns(all)) {
            const std::string quantity = quantity_of(part, times_);
            if (!is_selected(table_.quantities, quantity)) {
                continue;
            }
            add(quantity, part.entry.has_bands() ? run_.scene.bands()[part.band].name : "",
                unit_of(run_, part, times_) + per_day(part, times_), summary_of(part, times_),
                [part, of_groups](const RowLight& light, std::size_t row) {
                    if (light.sum != nullptr) {
                        return part.of(
                            of_groups ? light.sum->groups.sun_shade : light.sum->sun_shade, row);
                    }
                    return part.of(
                        of_groups ? light.result->groups.sun_shade : light.result->sun_shade, row);
                });
        }
    }

    /// Adds sunlit areas in sums over time.
    void add_hours() {
        if (run_.spec.sun_shade == SunShade::apart) {
            const std::string hours = times_ == CsvTimes::days ? "h d-1" : "h";
            add_sunlit(
                {kSunlitHours, hours, "sunlit fraction of the area x time"},
                {kSunlitAreaHours, run_.scene.length_unit() + "2 " + hours,
                 "sunlit_hours times the area"});
        }
    }

    struct Text {
        std::string_view name;
        std::string unit;
        std::string_view summary;
    };
    void add_sunlit(const Text& fraction, const Text& area) {
        const bool of_groups = is_of_groups_;
        if (is_selected(table_.quantities, fraction.name)) {
            add(fraction.name, "", fraction.unit, fraction.summary,
                [of_groups](const RowLight& light, std::size_t row) {
                    const GroupResults& groups =
                        light.sum != nullptr ? light.sum->groups : light.result->groups;
                    return value_at(
                        of_groups              ? groups.sunlit_fraction
                        : light.sum != nullptr ? light.sum->sunlit_hours
                                               : light.result->sunlit_fraction,
                        row);
                });
        }
        if (of_groups && is_selected(table_.quantities, area.name)) {
            add(area.name, "", area.unit, area.summary, [](const RowLight& light, std::size_t row) {
                const GroupResults& groups =
                    light.sum != nullptr ? light.sum->groups : light.result->groups;
                return value_at(groups.sunlit_area, row);
            });
        }
    }

    void add_traits() {
        add_sunlit(
            {"sunlit_fraction", "1", "fraction of the area lit directly by directional sources"},
            {"sunlit_area", run_.scene.length_unit() + "2", "sunlit_fraction times the area"});
        const bool of_groups = is_of_groups_;
        const bool has_ratios =
            is_selected(table_.quantities, "ratios") && table_.times != CsvTimes::sweep;
        for (std::size_t i = 0; has_ratios && i < run_.spec.ratios.size(); ++i) {
            add("ratio_" + run_.spec.ratios[i], "", "1", "ratio of incident light, both sides",
                [of_groups, i](const RowLight& light, std::size_t row) {
                    return of_groups ? light.result->groups.ratio(row, i)
                                     : light.result->ratio(row, i);
                });
        }
    }

    void add_shares(std::size_t b) {
        const std::string& band = run_.scene.bands()[b].name;
        for (const ShareEntry& entry : share_table()) {
            if (is_selected(table_.quantities, entry.name)) {
                const GroupShare share = entry.share;
                add(entry.name, band, "1", entry.summary,
                    [share, b](const RowLight& light, std::size_t row) {
                        const GroupResults& groups =
                            light.sum != nullptr ? light.sum->groups : light.result->groups;
                        return share_or_unknown(groups, row, share, b);
                    });
            }
        }
    }

    void add_fractions(std::size_t b) {
        const std::string& band = run_.scene.bands()[b].name;
        for (const FractionEntry& entry : fraction_table()) {
            if (is_selected(table_.quantities, entry.name)) {
                const auto part = entry.part;
                add(entry.name, band, "1",
                    fmt::format("{}; only in the row of all organs", entry.summary),
                    [part, b](const RowLight& light, std::size_t row) {
                        const std::vector<CanopyFractions>& canopy =
                            light.sum != nullptr ? light.sum->canopy : light.result->canopy;
                        return row == 0 && !canopy.empty() ? canopy[b].*part : kUnknownEstimate;
                    });
            }
        }
    }

    const RunFile& run_;
    const TableSpec& table_;
    bool is_of_groups_;
    CsvTimes times_;  // a sweep is summed like a period, or has means like those of a time step
    std::vector<TableColumn> columns_;
};

}  // namespace

std::string column_unit(const RunFile& run, CsvTimes times, const std::string& of_rate) {
    const bool is_mean = times == CsvTimes::sweep && !run.series;
    if (!is_summed(times) || is_mean) {
        return of_rate;
    }
    const bool is_period = times == CsvTimes::period || times == CsvTimes::sweep ||
                           (run.series && run.series->cumulative_sky == CumulativeSky::period);
    return summed_unit(of_rate).name + (is_period ? "" : " d-1");
}

bool is_selected(const std::vector<std::string>& names, std::string_view name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

bool is_of_table(const TableSpec& table, const std::string& origin) {
    return !table.origins ||
           std::find(table.origins->begin(), table.origins->end(), origin) != table.origins->end();
}

std::vector<TableColumn> table_columns(const RunFile& run, const TableSpec& table) {
    return ColumnList(run, table).make();
}

}  // namespace quasimc
