#include "run_picture.h"

#include "resultio/series_words.h"
#include "run_fields.h"
#include "show_colors.h"

RunPicture::RunPicture(
    const quasimc::RunFile& run, const std::string& path, const std::string& place)
    : run_(&run),
      last_(named_values(
          run, quasimc::quantity_table()[1], run.scene.bands().front(), run.series.has_value())) {
    require_pictures(place);
    check_picture_name(place, path);
}

void RunPicture::add_moment(const quasimc::Result& result) {
    if (!run_->series) {
        last_ = light_values(*run_, result, quasimc::quantity_table()[1], 0);
    }
}

std::string RunPicture::draw(const quasimc::SeriesSummary& summary) const {
    const quasimc::RunFile& run = *run_;
    ShownValues values = last_;
    if (run.series && !summary.total.values.empty()) {
        values = light_values(
            run, quasimc::in_summed_units(run, summary.total), quasimc::quantity_table()[1], 0);
    }
    values.estimates.resize(run.scene.organs().size(), quasimc::kUnknownEstimate);
    quasimc::ScenePicture picture;
    picture.title = title_of(run);
    color_by_value(run.scene, values, {}, picture);
    picture.to_suns = suns_of(run, &values);
    return draw_scene(run.scene, picture);
}
