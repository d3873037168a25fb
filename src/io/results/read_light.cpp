#include "io/results/read_light.h"

#include <optional>
#include <utility>

#include "io/results/json_scanner.h"
#include "io/results/read_estimates.h"
#include "io/results/written.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

/// Which estimates of a result are read, and where they stand in a Result.
class LightColumns {
  public:
    explicit LightColumns(const RunFile& run)
        : run_(run),
          written_(written_columns(run)),
          light_(written_.bands.size() * written_.quantities.size()) {}

    [[nodiscard]] std::vector<EstimateNames> names() const {
        std::vector<EstimateNames> names;
        for (const std::size_t b : written_.bands) {
            for (const QuantityEntry& entry : written_.quantities) {
                names.push_back({std::string(entry.name), run_.scene.bands()[b].name});
            }
        }
        names.push_back({"sunlit_fraction"});
        for (const std::string& ratio : run_.spec.ratios) {
            names.push_back({"ratios", ratio});
        }
        return names;
    }

    /// @param values  of each column at one time; null: there are none
    [[nodiscard]] Result result(const std::vector<const std::vector<Estimate>*>& values) const {
        const std::size_t organs = run_.scene.organs().size();
        Result result;
        result.paths = 1;  // it was computed, or else it would not be written
        result.bands = run_.scene.bands().size();
        result.ratios = run_.spec.ratios.size();
        result.values = light(values);
        if (values[light_] != nullptr) {
            result.sunlit_fraction = *values[light_];
            result.sunlit_fraction.resize(organs, kUnknownEstimate);
        }
        result.ratio_values.assign(organs * result.ratios, kUnknownEstimate);
        for (std::size_t i = 0; i < result.ratios; ++i) {
            const std::vector<Estimate>* column = values[light_ + 1 + i];
            for (std::size_t organ = 0; column != nullptr && organ < column->size(); ++organ) {
                result.ratio_values[organ * result.ratios + i] = (*column)[organ];
            }
        }
        return result;
    }

    /// As Result::values.
    [[nodiscard]] std::vector<Estimate> light(
        const std::vector<const std::vector<Estimate>*>& values) const {
        const std::size_t bands = run_.scene.bands().size();
        std::vector<Estimate> all(
            run_.scene.organs().size() * kQuantities * bands, kUnknownEstimate);
        std::size_t number = 0;
        for (const std::size_t b : written_.bands) {
            for (const QuantityEntry& entry : written_.quantities) {
                const std::vector<Estimate>* column = values[number++];
                const auto q = static_cast<std::size_t>(entry.quantity);
                for (std::size_t i = 0; column != nullptr && i < column->size(); ++i) {
                    all[(i * kQuantities + q) * bands + b] = (*column)[i];
                }
            }
        }
        return all;
    }

  private:
    const RunFile& run_;
    WrittenColumns written_;
    std::size_t light_;  // columns before that of what is sunlit
};

/// Goes along the columns of a result: each has the times that it knows, in one order.
class TimedColumns {
  public:
    explicit TimedColumns(std::vector<std::vector<TimedEstimates>> columns)
        : columns_(std::move(columns)), next_(columns_.size()) {}

    [[nodiscard]] bool empty() const {
        for (const std::vector<TimedEstimates>& column : columns_) {
            if (!column.empty()) {
                return false;
            }
        }
        return true;
    }

    /// What the columns have of the next time, if it is called so; nothing if none of them has it.
    [[nodiscard]] std::optional<std::vector<const std::vector<Estimate>*>> take(
        const std::string& label) {
        std::vector<const std::vector<Estimate>*> values(columns_.size(), nullptr);
        bool is_there = false;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (next_[i] < columns_[i].size() && columns_[i][next_[i]].label == label) {
                values[i] = &columns_[i][next_[i]++].values;
                is_there = true;
            }
        }
        return is_there ? std::optional(std::move(values)) : std::nullopt;
    }

  private:
    std::vector<std::vector<TimedEstimates>> columns_;
    std::vector<std::size_t> next_;
};

}  // namespace

std::vector<std::string_view> point_texts(std::string_view text, const std::string& path) {
    std::vector<std::string_view> points;
    JsonScanner json(text, path);
    json.object([&](std::string_view key) {
        if (key == "points" && json.kind() == JsonScanner::Kind::list) {
            json.list([&](std::size_t) { points.push_back(json.skip()); });
        } else {
            json.skip();
        }
    });
    return points;
}

void read_light(
    std::string_view text, const std::string& path, const RunFile& run, const LightEvents& events) {
    const LightColumns columns(run);
    const std::vector<EstimateNames> names = columns.names();
    EstimateQuery query;
    query.part = run.series ? "moments" : "";
    TimedColumns times(read_estimate_columns(text, path, query, names));
    if (times.empty()) {
        throw InputError({{path, "holds no light of organs", "the run did not get so far", ""}});
    }
    const std::size_t count = run.series ? run.series->notes.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string label = run.series ? run.series->notes[i].time : "";
        if (const auto values = times.take(label)) {
            events.on_time_step(i, columns.result(*values));
        }
    }
    if (!run.series) {
        return;
    }
    query.part = "days";
    TimedColumns days(read_estimate_columns(text, path, query, names));
    for (std::size_t day = 0; day < run.series->days.size(); ++day) {
        if (const auto values = days.take(run.series->days[day])) {
            SeriesSum sum;
            sum.bands = run.scene.bands().size();
            sum.values = columns.light(*values);
            events.on_day(day, sum);
        }
    }
}

}  // namespace quasimc
