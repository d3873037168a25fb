#include "show_true_light.h"

#include "show_colors.h"

namespace {

/// Colours of leaves and soil for scenes of one band.
std::vector<quasimc::LinearRgb> tints_of(const quasimc::Scene& scene) {
    constexpr quasimc::LinearRgb kLeaf{0.4, 0.8, 0.2}, kSoil{0.6, 0.45, 0.3};
    std::vector<quasimc::LinearRgb> tints;
    tints.reserve(scene.organs().size());
    for (const quasimc::Organ& organ : scene.organs()) {
        tints.push_back(organ.is_ground ? kSoil : kLeaf);
    }
    return tints;
}

}  // namespace

quasimc::TrueLightSpec true_light_of(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    if (shown.result_text.empty()) {
        throw quasimc::InputError(
            {{path, "is not a result", "--realistic shows light",
              "give what `quasimc run --json` wrote"}});
    }
    const std::vector<quasimc::Band>& bands = shown.run.scene.bands();
    quasimc::TrueLightSpec spec;
    spec.bands = quasimc::colors_of_bands(bands);
    if (spec.bands.empty()) {
        throw quasimc::InputError(
            {{path, "has no band that an eye sees",
              "of none are wavelengths of 400 to 700 nm known",
              "state them in [[band]]: from_nm, to_nm"}});
    }
    if (bands.size() == 1) {
        spec.tints = tints_of(shown.run.scene);
    }
    const std::size_t organs = shown.run.scene.organs().size();
    spec.scattered.resize(organs * bands.size());
    for (std::size_t b = 0; b < bands.size(); ++b) {
        ValueChoice scattered = choice;
        scattered.quantity = "incident_scattered";
        scattered.band = bands[b].name;
        const ShownValues values = read_shown_values(shown, path, scattered);
        spec.sources = sources_at(shown.run, values.when);
        if (spec.sources == nullptr) {
            throw quasimc::InputError(
                {{"--realistic", path + ": no time was chosen", "an eye sees one moment",
                  "give it: --time 2024-06-21T12"}});
        }
        for (std::size_t i = 0; i < organs; ++i) {
            spec.scattered[i * bands.size() + b] = values.estimates[i].mean;
        }
    }
    return spec;
}
