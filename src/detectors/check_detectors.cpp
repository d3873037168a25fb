#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "base/text.h"
#include "detectors/catalogue.h"

namespace quasimc {
namespace {

template <typename Row>
std::vector<std::string_view> names_of(std::span<const Row> rows) {
    std::vector<std::string_view> names;
    for (const Row& row : rows) {
        names.push_back(row.name);
    }
    return names;
}

void check_value(
    const DetectorParameter& parameter, double value, const std::string& where, Faults& faults) {
    const bool is_whole = parameter.kind == NumberKind::real || value == std::floor(value);
    if (!(value >= parameter.low && value <= parameter.high) || !is_whole) {
        faults.add(
            {.where = where,
             .problem = fmt::format("{} is {}", parameter.name, shortest(value)),
             .why = fmt::format(
                 "{}{} ... {}", parameter.kind == NumberKind::whole ? "a whole number, " : "",
                 shortest(parameter.low), shortest(parameter.high)),
             .suggestion = ""});
    }
}

void check_parameters(const DetectorSpec& spec, const DetectorEntry& type, Faults& faults) {
    for (const DetectorParameter& parameter : type.parameters) {
        const auto given = spec.parameters.find(parameter.name);
        if (given != spec.parameters.end()) {
            check_value(parameter, given->second, spec.where, faults);
        } else if (!parameter.usual) {
            faults.add({spec.where, fmt::format("{} is missing", parameter.name), "", ""});
        }
    }
    const std::vector<std::string_view> known = names_of(type.parameters);
    for (const auto& [name, value] : spec.parameters) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            faults.add(
                {.where = spec.where,
                 .problem = fmt::format("{} takes no '{}'", type.name, name),
                 .why = "",
                 .suggestion = did_you_mean(name, known)});
        }
    }
}

}  // namespace

std::vector<DetectorSpec> check_detectors(std::vector<DetectorSpec> specs, Faults& faults) {
    std::set<std::string_view> names;
    for (DetectorSpec& spec : specs) {
        spec.name = spec.name.empty() ? spec.type : spec.name;
        spec.where = spec.where.empty() ? fmt::format("detector '{}'", spec.name) : spec.where;
        if (!names.insert(spec.name).second) {
            faults.add(
                {spec.where, fmt::format("detector '{}' exists already", spec.name),
                 "names must be unique", "give it a name"});
        }
        if (const DetectorEntry* type = find_detector(spec.type)) {
            check_parameters(spec, *type, faults);
        } else {
            faults.add(
                {spec.where, fmt::format("no detector '{}'", spec.type), "",
                 did_you_mean(spec.type, names_of(detector_catalogue()))});
        }
    }
    return specs;
}

}  // namespace quasimc
