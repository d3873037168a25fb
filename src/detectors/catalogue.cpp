// To add a type of detector, tools/new.py detector NAME makes name.cpp (a class derived from
// Detector), name_test.cpp and docs/theory/name.md, and enters the type here. The keys in
// [[detector]], their checks, `type = "name"` and `quasimc list detectors` follow from the row;
// tests/unit/detectors/every_detector_test.cpp tries every row.

#include "detectors/catalogue.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/checks.h"
#include "base/text.h"

namespace quasimc {

std::unique_ptr<Detector> make_escaped_by_zenith(std::span<const double> values);
// (tools/new.py declares a detector above this line)

namespace {

constexpr std::array kEscapedByZenith{DetectorParameter{
    .name = "rings",
    .summary = "of the zenith angle, 0 to 180 degrees",
    .kind = NumberKind::whole,
    .low = 1,
    .high = 180,
    .usual = 9}};

// (tools/new.py enters the parameters of a detector above this line)

constexpr std::array kDetectors{
    DetectorEntry{
        .name = "escaped_by_zenith",
        .summary = "scattered light that leaves the scene, by rings of the zenith angle",
        .light = DetectedLight::escaped,
        .parameters = kEscapedByZenith,
        .make = make_escaped_by_zenith},
    // (tools/new.py enters a detector above this line)
};

}  // namespace

std::span<const DetectorEntry> detector_catalogue() {
    return kDetectors;
}

const DetectorEntry* find_detector(std::string_view name) {
    const auto* found = std::find_if(
        kDetectors.begin(), kDetectors.end(),
        [&](const DetectorEntry& entry) { return entry.name == name; });
    return found == kDetectors.end() ? nullptr : found;
}

std::unique_ptr<Detector> make_detector(const DetectorSpec& spec) {
    const DetectorEntry* type = find_detector(spec.type);
    EXPECT(type != nullptr);
    std::vector<double> values;
    for (const DetectorParameter& parameter : type->parameters) {
        const auto given = spec.parameters.find(parameter.name);
        EXPECT(given != spec.parameters.end() || parameter.usual.has_value());
        values.push_back(given != spec.parameters.end() ? given->second : parameter.usual.value());
    }
    return type->make(values);
}

bool need_escaped_light(std::span<const DetectorSpec> specs) {
    return std::any_of(specs.begin(), specs.end(), [](const DetectorSpec& spec) {
        const DetectorEntry* type = find_detector(spec.type);
        return type != nullptr && type->light == DetectedLight::escaped;
    });
}

std::string describe_parameters(const DetectorEntry& type) {
    std::string words;
    for (const DetectorParameter& parameter : type.parameters) {
        words += fmt::format(
            "{}{} {} ... {}", words.empty() ? "" : ", ", parameter.name, shortest(parameter.low),
            shortest(parameter.high));
    }
    return words;
}

}  // namespace quasimc
