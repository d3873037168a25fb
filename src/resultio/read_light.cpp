#include "resultio/read_light.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "base/text.h"
#include "quasimc/error.h"
#include "resultio/part_columns.h"
#include "resultio/read_rows.h"
#include "results/evaluate.h"
#include "runfile/written.h"

namespace quasimc {
namespace {

/// The estimates that are read, and their positions in a Result.
class LightColumns {
  public:
    explicit LightColumns(const RunFile& run)
        : written_(written_columns(run)),
          organs_(run.scene.organs().size()),
          bands_(run.scene.bands().size()),
          ratios_(run.spec.ratios.size()),
          scene_names_(run.scene.names()) {
        add_light(run, {});
        sunlit_ = names_.size();
        names_.push_back({"sunlit_fraction"});
        for (const std::string& ratio : run.spec.ratios) {
            names_.push_back({"ratios", ratio});
        }
        for (const CsvTimes times : {CsvTimes::time_steps, CsvTimes::days}) {
            (times == CsvTimes::days ? day_parts_ : parts_) = names_.size();
            add_parts(run, times);
        }
        hours_ = names_.size();
        names_.push_back({std::string(kSunlitHours)});
        for (const std::string& origin : written_.origins) {
            first_of_origins_.push_back(names_.size());
            add_light(run, {"origins", origin});
        }
    }

    [[nodiscard]] const std::vector<std::vector<std::string>>& names() const { return names_; }

    [[nodiscard]] Result result(RowColumns& columns) const {
        Result result;
        result.paths = 1;  // it was computed, or else it would not be written
        result.bands = bands_;
        result.names = scene_names_;
        result.ratios = ratios_;
        result.values = light(columns);
        add_origins(columns, result.origins);
        result.sun_shade = parts(columns, parts_);
        if (!columns[sunlit_].empty()) {
            result.sunlit_fraction = std::move(columns[sunlit_]);
            result.sunlit_fraction.resize(organs_, kUnknownEstimate);
        }
        result.ratio_values.assign(organs_ * ratios_, kUnknownEstimate);
        for (std::size_t i = 0; i < ratios_; ++i) {
            put(columns[sunlit_ + 1 + i], result.ratio_values, i, ratios_);
        }
        return result;
    }

    [[nodiscard]] SeriesSum sum(const RowColumns& columns) const {
        SeriesSum sum;
        sum.bands = bands_;
        sum.values = light(columns);
        add_origins(columns, sum.origins);
        sum.sun_shade = parts(columns, day_parts_);
        if (written_.has_sunlit_hours) {
            sum.sunlit_hours = columns[hours_];
            sum.sunlit_hours.resize(organs_, kUnknownEstimate);
        }
        return sum;
    }

    /// The estimates in the order of Result::values.
    /// @param number  of the first column
    [[nodiscard]] std::vector<Estimate> light(
        const RowColumns& columns, std::size_t number = 0) const {
        std::vector<Estimate> all(organs_ * kQuantities * bands_, kUnknownEstimate);
        for (const std::size_t b : written_.bands) {
            for (const QuantityEntry& entry : written_.quantities) {
                const auto q = static_cast<std::size_t>(entry.quantity);
                put(columns[number++], all, q * bands_ + b, kQuantities * bands_);
            }
        }
        return all;
    }

  private:
    /// @param origins  OriginLight or OriginSum
    template <typename Origin>
    void add_origins(const RowColumns& columns, std::vector<Origin>& origins) const {
        for (std::size_t i = 0; i < written_.origins.size(); ++i) {
            Origin& origin = origins.emplace_back();
            origin.name = written_.origins[i];
            origin.light.bands = bands_;
            origin.light.values = light(columns, first_of_origins_[i]);
        }
    }

    void add_parts(const RunFile& run, CsvTimes times) {
        for (const PartColumn& part : part_columns(written_)) {
            std::vector<std::string> path{quantity_of(part, times)};
            if (part.entry.has_bands()) {
                path.push_back(run.scene.bands()[part.band].name);
            }
            names_.push_back(std::move(path));
        }
    }

    /// The light of sunlit and shaded parts. @param number  of the first column
    [[nodiscard]] SunShadeLight parts(const RowColumns& columns, std::size_t number) const {
        SunShadeLight light{bands_};
        const std::size_t per_row = light.values_per_row();
        light.values.assign(written_.parts.empty() ? 0 : organs_ * per_row, kUnknownEstimate);
        for (const PartColumn& part : part_columns(written_)) {
            const std::size_t first = static_cast<std::size_t>(part.entry.quantity) * bands_;
            const std::size_t end = part.entry.has_bands() ? part.band + 1 : bands_;
            for (std::size_t b = part.band; b < end; ++b) {
                put(columns[number], light.values, first + b, per_row);
            }
            ++number;
        }
        return light;
    }

