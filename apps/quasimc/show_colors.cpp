#include "show_colors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "base/vec3.h"
#include "light/models/source.h"
#include "text/numbers.h"

namespace {

using quasimc::Estimate;
using quasimc::Legend;
using quasimc::Organ;
using quasimc::Rgb;
using quasimc::Scene;

/// Numbers in ascending order, then other texts in order of appearance.
std::vector<std::string> values_of_label(const Scene& scene, const std::string& key) {
    std::vector<std::string> values;
    std::unordered_set<std::string> known;
    for (const Organ& organ : scene.organs()) {
        const std::string* label = quasimc::find_label(organ.labels, key);
        if (!organ.is_ground && label != nullptr && known.insert(*label).second) {
            values.push_back(*label);
        }
    }
    const auto number = [](const std::string& text) {
        return quasimc::parse_real(text).value_or(std::numeric_limits<double>::infinity());
    };
    std::ranges::stable_sort(values, {}, number);
    return values;
}

/// Many different numbers are a scale.
bool are_scale(const std::vector<std::string>& values) {
    constexpr std::size_t kManyNumbers = 20;
    return values.size() > kManyNumbers && std::ranges::all_of(values, [](const auto& value) {
               return quasimc::parse_real(value).has_value();
           });
}

void color_by_number(const Scene& scene, const std::string& key, quasimc::ScenePicture& picture) {
    std::vector<double> numbers, areas;
    for (const Organ& organ : scene.organs()) {
        const std::string* label = quasimc::find_label(organ.labels, key);
        numbers.push_back(
            organ.is_ground || label == nullptr ? std::nan("") : *quasimc::parse_real(*label));
        areas.push_back(organ.area);
    }
    const auto is_less = [](double a, double b) { return std::isnan(b) || a < b; };
    const double low = *std::ranges::min_element(numbers, is_less);
    const double high = *std::ranges::max_element(
        numbers, [](double a, double b) { return std::isnan(a) || a < b; });
    picture.legend =
        quasimc::scale_of(numbers, areas, quasimc::color_map_table().front(), {low, high});
    picture.legend.categories.clear();
    picture.render.colors = quasimc::colors_of(numbers, picture.legend);
}

/// Gives the ground and organs without a label their colours.
void color_others(const Scene& scene, const std::string& key, quasimc::ScenePicture& picture) {
    bool has_ground = false, has_others = false;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        if (organ.is_ground) {
            picture.render.colors[i] = quasimc::kEarth;
            has_ground = true;
        } else if (quasimc::find_label(organ.labels, key) == nullptr) {
            picture.render.colors[i] = quasimc::kNoValue;
            has_others = true;
        }
    }
    if (has_others) {
        picture.legend.categories.emplace_back("no " + key, quasimc::kNoValue);
    }
    if (has_ground) {
        picture.legend.categories.emplace_back("ground", quasimc::kEarth);
    }
}

/// The mean of the known values, weighted by area.
double mean_over_area(const Scene& scene, const std::vector<Estimate>& estimates) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        if (std::isfinite(estimates[i].mean)) {
            sum += scene.organs()[i].area * std::abs(estimates[i].mean);
            area += scene.organs()[i].area;
        }
    }
    return area > 0 ? sum / area : 0;
}

/// A category of its own for each kind of organ without a relative error.
struct ErrorColor {
    std::string_view name;
    Rgb color;
};
ErrorColor error_color(const Estimate& e, double mean) {
    constexpr double kFaint = 1e-3;
    if (!std::isfinite(e.mean)) {
        return {"no value", quasimc::kNoValue};
    }
    if (e.mean == 0) {
        return {"no light found", quasimc::kNoValue};
    }
    if (std::abs(e.mean) < kFaint * mean) {
        return {"too little light", quasimc::kTooFaint};
    }
    for (const quasimc::ErrorClass& one : quasimc::error_class_table()) {
        if (e.standard_error / std::abs(e.mean) < one.below) {
            return {one.name, one.color};
        }
    }
    return {"unknown error", quasimc::kNoValue};
}

void color_by_error(const Scene& scene, const ShownValues& values, quasimc::ScenePicture& picture) {
    auto& categories = picture.legend.categories;
    for (const quasimc::ErrorClass& one : quasimc::error_class_table()) {
        categories.emplace_back(one.name, one.color);
    }
    const double mean = mean_over_area(scene, values.estimates);
    for (const Estimate& estimate : values.estimates) {
        const ErrorColor own = error_color(estimate, mean);
        picture.render.colors.push_back(own.color);
        const bool is_listed = std::ranges::any_of(
            categories, [&](const auto& category) { return category.first == own.name; });
        if (!is_listed) {
            categories.emplace_back(own.name, own.color);
        }
    }
}

