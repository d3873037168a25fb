// The output sensors_picture: maps of arrays of sensors. In runs with [time] they show the sum, in
// sweeps the last point.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "picture/array_map.h"
#include "picture/color_map.h"
#include "quasimc/quasimc.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"
#include "results/units.h"
#include "runfile/table_rows.h"
#include "show_colors.h"

namespace {

using quasimc::Quantity;

bool is_map(const quasimc::SensorSet& set) {
    return !set.is_averaged && set.counts[0] > 1 && set.counts[1] > 1;
}

/// The quantity of a map: the first of those that are written, or the light on the upper side.
quasimc::QuantityEntry drawn_quantity(const quasimc::RunFile& run) {
    for (const std::string& name : run.output.quantities) {
        for (const quasimc::QuantityEntry& entry : quasimc::quantity_table()) {
            if (entry.name == name && quasimc::is_of_sensors(entry.quantity)) {
                return entry;
            }
        }
    }
    return quasimc::quantity_table()[static_cast<std::size_t>(Quantity::incident_upper)];
}

std::size_t drawn_band(const quasimc::RunFile& run) {
    const auto& bands = run.scene.bands();
    const auto found = std::find_if(bands.begin(), bands.end(), [&](const quasimc::Band& band) {
        return !run.output.bands.empty() && band.name == run.output.bands.front();
    });
    return found == bands.end() ? 0 : static_cast<std::size_t>(found - bands.begin());
}

/// @param first  index of the first sensor of the set
/// @param light  of all sensors: a Result or a SeriesSum
template <typename Light>
quasimc::ArrayMap map_of(
    const quasimc::RunFile& run,
    const quasimc::SensorSet& set,
    std::size_t first,
    const Light& light) {
    const quasimc::QuantityEntry entry = drawn_quantity(run);
    const std::size_t b = drawn_band(run);
    const quasimc::Band& band = run.scene.bands()[b];
    constexpr bool kIsSum = std::is_same_v<Light, quasimc::SeriesSum>;
    const bool is_fluence =
        set.receiver == quasimc::Receiver::sphere && entry.quantity == Quantity::incident_upper;
    quasimc::ArrayMap map;
    map.title = fmt::format(
        "{}: {} {} [{}]", set.name, is_fluence ? quasimc::kFluenceRate : entry.name, band.name,
        kIsSum ? quasimc::summed_unit(band.unit).name : band.unit);
    map.columns = set.counts[0];
    map.rows = set.counts[1];
    const auto gap = [&](std::size_t other) {
        return length(set.points[other].position - set.points[0].position);
    };
    map.aspect = gap(map.columns) > 0 ? std::clamp(gap(1) / gap(map.columns), 0.1, 10.0) : 1;
    for (std::size_t i = 0; i < set.points.size(); ++i) {
        map.values.push_back(quasimc::reported(light.at(first + i, entry.quantity, b)).mean);
    }
    const std::vector<double> same(map.values.size(), 1);
    map.legend = quasimc::scale_of(map.values, same, quasimc::color_map_table().front());
    return map;
}

/// Draws the maps of all arrays at the end.
class SensorMaps final : public quasimc::OutputWriter {
  public:
    explicit SensorMaps(const quasimc::OutputInput& input)
        : run_(&input.run), sink_(input.sink), where_(input.where) {}

    void next_run(
        const quasimc::RunFile& run, const quasimc::SeriesSummary& /*series_summary*/) override {
        run_ = &run;
    }
    void on_time_step(const quasimc::TimeStepResult& step) override {
        if (!run_->series && step.result.sensors) {
            draw(*step.result.sensors);
        }
    }
    void finish(const quasimc::SeriesSummary& series_summary) override {
        if (run_->series && series_summary.total.sensors) {
            draw(*quasimc::in_summed_units(*run_, series_summary.total).sensors);
        }
        if (!image_) {
            throw quasimc::InputError(
                {{where_, "there is no light on sensors to draw",
                  "the run was stopped before it was computed", ""}});
        }
        sink_(quasimc::to_png(*image_));
    }
    [[nodiscard]] bool wants(quasimc::SeriesPart part) const override {
        return part ==
               (run_->series ? quasimc::SeriesPart::total : quasimc::SeriesPart::time_steps);
    }

  private:
    template <typename Light>
    void draw(const Light& light) {
        std::vector<quasimc::Image> images;
        std::size_t first = 0;
        for (const quasimc::SensorSet& set : run_->scene.sensors()) {
            if (is_map(set)) {
                images.push_back(quasimc::draw_array_map(map_of(*run_, set, first, light)));
            }
            first += set.rows();
        }
        image_ = quasimc::stacked(images);
    }

    const quasimc::RunFile* run_;
    quasimc::TextSink sink_;
    std::string where_;
    std::optional<quasimc::Image> image_;
};

}  // namespace

namespace quasimc {

std::unique_ptr<OutputWriter> make_sensors_picture(const OutputInput& input) {
    require_pictures(input.where);
    check_picture_name(input.where, input.path);
    const std::vector<SensorSet>& sets = input.run.scene.sensors();
    if (std::none_of(sets.begin(), sets.end(), is_map)) {
        throw InputError(
            {{input.where, "no [[sensors]] is an array", "a map needs rows and columns of points",
              "give at = { start = ..., along = ..., across = ..., counts = [n, m] }"}});
    }
    return std::make_unique<SensorMaps>(input);
}

}  // namespace quasimc
