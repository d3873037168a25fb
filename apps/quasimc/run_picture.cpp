#include "run_picture.h"

#include <utility>

#include "io/results/series_words.h"
#include "io/runfile/units.h"
#include "show_colors.h"
#include "view/picture.h"

namespace {

/// The light of each organ that is drawn.
template <typename Light>
std::vector<quasimc::Estimate> absorbed(const Light& light, std::size_t organs) {
    std::vector<quasimc::Estimate> values;
    for (std::size_t i = 0; i < organs; ++i) {
        values.push_back(
            quasimc::reported(light.at(i, quasimc::Quantity::absorbed_flux_density, 0)));
    }
    return values;
}

}  // namespace

RunPicture::RunPicture(const quasimc::RunFile& run, std::string path, const std::string& place)
    : run_(&run), path_(std::move(path)) {
    require_pictures(place);
    check_picture_name(place, path_);
}

void RunPicture::add_moment(const quasimc::Result& result) {
    if (!run_->series) {
        last_ = absorbed(result, run_->scene.organs().size());
    }
}

std::string RunPicture::draw(const quasimc::SeriesSummary& summary) const {
    const quasimc::RunFile& run = *run_;
    const std::size_t organs = run.scene.organs().size();
    ShownValues values;
    values.name = "absorbed flux density, " + run.scene.bands().front().name;
    values.unit = quasimc::unit_of(
        quasimc::quantity_table()[1], run.scene.bands().front(), run.scene.length_unit());
    values.estimates = last_;
    if (run.series) {
        values.unit = quasimc::summed_unit(values.unit).name;
        values.when = "sum of all times";
        if (!summary.total.values.empty()) {
            values.estimates = absorbed(quasimc::in_summed_units(run, summary.total), organs);
        }
    }
    values.estimates.resize(organs, quasimc::kUnknownEstimate);
    quasimc::ScenePicture picture;
    picture.title = title_of(run);
    color_by_value(run.scene, values, {}, picture);
    picture.to_suns = suns_of(run, &values);
    const auto canvas = make_canvas(path_, picture.width, picture.height);
    draw_scene(*canvas, run.scene, picture);
    return canvas->finish();
}
