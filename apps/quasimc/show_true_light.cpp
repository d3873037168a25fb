#include "show_true_light.h"

namespace {

/// The sources of the chosen time step.
const quasimc::Sources& sources_of(
    const quasimc::RunFile& run, const std::string& path, const ShownValues& values) {
    if (!run.series) {
        return run.sources;
    }
    for (std::size_t i = 0; i < run.series->notes.size(); ++i) {
        if (run.series->notes[i].time == values.when) {
            return run.series->time_steps[i].sources;
        }
    }
    throw quasimc::InputError(
        {{"--realistic", path + ": no time was chosen", "an eye sees one moment",
          "give it: --time 2024-06-21T12"}});
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
    const std::size_t organs = shown.run.scene.organs().size();
    spec.scattered.resize(organs * bands.size());
    for (std::size_t b = 0; b < bands.size(); ++b) {
        ValueChoice scattered = choice;
        scattered.quantity = "incident_scattered";
        scattered.band = bands[b].name;
        const ShownValues values = read_shown_values(shown, path, scattered);
        spec.sources = &sources_of(shown.run, path, values);
        for (std::size_t i = 0; i < organs; ++i) {
            spec.scattered[i * bands.size() + b] = values.estimates[i].mean;
        }
    }
    return spec;
}
