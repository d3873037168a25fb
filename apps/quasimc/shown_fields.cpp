#include "shown_fields.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "show_colors.h"

quasimc::FieldScene field_scene(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all, const ShownValues* colored) {
    quasimc::FieldScene shown{scene, {}, {}, ""};
    for (const ShownValues& values : all) {
        quasimc::OrganField mean{values.key, values.unit, {}};
        quasimc::OrganField error{values.key + "_standard_error", values.unit, {}};
        for (const quasimc::Estimate& estimate : values.estimates) {
            mean.values.push_back(quasimc::reported(estimate).mean);
            error.values.push_back(estimate.standard_error);
        }
        shown.fields.push_back(std::move(mean));
        shown.fields.push_back(std::move(error));
    }
    if (colored != nullptr) {
        quasimc::ScenePicture picture;
        color_by_value(scene, *colored, {}, picture);
        for (const quasimc::Rgb& color : picture.render.colors) {
            shown.colors.push_back({color.r, color.g, color.b});
        }
        shown.colors_of = fmt::format(
            "{}: {} from {:.6g} to {:.6g}", picture.subtitle, picture.legend.map->name,
            picture.legend.low, picture.legend.high);
    }
    return shown;
}

const ShownValues& chosen_values(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all, const ValueChoice& choice) {
    const std::string& band = choice.band.empty() ? scene.bands().front().name : choice.band;
    const std::string key = fmt::format("{}_{}", choice.quantity, band);
    const auto found = std::find_if(all.begin(), all.end(), [&](const ShownValues& values) {
        return values.key == key || values.key == choice.quantity;
    });
    if (found == all.end()) {
        std::vector<std::string> keys;
        keys.reserve(all.size());
        for (const ShownValues& values : all) {
            keys.push_back(values.key);
        }
        throw quasimc::InputError(
            {{"--quantity", fmt::format("the result has no {}", key), "",
              fmt::format("it has {}; --quantity and --band choose", fmt::join(keys, ", "))}});
    }
    return *found;
}
