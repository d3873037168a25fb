// From what a person states of a material to the lobes that are traced.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/checks.h"
#include "base/text.h"
#include "optics/catalogue.h"
#include "optics/material.h"

namespace quasimc {
namespace {

void check_fraction(double value, std::string_view name, const std::string& place, Faults& faults) {
    if (!(value >= 0 && value <= 1)) {
        faults.add(
            {.place = place,
             .problem = fmt::format("{} is {}", name, shortest(value)),
             .why = "a fraction of the light, 0 ... 1",
             .suggestion = value >= 2 && value <= 100
                               ? fmt::format("a percentage? write {}", shortest(value / 100))
                               : ""});
    }
}

void check_model(
    std::string_view what,
    const std::string& model,
    double exponent,
    const std::string& place,
    Faults& faults) {
    const BsdfEntry* entry = find_bsdf(model);
    if (entry == nullptr) {
        std::vector<std::string_view> names;
        for (const BsdfEntry& known : bsdf_catalogue()) {
            names.push_back(known.name);
        }
        faults.add(
            {.place = place,
             .problem = fmt::format("no {} model '{}'", what, model),
             .why = "",
             .suggestion = did_you_mean(model, names)});
    }
    const bool is_used = entry != nullptr && entry->has_exponent;
    const double largest = is_used ? kMaxExponent : std::numeric_limits<double>::max();
    if (!(exponent >= 0 && exponent <= largest)) {
        faults.add(
            {.place = place,
             .problem = fmt::format("{} exponent is {}", what, shortest(exponent)),
             .why = fmt::format("0 ... {}", shortest(kMaxExponent)),
             .suggestion = std::isnan(exponent) ? "" : "for one direction use model 'mirror'"});
    }
}

void check_side(
    const std::vector<SideOptics>& side,
    std::size_t bands,
    const std::string& place,
    Faults& faults) {
    if (side.size() != bands) {
        faults.add(
            {.place = place,
             .problem = fmt::format("optics for {} of the bands", side.size()),
             .why = fmt::format("there are {}", bands),
             .suggestion = ""});
    }
    for (std::size_t b = 0; b < side.size(); ++b) {
        const SideOptics& optics = side[b];
        const std::string band = fmt::format("{}, band {}", place, b + 1);
        check_fraction(optics.reflectance, "reflectance", band, faults);
        check_fraction(optics.transmittance, "transmittance", band, faults);
        const double sum = optics.reflectance + optics.transmittance;
        if (optics.reflectance <= 1 && optics.transmittance <= 1 && sum > 1) {
            faults.add(
                {.place = band,
                 .problem = fmt::format(
                     "reflectance {} + transmittance {} = {}", shortest(optics.reflectance),
                     shortest(optics.transmittance), shortest(sum)),
                 .why = "more than 1 makes light",
                 .suggestion = ""});
        }
        check_model(
            "reflection", optics.reflection_model, optics.reflection_exponent, band, faults);
        check_model(
            "transmission", optics.transmission_model, optics.transmission_exponent, band, faults);
    }
}

/// One lobe of one band.
struct Term {
    const BsdfEntry* model;
    double exponent;  ///< 0 if the model has none
    double albedo;
};

Term term_of(const SideOptics& optics, Hemisphere hemisphere) {
    const bool is_reflected = hemisphere == Hemisphere::reflected;
    const BsdfEntry* model =
        find_bsdf(is_reflected ? optics.reflection_model : optics.transmission_model);
    EXPECT(model != nullptr);
    const double exponent =
        is_reflected ? optics.reflection_exponent : optics.transmission_exponent;
    return {
        model, model->has_exponent ? exponent : 0,
        is_reflected ? optics.reflectance : optics.transmittance};
}

void append_lobes(
    const std::vector<SideOptics>& side, Hemisphere hemisphere, std::vector<Lobe>& lobes) {
    std::vector<Term> distinct;
    const std::size_t first = lobes.size();
    for (std::size_t b = 0; b < side.size(); ++b) {
        const Term term = term_of(side[b], hemisphere);
        if (term.albedo == 0) {
            continue;
        }
        const auto same = std::find_if(distinct.begin(), distinct.end(), [&](const Term& other) {
            return other.model == term.model && other.exponent == term.exponent;
        });
        const std::size_t place = first + static_cast<std::size_t>(same - distinct.begin());
        if (same == distinct.end()) {
            distinct.push_back(term);
            lobes.push_back(
                {term.model->make(hemisphere, term.exponent), std::vector<double>(side.size())});
        }
        lobes[place].albedo[b] = term.albedo;
    }
}

Side make_side(const std::vector<SideOptics>& side) {
    std::vector<Lobe> lobes;
    append_lobes(side, Hemisphere::reflected, lobes);
    append_lobes(side, Hemisphere::transmitted, lobes);
    return {lobes, side.size()};
}

}  // namespace

void check_material(
    const MaterialSpec& spec, std::size_t bands, const std::string& place, Faults& faults) {
    const std::string start = place.empty() ? fmt::format("material '{}'", spec.name) : place;
    check_side(spec.upper, bands, start + ", upper side", faults);
    check_side(spec.lower, bands, start + ", lower side", faults);
}

Material make_material(const MaterialSpec& spec, std::size_t bands) {
    EXPECT(spec.upper.size() == bands && spec.lower.size() == bands);
    static_cast<void>(bands);
    return {spec.name, make_side(spec.upper), make_side(spec.lower)};
}

}  // namespace quasimc
