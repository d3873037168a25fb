#include "optics/catalogue.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.h"
#include "optics/blinn_phong.h"
#include "optics/lambertian.h"
#include "optics/mirror.h"
#include "optics/phong.h"

namespace quasimc {

// To add a model, tools/new.py bsdf NAME makes name.cpp (a class derived from Bsdf), name_test.cpp
// and docs/theory/name.md, and enters the model here. Mind the contract of Bsdf: the integral of
// pdf is 1 for every wi, no light on the wrong side. The keys of the run file, their checks and
// `quasimc list models` follow from the row; tests/unit/optics/models_test.cpp tries every row over
// a grid of its parameters.

std::unique_ptr<Bsdf> make_coated_lambertian(Hemisphere hemisphere, std::span<const double> values);
std::unique_ptr<Bsdf> make_clipped_blinn_phong(
    Hemisphere hemisphere, std::span<const double> values);
// (tools/new.py declares a model above this line)

namespace {

constexpr std::array kExponent{BsdfParameter{
    .name = "exponent",
    .low = 0,
    .high = kMaxExponent,
    .usual = std::nullopt,
    .summary = "the larger, the narrower the lobe",
    .suggestion = "for one direction use model 'mirror'"}};

constexpr std::array kCoat{BsdfParameter{
    .name = "coat",
    .low = 0,
    .high = 0.9,
    .usual = 0.04,
    .summary = "reflectance of the coat at normal incidence"}};

// (tools/new.py enters the parameters of a model above this line)

constexpr std::array kModels = {
    BsdfEntry{
        "lambertian",
        "Lambert's cosine law",
        {},
        [](Hemisphere side, std::span<const double>) { return make_lambertian(side); }},
    BsdfEntry{
        "phong", "glossy: cos^n of the angle to the specular direction", kExponent,
        [](Hemisphere side, std::span<const double> p) { return make_phong(side, p[0]); }},
    BsdfEntry{
        "blinn_phong", "glossy: cos^n of half the angle to the specular direction", kExponent,
        [](Hemisphere side, std::span<const double> p) { return make_blinn_phong(side, p[0]); }},
    BsdfEntry{
        "mirror",
        "one direction: mirrored if reflected, straight on if transmitted",
        {},
        [](Hemisphere side, std::span<const double>) { return make_mirror(side); }},
    BsdfEntry{
        "coated_lambertian",
        "Lambert's cosine law for the interior of a waxy leaf; light reflected by its coat counts "
        "as absorbed",
        kCoat, make_coated_lambertian},
    BsdfEntry{
        "clipped_blinn_phong", "blinn_phong cut off at the surface, as in the original QuasiMC",
        kExponent, make_clipped_blinn_phong},
    // (tools/new.py enters a model above this line)
};

}  // namespace

const BsdfParameter* BsdfEntry::find_parameter(std::string_view parameter) const {
    for (const BsdfParameter& p : parameters) {
        if (p.name == parameter) {
            return &p;
        }
    }
    return nullptr;
}

std::span<const BsdfEntry> bsdf_catalogue() {
    return kModels;
}

const BsdfEntry* find_bsdf(std::string_view name) {
    for (const BsdfEntry& entry : kModels) {
        if (entry.name == name) {
            return &entry;
        }
    }
    return nullptr;
}

std::vector<BsdfParameter> parameters_of_all(std::span<const BsdfEntry> models) {
    std::vector<BsdfParameter> all;
    for (const BsdfEntry& model : models) {
        for (const BsdfParameter& parameter : model.parameters) {
            const auto known = std::find_if(all.begin(), all.end(), [&](const BsdfParameter& p) {
                return p.name == parameter.name;
            });
            if (known == all.end()) {
                all.push_back(parameter);
            } else {
                known->low = std::min(known->low, parameter.low);
                known->high = std::max(known->high, parameter.high);
            }
        }
    }
    return all;
}

std::vector<double> parameter_values(const BsdfEntry& model, const BsdfParameters& given) {
    std::vector<double> values;
    for (const BsdfParameter& parameter : model.parameters) {
        const auto found = given.find(parameter.name);
        values.push_back(
            found != given.end()
                ? found->second
                : parameter.usual.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return values;
}

std::string describe_parameters(const BsdfEntry& model) {
    std::string words;
    for (const BsdfParameter& p : model.parameters) {
        words += fmt::format(
            "{}{} {} ... {}{}", words.empty() ? "" : ", ", p.name, shortest(p.low),
            shortest(p.high), p.usual ? fmt::format(" (else {})", shortest(*p.usual)) : "");
    }
    return words;
}

}  // namespace quasimc