    /// @param first  keys that lead to the quantities
    void add_light(const RunFile& run, const std::vector<std::string>& first) {
        for (const std::size_t b : written_.bands) {
            for (const QuantityEntry& entry : written_.quantities) {
                std::vector<std::string> path = first;
                path.insert(path.end(), {std::string(entry.name), run.scene.bands()[b].name});
                names_.push_back(std::move(path));
            }
        }
    }
    void put(
        const std::vector<Estimate>& column,
        std::vector<Estimate>& values,
        std::size_t first,
        std::size_t step) const {
        for (std::size_t i = 0; i < std::min(organs_, column.size()); ++i) {
            values[first + i * step] = column[i];
        }
    }

    WrittenColumns written_;
    std::size_t organs_, bands_, ratios_;
    std::shared_ptr<const SceneNames> scene_names_;
    std::vector<std::vector<std::string>> names_;
    std::size_t sunlit_ = 0, parts_ = 0, day_parts_ = 0, hours_ = 0;
    std::vector<std::size_t> first_of_origins_;
};

double number_in(const Node& table, std::string_view key) {
    const Node* node = table.find(key);
    const auto* real = node != nullptr ? node->as<double>() : nullptr;
    const auto* whole = node != nullptr ? node->as<std::int64_t>() : nullptr;
    return real != nullptr    ? *real
           : whole != nullptr ? static_cast<double>(*whole)
                              : std::numeric_limits<double>::quiet_NaN();
}

const Node* item_at(const Node* list, std::size_t index) {
    const auto* items = list != nullptr ? list->as<Node::List>() : nullptr;
    return items != nullptr && index < items->size() ? &(*items)[index] : nullptr;
}

/// The values of detectors, NaN where they are missing.
/// @param rest  the result without its rows
std::vector<DetectorResult> read_detectors(
    const Node& rest, const RowsPosition& position, const RunFile& run) {
    const Node* at = run.sweep ? item_at(rest.find("points"), position.point) : &rest;
    at = at != nullptr && run.series ? item_at(at->find("time_steps"), position.index) : at;
    const Node* list = at != nullptr ? at->find("detectors") : nullptr;
    std::vector<DetectorResult> detectors = zero_detectors(run.scene);
    const std::size_t bands = run.scene.bands().size();
    for (std::size_t d = 0; d < detectors.size(); ++d) {
        const Node* detector = item_at(list, d);
        for (std::size_t i = 0; i < detectors[d].values.size(); ++i) {
            const Node* bin =
                detector != nullptr ? item_at(detector->find("bins"), i / bands) : nullptr;
            const Node* flux = bin != nullptr ? bin->find("flux") : nullptr;
            const Node* of_band =
                flux != nullptr ? flux->find(run.scene.bands()[i % bands].name) : nullptr;
            detectors[d].values[i] =
                of_band != nullptr
                    ? Estimate{number_in(*of_band, "mean"), number_in(*of_band, "standard_error"),
                               number_in(*of_band, "ci95_low"), number_in(*of_band, "ci95_high")}
                    : kUnknownEstimate;
        }
    }
    return detectors;
}

/// The number of a time or day of the run, from one on.
std::size_t find_label(
    const std::vector<std::string>& labels,
    std::size_t from,
    const RowsPosition& position,
    const std::string& path) {
    const auto found =
        std::find(labels.begin() + static_cast<std::ptrdiff_t>(from), labels.end(), position.label);
    if (found == labels.end()) {
        throw InputError(
            {{path,
              shown(position.label) + " in " + position.part + " is not the next one in the run",
              "time steps must be in the order of the run", ""}});
    }
    return static_cast<std::size_t>(found - labels.begin());
}

}  // namespace

void read_light(
    std::string_view text, const std::string& path, const RunFile& run, const LightEvents& events) {
    const LightColumns columns(run);
    const std::optional<TimeSeries> series = run.series;  // the run may become the next point
    std::vector<std::string> times;
    for (std::size_t i = 0; series && i < series->notes.size(); ++i) {
        times.push_back(series->notes[i].time);
    }
    const auto rest =
        run.scene.detectors().empty()
            ? std::nullopt
            : std::optional(read_rows(text, path, {.rest = RowsQuery::Rest::all}, {}));
    const auto light_at = [&](PlacedRows& rows) {
        Result result = columns.result(rows.columns);
        if (rest) {
            result.detectors = read_detectors(*rest, rows.position, run);
        }
        return result;
    };
    std::optional<std::size_t> point;
    std::size_t next_time = 0, next_day = 0;  // within the point; labels of times may repeat
    const auto take = [&](PlacedRows rows) {
        const RowsPosition& position = rows.position;
        if (point != position.point) {
            point = position.point;
            next_time = next_day = 0;
            events.on_point(*point);
        }
        if (position.part == "days" && series) {
            const SeriesSum sum = columns.sum(rows.columns);
            const std::size_t day = find_label(series->days, next_day, position, path);
            next_day = day + 1;
            events.on_day(day, sum);
        } else if (position.part == "time_steps" && series) {
            const std::size_t time = find_label(times, next_time, position, path);
            next_time = time + 1;
            events.on_time_step(time, light_at(rows));
        } else if (position.part.empty() && !series) {
            events.on_time_step(0, light_at(rows));
        }
    };
    read_rows(text, path, {.columns = columns.names()}, take);
    if (!point) {
        throw InputError(
            {{path, "contains no light of organs", "the run ended before the first result", ""}});
    }
}

}  // namespace quasimc