void color_by_difference(
    const Scene& scene,
    const ShownValues& values,
    std::pair<double, double> range,
    quasimc::ScenePicture& picture) {
    constexpr Rgb kSmall{0xC4, 0xC9, 0xC6};
    constexpr double kNormal95 = 1.96;
    std::vector<double> numbers, sizes, areas;
    for (std::size_t i = 0; i < values.estimates.size(); ++i) {
        numbers.push_back(values.estimates[i].mean);
        sizes.push_back(std::abs(numbers.back()));
        areas.push_back(scene.organs()[i].area);
    }
    Legend& legend = picture.legend;
    legend = quasimc::scale_of(sizes, areas, quasimc::difference_map(), range);
    if (range.first == range.second) {
        legend.low = -legend.high;
    }
    picture.render.colors = quasimc::colors_of(numbers, legend);
    bool has_small = false;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (sizes[i] < kNormal95 * values.estimates[i].standard_error) {
            picture.render.colors[i] = kSmall;
            has_small = true;
        }
    }
    if (has_small) {
        legend.categories.emplace_back("below its error", kSmall);
    }
}

}  // namespace

void color_plainly(const quasimc::Scene& scene, quasimc::ScenePicture& picture) {
    picture.subtitle = fmt::format(
        "{}, {}", quasimc::counted(scene.organs().size(), "organ"),
        quasimc::counted(scene.triangle_count(), "triangle"));
    picture.render.shading = 0.7;
    for (const Organ& organ : scene.organs()) {
        picture.render.colors.push_back(organ.is_ground ? quasimc::kEarth : Rgb{150, 190, 110});
    }
}

void color_by_label(
    const quasimc::Scene& scene, const std::string& key, quasimc::ScenePicture& picture) {
    const std::vector<std::string> values = values_of_label(scene, key);
    if (values.empty()) {
        throw quasimc::InputError(
            {{"--label", fmt::format("no organ has a label '{}'", key), "", ""}});
    }
    if (are_scale(values)) {
        color_by_number(scene, key, picture);
    } else {
        const std::vector<Rgb> colors = quasimc::category_colors(values.size());
        std::unordered_map<std::string, Rgb> color_of;
        for (std::size_t i = 0; i < values.size(); ++i) {
            picture.legend.categories.emplace_back(values[i], colors[i]);
            color_of[values[i]] = colors[i];
        }
        for (const Organ& organ : scene.organs()) {
            const std::string* label = quasimc::find_label(organ.labels, key);
            picture.render.colors.push_back(
                label == nullptr ? quasimc::kNoValue : color_of[*label]);
        }
    }
    color_others(scene, key, picture);
    picture.subtitle = fmt::format("by {}", key);
    picture.render.shading = 0.5;
}

void color_by_value(
    const quasimc::Scene& scene,
    const ShownValues& values,
    const ScaleChoice& choice,
    quasimc::ScenePicture& picture) {
    picture.subtitle = choice.error ? fmt::format("relative standard error of {}", values.name)
                       : values.unit.empty() ? values.name
                                             : fmt::format("{} ({})", values.name, values.unit);
    if (!values.when.empty()) {
        picture.subtitle += ", " + values.when;
    }
    if (!values.minus.empty()) {
        picture.subtitle += ", minus " + values.minus;
        color_by_difference(scene, values, choice.range, picture);
        return;
    }
    if (choice.error) {
        color_by_error(scene, values, picture);
        return;
    }
    std::vector<double> numbers, areas;
    for (std::size_t i = 0; i < values.estimates.size(); ++i) {
        numbers.push_back(values.estimates[i].mean);
        areas.push_back(scene.organs()[i].area);
    }
    picture.legend =
        quasimc::scale_of(numbers, areas, *quasimc::find_color_map(choice.colors), choice.range);
    picture.render.colors = quasimc::colors_of(numbers, picture.legend);
}

const quasimc::Sources* sources_at(const quasimc::RunFile& run, const std::string& when) {
    if (!run.series) {
        return &run.sources;
    }
    for (std::size_t i = 0; i < run.series->notes.size(); ++i) {
        if (run.series->notes[i].time == when) {
            return &run.series->time_steps[i].sources;
        }
    }
    return nullptr;
}

std::vector<quasimc::Vec3> suns_of(const quasimc::Sources* sources, bool is_time_step) {
    std::vector<quasimc::Vec3> suns;
    quasimc::Vec3 sum{};
    for (const auto& source : sources != nullptr ? *sources : quasimc::Sources{}) {
        if (source->is_sun()) {
            suns.push_back(model_of(*source).illuminate({}, 0.5, 0.5).to_light);
            const auto spectrum = source->spectrum();
            sum = sum + std::accumulate(spectrum.begin(), spectrum.end(), 0.0) * suns.back();
        }
    }
    return is_time_step && length(sum) > 0 ? std::vector{quasimc::normalized(sum)} : suns;
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
