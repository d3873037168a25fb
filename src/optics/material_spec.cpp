// Makes the lobes of a material from its specification.

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

void check_fraction(double value, std::string_view name, const std::string& where, Faults& faults) {
    if (!(value >= 0 && value <= 1)) {
        faults.add(
            {.where = where,
             .problem = fmt::format("{} is {}", name, shortest(value)),
             .why = "a fraction of the light, 0 ... 1",
             .suggestion = value >= 2 && value <= 100
                               ? fmt::format("a percentage? write {}", shortest(value / 100))
                               : ""});
    }
}

/// A parameter of the model; if the model ignores it, that of the other models.
std::optional<BsdfParameter> domain_of(const BsdfEntry* model, std::string_view name) {
    if (const BsdfParameter* own = model == nullptr ? nullptr : model->find_parameter(name)) {
        return *own;
    }
    for (BsdfParameter known : parameters_of_all()) {
        if (known.name == name) {
            known.high = std::numeric_limits<double>::max();
            return known;
        }
    }
    return std::nullopt;
}

/// @param what  "reflection" or "transmission"
void check_parameter(
    std::string_view what,
    const BsdfEntry* model,
    const BsdfParameters::value_type& given,
    const std::string& where,
    Faults& faults) {
    const auto& [name, value] = given;
    const std::optional<BsdfParameter> domain = domain_of(model, name);
    if (!domain) {
        faults.add(
            {.where = where,
             .problem = fmt::format("{} {} is given", what, name),
             .why = "no model has this parameter",
             .suggestion = ""});
        return;
    }
    if (!(value >= domain->low && value <= domain->high)) {
        const BsdfParameter* own = model == nullptr ? nullptr : model->find_parameter(name);
        const double high = own == nullptr ? domain->high : own->high;
        faults.add(
            {.where = where,
             .problem = fmt::format("{} {} is {}", what, name, shortest(value)),
             .why = fmt::format("{} ... {}", shortest(domain->low), shortest(high)),
             .suggestion = std::isnan(value) ? "" : std::string(domain->suggestion)});
    }
}

void check_model(
    std::string_view what,
    const std::string& model,
    const BsdfParameters& parameters,
    const std::string& where,
    Faults& faults) {
    const BsdfEntry* entry = find_bsdf(model);
    if (entry == nullptr) {
        std::vector<std::string_view> names;
        for (const BsdfEntry& known : bsdf_catalogue()) {
            names.push_back(known.name);
        }
        faults.add(
            {.where = where,
             .problem = fmt::format("no {} model '{}'", what, model),
             .why = "",
             .suggestion = did_you_mean(model, names)});
    }
    for (const auto& given : parameters) {
        check_parameter(what, entry, given, where, faults);
    }
    for (const BsdfParameter& p :
         entry == nullptr ? std::span<const BsdfParameter>{} : entry->parameters) {
        if (!p.usual && !parameters.contains(p.name)) {
            faults.add(
                {.where = where,
                 .problem = fmt::format("{} {} is missing", what, p.name),
                 .why = fmt::format("model '{}' has it", model),
                 .suggestion = ""});
        }
    }
}

void check_side(
    const std::vector<SideOptics>& side,
    std::size_t bands,
    const std::string& where,
    Faults& faults) {
    if (side.size() != bands) {
        faults.add(
            {.where = where,
             .problem = fmt::format("optics for {} of the bands", side.size()),
             .why = fmt::format("there are {}", bands),
             .suggestion = ""});
    }
    for (std::size_t b = 0; b < side.size(); ++b) {
        const SideOptics& optics = side[b];
        const std::string band = fmt::format("{}, band {}", where, b + 1);
        check_fraction(optics.reflectance, "reflectance", band, faults);
        check_fraction(optics.transmittance, "transmittance", band, faults);
        const double sum = optics.reflectance + optics.transmittance;
        if (optics.reflectance <= 1 && optics.transmittance <= 1 && sum > 1) {
            faults.add(
                {.where = band,
                 .problem = fmt::format(
                     "reflectance {} + transmittance {} = {}", shortest(optics.reflectance),
                     shortest(optics.transmittance), shortest(sum)),
                 .why = "the surface would create light",
                 .suggestion = ""});
        }
        check_model(
            "reflection", optics.reflection_model, optics.reflection_parameters, band, faults);
        check_model(
            "transmission", optics.transmission_model, optics.transmission_parameters, band,
            faults);
    }
}

/// One lobe of one band.
struct Term {
    const BsdfEntry* model;
    std::vector<double> parameters;  ///< in the order of the model's row
    double albedo;
};

Term term_of(const SideOptics& optics, Hemisphere hemisphere) {
    const bool is_reflected = hemisphere == Hemisphere::reflected;
    const BsdfEntry* model =
        find_bsdf(is_reflected ? optics.reflection_model : optics.transmission_model);
    EXPECT(model != nullptr);
    const BsdfParameters& given =
        is_reflected ? optics.reflection_parameters : optics.transmission_parameters;
    return {
        model, parameter_values(*model, given),
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
            return other.model == term.model && other.parameters == term.parameters;
        });
        const std::size_t index = first + static_cast<std::size_t>(same - distinct.begin());
        if (same == distinct.end()) {
            distinct.push_back(term);
            lobes.push_back(
                {term.model->make(hemisphere, term.parameters), std::vector<double>(side.size())});
        }
        lobes[index].albedo[b] = term.albedo;
    }
}

Side make_side(const std::vector<SideOptics>& side) {
    std::vector<Lobe> lobes;
    append_lobes(side, Hemisphere::reflected, lobes);
    append_lobes(side, Hemisphere::transmitted, lobes);
    return {lobes, side.size()};
}

}  // namespace

MaterialSpec lambertian(
    std::string name, std::vector<double> reflectance, std::vector<double> transmittance) {
    const std::size_t bands = reflectance.size();
    if (!transmittance.empty() && transmittance.size() != bands) {
        throw InputError(
            {{fmt::format("material '{}'", name),
              fmt::format("has {} reflectances and {} transmittances", bands, transmittance.size()),
              "give one of each for every band", ""}});
    }
    std::vector<SideOptics> side;
    for (std::size_t b = 0; b < bands; ++b) {
        side.push_back(
            {.reflectance = reflectance[b],
             .transmittance = transmittance.empty() ? 0 : transmittance[b]});
    }
    return {std::move(name), side, side};
}

void check_material(
    const MaterialSpec& spec, std::size_t bands, const std::string& where, Faults& faults) {
    const std::string start = where.empty() ? fmt::format("material '{}'", spec.name) : where;
    check_side(spec.upper, bands, start + ", upper side", faults);
    check_side(spec.lower, bands, start + ", lower side", faults);
}

Material make_material(const MaterialSpec& spec, std::size_t bands) {
    EXPECT(spec.upper.size() == bands && spec.lower.size() == bands);
    static_cast<void>(bands);
    return {spec.name, make_side(spec.upper), make_side(spec.lower)};
}

}  // namespace quasimc
