#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "detectors/catalogue.h"
#include "meshio/formats.h"
#include "netcdf/netcdf_writer.h"
#include "optics/catalogue.h"
#include "optics/default_optics.h"
#include "options/options.h"
#include "quasimc/quasimc.h"
#include "resultio/field_formats.h"
#include "runfile/output_catalogue.h"

namespace {

std::string list_row(std::string_view name, std::string_view summary) {
    return fmt::format("{:<23} {}\n", name, summary);
}

/// A row for each entry with its parameters.
template <typename Table>
std::string list_table(const Table& table) {
    std::string text;
    for (const auto& entry : table) {
        std::string summary(entry.summary);
        if constexpr (requires { quasimc::describe_parameters(entry); }) {
            const std::string parameters = quasimc::describe_parameters(entry);
            summary += parameters.empty() ? "" : fmt::format(" ({})", parameters);
        }
        text += list_row(entry.name, summary);
    }
    return text;
}

std::string list_optics() {
    std::string text;
    for (const quasimc::DefaultOptics& optics : quasimc::usual_optics()) {
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

std::string list_formats() {
    const auto row = [](std::string_view name, std::string_view extensions, std::string_view ways,
                        std::string_view keeps, std::string_view summary) {
        return fmt::format(
            "{:<11} {:<11} {:<12} {:<40} {}\n", name, extensions, ways, keeps, summary);
    };
    std::string text = row("geometry", "extension", "", "keeps", "");
    for (const quasimc::FormatEntry& format : quasimc::format_table()) {
        text +=
            row(format.name, format.extensions, format.write == nullptr ? "read" : "read, write",
                format.keeps.empty() ? "-" : format.keeps, format.summary);
    }
    text += row("\nresults", "", "", "", "");
    for (const quasimc::FieldFormat& format : quasimc::field_format_table()) {
        text +=
            row(format.name, format.extension, "write", "ids, every quantity and its error",
                format.summary);
    }
    return text +
           row("opf", ".opf", "write", "the file, every quantity and its error",
               "into the OPF file that the run was made from, as attributes of its nodes") +
           row("netcdf", ".nc", quasimc::has_netcdf() ? "write" : "not built in",
               "names, labels, all times, points, errors",
               "NetCDF after the CF conventions for xarray, R and others");
}

/// The keys of [output] that name files; their flags have hyphens.
std::string list_outputs() {
    std::string text;
    for (const quasimc::OutputKey& key : quasimc::output_keys()) {
        text += list_row(key.name, key.summary);
    }
    return text;
}

std::string list_options() {
    std::string text;
    for (const quasimc::Option& option : quasimc::option_table()) {
        const std::string value = quasimc::option_toml(option.get(quasimc::RunSpec{}));
        text += list_row(
            fmt::format("{} = {}", option.key, value),
            fmt::format("{} ({})", option.summary, quasimc::domain_text(option)));
    }
    return text;
}

/// One row of the table of lists.
struct ListEntry {
    std::string name;
    std::string (*make)();
};

const std::vector<ListEntry>& lists() {
    static const std::vector<ListEntry> all{
        {"options", list_options},
        {"samplers", [] { return list_table(quasimc::sampler_models()); }},
        {"models", [] { return list_table(quasimc::bsdf_catalogue()); }},
        {"optics", list_optics},
        {"detectors", [] { return list_table(quasimc::detector_catalogue()); }},
        {"formats", list_formats},
        {"outputs", list_outputs},
        {"skies",
         [] {
             return list_table(quasimc::sky_catalogue()) +
                    list_row("table", "radiance of cells of azimuth and elevation, from a file");
         }},
        {"quantities",
         [] {
             return list_table(quasimc::quantity_table()) + list_table(quasimc::sun_shade_table());
         }},
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
        "list options, samplers, models, optics, detectors, formats, outputs, skies or quantities",
        {{.name = "WHAT",
          .target = name.get(),
          .summary = "what to list",
          .required = true,
          .choices = names}},
        [name] { return print_list(*name); }};
}
