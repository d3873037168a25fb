#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "detectors/catalogue.h"
#include "io/meshes/formats.h"
#include "io/runfile/options.h"
#include "optics/catalogue.h"
#include "optics/usual_optics.h"
#include "quasimc/quasimc.h"

namespace {

std::string list_row(std::string_view name, std::string_view summary) {
    return fmt::format("{:<23} {}\n", name, summary);
}

std::string list_samplers() {
    std::string text;
    for (const quasimc::SamplerModel& sampler : quasimc::sampler_models()) {
        text += list_row(sampler.name, sampler.summary);
    }
    return text;
}

std::string list_models() {
    std::string text;
    for (const quasimc::BsdfEntry& entry : quasimc::bsdf_catalogue()) {
        const std::string parameters = quasimc::parameter_words(entry);
        text += list_row(
            entry.name, parameters.empty() ? std::string(entry.summary)
                                           : fmt::format("{} ({})", entry.summary, parameters));
    }
    return text;
}

std::string list_optics() {
    std::string text;
    for (const quasimc::UsualOptics& optics : quasimc::usual_optics()) {
        const auto words = [](const quasimc::OpticsByRegion& r) {
            return fmt::format("{} / {}", r.visible, r.near_infrared);
        };
        text += list_row(
            optics.name, fmt::format(
                             "{}: reflectance {}, transmittance {}", optics.summary,
                             words(optics.reflectance), words(optics.transmittance)));
    }
    text += list_row(
        "prospect_d",
        "leaves by chlorophyll, water, dry matter: optics = {model = \"prospect_d\", ...}");
    return text +
           list_row(
               "soil", fmt::format(
                           "bare soil, by soil_color (1 bright to {} dark) and water_content",
                           quasimc::kSoilColors));
}

std::string list_detectors() {
    std::string text;
    for (const quasimc::DetectorEntry& entry : quasimc::detector_catalogue()) {
        const std::string parameters = quasimc::parameter_words(entry);
        text += list_row(
            entry.name, parameters.empty() ? std::string(entry.summary)
                                           : fmt::format("{} ({})", entry.summary, parameters));
    }
    return text;
}

std::string list_formats() {
    std::string text;
    for (const quasimc::FormatEntry& entry : quasimc::format_table()) {
        text += list_row(fmt::format("{} ({})", entry.name, entry.extensions), entry.summary);
    }
    return text;
}

std::string list_options() {
    std::string text;
    for (const quasimc::Option& option : quasimc::option_table()) {
        const std::string value = quasimc::option_toml(option.get(quasimc::default_run_spec()));
        text += list_row(
            fmt::format("{} = {}", option.key, value),
            fmt::format("{} ({})", option.summary, quasimc::domain_text(option)));
    }
    return text;
}

std::string list_quantities() {
    std::string text;
    for (const quasimc::QuantityEntry& entry : quasimc::quantity_table()) {
        text += list_row(entry.name, entry.summary);
    }
    return text;
}

std::string list_skies() {
    std::string text;
    for (const quasimc::SkyEntry& entry : quasimc::sky_catalogue()) {
        text += list_row(entry.name, entry.summary);
    }
    return text + list_row("table", "radiance of cells of azimuth and elevation, from a file");
}

/// One row of the table of lists.
struct ListEntry {
    std::string name;
    std::string (*make)();
};

const std::vector<ListEntry>& lists() {
    static const std::vector<ListEntry> all{
        {"options", list_options},
        {"samplers", list_samplers},
        {"models", list_models},
        {"optics", list_optics},
        {"detectors", list_detectors},
        {"formats", list_formats},
        {"skies", list_skies},
        {"quantities", list_quantities},
        {"options-markdown", quasimc::options_markdown}};
    return all;
}

Exit print_list(const std::string& name) {
    for (const ListEntry& entry : lists()) {
        if (entry.name == name) {
            std::fputs(entry.make().c_str(), stdout);
        }
    }
    return Exit::done;
}

}  // namespace

Command list_command() {
    const auto name = std::make_shared<std::string>();
    std::vector<std::string> names;
    for (const ListEntry& entry : lists()) {
        names.push_back(entry.name);
    }
    return {
        "list",
        "print what there is: options, samplers, models, optics, detectors, formats, skies, "
        "quantities",
        {{.name = "WHAT", .target = name.get(), .summary = "", .required = true, .choices = names}},
        [name] { return print_list(*name); }};
}
