// Outputs that show the light on the scene: pictures, and files for other programs. In runs with
// [time] they show the sum, in sweeps the last point.

#include <algorithm>
#include <utility>

#include "quasimc/quasimc.h"
#include "resultio/describe_result.h"
#include "resultio/describe_series.h"
#include "resultio/field_formats.h"
#include "resultio/output_input.h"
#include "runfile/written.h"
#include "show_colors.h"
#include "show_values.h"
#include "shown_fields.h"

namespace {

/// The light of each organ in each quantity and band of the columns.
/// @param light  a Result or a SeriesSum
template <typename Light>
std::vector<ShownValues> light_values(
    const quasimc::RunFile& run, const Light& light, const quasimc::WrittenColumns& columns) {
    constexpr bool kIsSum = std::is_same_v<Light, quasimc::SeriesSum>;
    std::vector<ShownValues> all;
    for (const quasimc::QuantityEntry& entry : columns.quantities) {
        for (const std::size_t b : columns.bands) {
            ShownValues values = named_values(run, entry, run.scene.bands()[b], kIsSum);
            values.when = kIsSum ? "sum of all times" : "";
            for (std::size_t organ = 0; organ < run.scene.organs().size(); ++organ) {
                values.estimates.push_back(quasimc::reported(light.at(organ, entry.quantity, b)));
            }
            all.push_back(std::move(values));
        }
    }
    return all;
}

/// Adds the sunlit fraction and the ratios.
void add_traits(
    const quasimc::RunFile& run, const quasimc::Result& result, std::vector<ShownValues>& all) {
    if (quasimc::written_columns(run).has_sunlit && !result.sunlit_fraction.empty()) {
        all.push_back({result.sunlit_fraction, "sunlit fraction", "", "sunlit_fraction", ""});
    }
    for (std::size_t i = 0; i < result.ratios; ++i) {
        const std::string& name = run.spec.ratios[i];
        ShownValues values{{}, name, "", name, ""};
        for (std::size_t organ = 0; organ < run.scene.organs().size(); ++organ) {
            values.estimates.push_back(result.ratio(organ, i));
        }
        all.push_back(std::move(values));
    }
}

/// Stores the shown values, and writes them at the end.
class LightOnScene final : public quasimc::OutputWriter {
  public:
    using Columns = quasimc::WrittenColumns(const quasimc::RunFile&);
    using Write = std::function<void(
        const quasimc::RunFile&, const std::vector<ShownValues>&, const quasimc::TextSink&)>;
    /// @param columns  which light is shown
    LightOnScene(const quasimc::OutputInput& input, Columns* columns, Write write)
        : run_(&input.run), sink_(input.sink), columns_(columns), write_(std::move(write)) {}

    void next_run(
        const quasimc::RunFile& run, const quasimc::SeriesSummary& /*series_summary*/) override {
        run_ = &run;
    }
    void on_time_step(const quasimc::TimeStepResult& step) override {
        if (!run_->series) {
            values_ = light_values(*run_, step.result, columns_(*run_));
            add_traits(*run_, step.result, values_);
        }
    }
    void finish(const quasimc::SeriesSummary& series_summary) override {
        if (run_->series && !series_summary.total.values.empty()) {
            values_ = light_values(
                *run_, quasimc::in_summed_units(*run_, series_summary.total), columns_(*run_));
        }
        write_(*run_, values_, sink_);
    }
    [[nodiscard]] bool wants(quasimc::SeriesPart part) const override {
        return part ==
               (run_->series ? quasimc::SeriesPart::total : quasimc::SeriesPart::time_steps);
    }

  private:
    const quasimc::RunFile* run_;
    quasimc::TextSink sink_;
    Columns* columns_;
    Write write_;
    std::vector<ShownValues> values_;
};

/// The default of `quasimc show`: the absorbed flux density in the first band.
quasimc::WrittenColumns drawn_columns(const quasimc::RunFile& /*run*/) {
    return {.quantities = {quasimc::quantity_table()[1]}, .bands = {0}, .origins = {}};
}

void draw_picture(
    const quasimc::RunFile& run,
    const std::vector<ShownValues>& all,
    const quasimc::TextSink& sink) {
    ShownValues values = !all.empty() ? all.front()
                                      : named_values(
                                            run, quasimc::quantity_table()[1],
                                            run.scene.bands().front(), run.series.has_value());
    values.estimates.resize(run.scene.organs().size(), quasimc::kUnknownEstimate);
    quasimc::ScenePicture picture;
    picture.title = quasimc::title_of(run);
    color_by_value(run.scene, values, {}, picture);
    picture.to_suns = suns_of(sources_at(run, values.when), run.series.has_value());
    sink(draw_scene(run.scene, picture));
}

std::unique_ptr<quasimc::OutputWriter> make_fields(
    const quasimc::OutputInput& input, std::string_view name) {
    const auto write = [format = quasimc::find_field_format(name)](
                           const quasimc::RunFile& run, const std::vector<ShownValues>& values,
                           const quasimc::TextSink& sink) {
        const auto colored = std::find_if(values.begin(), values.end(), [](const ShownValues& one) {
            return one.key.starts_with("absorbed_flux_density");
        });
        const ShownValues* first = values.empty() ? nullptr : &values.front();
        format->write(
            field_scene(run.scene, values, colored == values.end() ? first : &*colored), sink);
    };
    return std::make_unique<LightOnScene>(input, quasimc::written_columns, write);
}

}  // namespace

namespace quasimc {

std::unique_ptr<OutputWriter> make_picture(const OutputInput& input) {
    require_pictures(input.where);
    check_picture_name(input.where, input.path);
    return std::make_unique<LightOnScene>(input, drawn_columns, draw_picture);
}

std::unique_ptr<OutputWriter> make_vtp(const OutputInput& input) {
    return make_fields(input, "vtp");
}

std::unique_ptr<OutputWriter> make_ply(const OutputInput& input) {
    return make_fields(input, "ply");
}

std::unique_ptr<OutputWriter> make_glb(const OutputInput& input) {
    return make_fields(input, "glb");
}

}  // namespace quasimc
