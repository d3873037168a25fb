#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "resultio/table_columns.h"
#include "results/sensor_transmittance.h"
#include "results/units.h"
#include "runfile/table_rows.h"
#include "runfile/written.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// An estimate of a row, of all light or of an origin.
struct SensorValue {
    Quantity quantity;
    std::size_t band, origin;

    [[nodiscard]] Estimate at(const RowLight& light, std::size_t row) const {
        const auto of = [&](const auto& all) {
            return of_origin(*all.sensors, origin).at(row, quantity, band);
        };
        return light.sum != nullptr ? of(*light.sum) : of(*light.result);
    }
};

/// Collects the columns of a table of sensors.
class SensorColumns {
  public:
    SensorColumns(const RunFile& run, const TableSpec& table)
        : run_(run),
          table_(table),
          origins_(written_columns(run).origins),
          spheres_(std::make_shared<const std::vector<bool>>(spheres_of(run.scene))) {
        has_spheres_ = std::find(spheres_->begin(), spheres_->end(), true) != spheres_->end();
        has_sides_ = std::find(spheres_->begin(), spheres_->end(), false) != spheres_->end();
    }

    std::vector<TableColumn> make() {
        add_light(kAllLight);
        add_transmittance();
        for (std::size_t i = 0; i < origins_.size(); ++i) {
            if (is_of_table(table_, origins_[i])) {
                add_light(i);
            }
        }
        add_sunlit();
        if (!is_summed(table_.times)) {
            add_ratios();
        }
        return std::move(columns_);
    }

  private:
    void add_light(std::size_t origin) {
        const std::vector<Band>& bands = run_.scene.bands();
        for (std::size_t b = 0; b < bands.size(); ++b) {
            for (const QuantityEntry& entry : quantity_table()) {
                const bool is_side = entry.quantity == Quantity::incident_upper ||
                                     entry.quantity == Quantity::incident_lower;
                if (is_selected(table_.bands, bands[b].name) && is_of_sensors(entry.quantity) &&
                    is_selected(table_.quantities, entry.name) && (has_sides_ || !is_side)) {
                    add_column(
                        entry.name, entry.summary, b, {entry.quantity, b, origin}, is_side, false);
                }
            }
            if (has_spheres_ && is_selected(table_.bands, bands[b].name) &&
                is_selected(table_.quantities, kFluenceRate)) {
                // All light on a sphere is on its upper side.
                add_column(
                    kFluenceRate, "light from all directions, on a sphere", b,
                    {Quantity::incident_upper, b, origin}, false, true);
            }
        }
    }

    /// @param of_sides, of_spheres  whether other sensors have no value
    void add_column(
        std::string_view name,
        std::string_view summary,
        std::size_t band,
        const SensorValue& value,
        bool of_sides,
        bool of_spheres) {
        const Band& own = run_.scene.bands()[band];
        const auto at = [value, of_sides, of_spheres, spheres = spheres_](
                            const RowLight& light, std::size_t row) {
            const bool is_other = (*spheres)[row] ? of_sides : of_spheres;
            return is_other ? kUnknownEstimate : value.at(light, row);
        };
        columns_.push_back(
            {std::string(name), own.name, column_unit(run_, table_.times, own.unit),
             std::string(summary), at, value.origin == kAllLight ? "" : origins_[value.origin]});
    }

    void add_transmittance() {
        const auto fraction = std::make_shared<const SensorTransmittance>(run_.scene);
        const std::vector<Band>& bands = run_.scene.bands();
        for (std::size_t b = 0; fraction->exists() && b < bands.size(); ++b) {
            if (!is_selected(table_.bands, bands[b].name) ||
                !is_selected(table_.quantities, kTransmittance)) {
                continue;
            }
            const auto at = [fraction, b](const RowLight& light, std::size_t row) {
                return light.sum != nullptr ? fraction->at(*light.sum, row, b)
                                            : fraction->at(*light.result, row, b);
            };
            columns_.push_back(
                {std::string(kTransmittance), bands[b].name, "1",
                 "light from above / light on the horizontal", at});
        }
    }

    /// Adds sunlit fractions, or in sums over time sunlit hours.
    void add_sunlit() {
        const auto value_at = [](const std::vector<Estimate>& values, std::size_t row) {
            return values.empty() ? kUnknownEstimate : values[row];
        };
        const auto at = [value_at](const RowLight& light, std::size_t row) {
            return light.sum != nullptr ? value_at(light.sum->sensors->sunlit_hours, row)
                                        : value_at(light.result->sensors->sunlit_fraction, row);
        };
        const bool is_over_time = is_summed(table_.times) && run_.series;
        if (!is_over_time && is_selected(table_.quantities, "sunlit_fraction")) {
            columns_.push_back(
                {"sunlit_fraction", "", "1", "fraction lit directly by directional sources", at});
        }
        if (is_over_time && run_.spec.sun_shade == SunShade::apart &&
            is_selected(table_.quantities, kSunlitHours)) {
            columns_.push_back(
                {std::string(kSunlitHours), "", table_.times == CsvTimes::days ? "h d-1" : "h",
                 "sunlit fraction x time", at});
        }
    }

    void add_ratios() {
        for (std::size_t i = 0;
             is_selected(table_.quantities, "ratios") && i < run_.spec.ratios.size(); ++i) {
            columns_.push_back(
                {"ratio_" + run_.spec.ratios[i], "", "1", "ratio of incident light, both sides",
                 [i](const RowLight& light, std::size_t row) {
                     return light.result->sensors->ratio(row, i);
                 }});
        }
    }

    const RunFile& run_;
    const TableSpec& table_;
    std::vector<std::string> origins_;
    std::shared_ptr<const std::vector<bool>> spheres_;
    bool has_spheres_ = false, has_sides_ = false;
    std::vector<TableColumn> columns_;
};

}  // namespace

std::vector<TableColumn> sensor_columns(const RunFile& run, const TableSpec& table) {
    return SensorColumns(run, table).make();
}

}  // namespace quasimc
