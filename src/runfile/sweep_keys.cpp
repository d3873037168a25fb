#include "runfile/sweep_keys.h"

#include <fmt/format.h>

#include "base/text.h"
#include "options/options.h"

namespace quasimc {
namespace {

/// Keys at the top of a file that are common to all points.
constexpr std::array<std::string_view, 13> kOfAllPoints{
    "title",  "bands",  "band",     "up",      "north",        "length_unit", "irradiance_unit",
    "format", "output", "detector", "sensors", "gap_fraction", "table"};
/// Options that determine the rows and columns of outputs, or that concern all points together.
constexpr std::array<std::string_view, 8> kFixedOptions{"groups",      "layers",  "layer_heights",
                                                        "max_seconds", "origins", "ratios",
                                                        "sun_shade",   "threads"};

/// The section with a table of a name, or "".
std::string_view section_with(const Node& document, std::string_view name) {
    for (const std::string_view section : {"source", "material", "organ", "geometry"}) {
        const Node* list = document.find(section);
        const auto* items = list == nullptr ? nullptr : list->as<Node::List>();
        if (items != nullptr && is_among(name, names_of_items(*items))) {
            return section;
        }
    }
    return "";
}

/// A key of a section, for suggestions.
std::string_view example_of(std::string_view section) {
    constexpr std::array<std::array<std::string_view, 2>, 10> kExamples{
        {{"run", "paths"},
         {"source", "source.sun.elevation_deg"},
         {"material", "material.leaf.reflectance"},
         {"site", "site.latitude_deg"},
         {"time", "time.day"},
         {"control", "control.1.on_below"},
         {"organ", "organ.leaf.material"},
         {"geometry", "geometry.plant.file"},
         {"ground", "ground.material"},
         {"cell", "cell.size"}}};
    const auto found = std::find_if(
        kExamples.begin(), kExamples.end(), [&](const auto& each) { return each[0] == section; });
    return found == kExamples.end() ? "" : (*found)[1];
}

std::string how_to_state(const Node& document, std::string_view path) {
    const std::string_view section = section_with(document, first_part(path));
    if (!section.empty()) {
        return fmt::format("write {}.{}", section, path);
    }
    std::vector<std::string_view> names(kSweptSections.begin(), kSweptSections.end());
    names.insert(names.end(), kSweptGeometry.begin(), kSweptGeometry.end());
    const std::string_view near = nearest_word(first_part(path), names);
    return near.empty() ? "" : fmt::format("did you mean '{}'?", near);
}

bool has_empty_part(std::string_view path) {
    return path.empty() || path.front() == '.' || path.back() == '.' ||
           path.find("..") != std::string_view::npos;
}

/// Checks a key without a section, which must be an option. @returns whether it is refused
bool refuse_single(const Node& document, const SweptKey& key, Reporter& reporter) {
    if (find_option(key.path) != nullptr) {
        return false;
    }
    const bool is_section = is_among(std::string_view(key.path), kSweptSections) ||
                            is_among(std::string_view(key.path), kSweptGeometry);
    const std::string problem = fmt::format("[sweep]: '{}' can't be swept", key.path);
    if (is_section) {
        reporter.fault(
            key.line, problem, "it is a section",
            fmt::format("name one of its keys, as {}", example_of(key.path)));
    } else {
        const std::string_view near = nearest_word(key.path, option_keys());
        reporter.fault(
            key.line, problem, "it is not a run option",
            near.empty() ? how_to_state(document, key.path)
                         : fmt::format("did you mean '{}'?", near));
    }
    return true;
}

}  // namespace

std::string_view first_part(std::string_view path) {
    return path.substr(0, path.find('.'));
}

std::optional<std::string_view> rest_after(std::string_view path, std::string_view name) {
    const bool begins =
        path.size() > name.size() + 1 && path.starts_with(name) && path[name.size()] == '.';
    return begins ? std::optional(path.substr(name.size() + 1)) : std::nullopt;
}

bool is_refused(const Node& document, const SweptKey& key, Reporter& reporter) {
    const std::string path = key.from_top();
    const std::string_view section = first_part(path);
    const bool is_known = is_among(section, kSweptSections) || is_among(section, kSweptGeometry);
    const std::string_view option = section == "run" ? rest_after(path, "run").value_or("") : "";
    const bool is_fixed = is_among(option, kFixedOptions);
    if (has_empty_part(path)) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' is not a key", key.path), "part of it is empty");
        return true;
    }
    if (is_among(first_part(key.path), kOfAllPoints)) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' can't be swept", key.path),
            "it must be the same for all points", "write a run file for each of its values");
        return true;
    }
    if (key.path.find('.') == std::string::npos && refuse_single(document, key, reporter)) {
        return true;
    }
    if (!is_known) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' can't be swept", key.path),
            "it is not a value of run, source, material, site, time, control, organ, geometry, "
            "ground or cell",
            how_to_state(document, key.path));
    } else if (is_fixed) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' can't be swept", key.path),
            "it must be the same for all points", "set it in [run]");
    }
    return !is_known || is_fixed;
}

}  // namespace quasimc
