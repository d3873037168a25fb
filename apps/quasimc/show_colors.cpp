#include "show_colors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "light/models/source.h"

void color_plainly(const quasimc::Scene& scene, quasimc::ScenePicture& picture) {
    picture.subtitle = fmt::format(
        "{}, {}", quasimc::counted(scene.organs().size(), "organ"),
        quasimc::counted(scene.triangle_count(), "triangle"));
    picture.render.shading = 0.7;
    for (const quasimc::Organ& organ : scene.organs()) {
        picture.render.colors.push_back(
            organ.is_ground ? quasimc::Rgb{190, 170, 150} : quasimc::Rgb{150, 190, 110});
    }
}

void color_by_label(
    const quasimc::Scene& scene, const std::string& key, quasimc::ScenePicture& picture) {
    auto& categories = picture.legend.categories;
    for (const quasimc::Organ& organ : scene.organs()) {
        const auto label = std::find_if(
            organ.labels.begin(), organ.labels.end(),
            [&](const auto& own) { return own.first == key; });
        if (label == organ.labels.end()) {
            picture.render.colors.push_back(quasimc::kNoValue);
            continue;
        }
        auto found = std::find_if(categories.begin(), categories.end(), [&](const auto& category) {
            return category.first == label->second;
        });
        if (found == categories.end()) {
            categories.emplace_back(label->second, quasimc::category_color(categories.size()));
            found = categories.end() - 1;
        }
        picture.render.colors.push_back(found->second);
    }
    if (categories.empty()) {
        throw quasimc::InputError(
            {{"--label", fmt::format("no organ has a label '{}'", key), "", ""}});
    }
    picture.subtitle = fmt::format("by {}", key);
    picture.render.shading = 0.5;
}

void color_by_value(
    const quasimc::Scene& scene,
    const ShownValues& values,
    const ScaleChoice& choice,
    quasimc::ScenePicture& picture) {
    std::vector<double> numbers, areas;
    for (std::size_t i = 0; i < values.estimates.size(); ++i) {
        const quasimc::Estimate& e = values.estimates[i];
        const double error = e.mean == 0 ? std::nan("") : 100 * e.standard_error / std::abs(e.mean);
        numbers.push_back(choice.error ? error : e.mean);
        areas.push_back(scene.organs()[i].area);
    }
    picture.subtitle = choice.error          ? fmt::format("standard error of {} (%)", values.name)
                       : values.unit.empty() ? values.name
                                             : fmt::format("{} ({})", values.name, values.unit);
    if (!values.when.empty()) {
        picture.subtitle += ", " + values.when;
    }
    picture.legend =
        quasimc::scale_of(numbers, areas, *quasimc::find_color_map(choice.colors), choice.range);
    picture.render.colors = quasimc::colors_of(numbers, picture.legend);
}

std::vector<quasimc::Vec3> suns_of(const quasimc::RunFile& run, const ShownValues* values) {
    std::vector<quasimc::Vec3> suns;
    const auto add = [&suns](const quasimc::Sources& sources) {
        for (const auto& source : sources) {
            if (source->is_sun()) {
                suns.push_back(model_of(*source).illuminate({}, 0.5, 0.5).to_light);
            }
        }
    };
    if (!run.series) {
        add(run.sources);
        return suns;
    }
    for (std::size_t i = 0; values != nullptr && i < run.series->notes.size(); ++i) {
        if (run.series->notes[i].time == values->when) {
            add(run.series->time_steps[i].sources);
        }
    }
    return suns;
}

void check_picture_name(const std::string& where, const std::string& path) {
    const std::string ending =
        quasimc::lower_case(std::filesystem::path(path).extension().string());
    if (!ending.empty() && ending != ".png") {
        throw quasimc::InputError(
            {{where, fmt::format("can't write {}", ending), "", "name a .png file"}});
    }
}

void require_pictures(const std::string& where) {
    if (!quasimc::has_png()) {
        throw quasimc::InputError(
            {{where, "this program can't draw pictures",
              "it was built without libpng, stb or a font", ""}});
    }
}
