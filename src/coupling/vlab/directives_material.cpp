// Directives for bands and materials.

#include <array>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/vlab/directive_table.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr double kMaxBands = 20;

void read_samples(Values& values, DirectiveContext& context) {
    const auto count = values.integer("the number of bands", {1, kMaxBands});
    if (!count) {
        return;
    }
    Specification& spec = context.spec;
    spec.bands.clear();
    for (std::int64_t b = 0; b < *count; ++b) {
        spec.bands.push_back({*count == 1 ? "660" : fmt::format("band {}", b + 1), "1"});
    }
    spec.irradiance.assign(spec.bands.size(), 1);
    spec.materials.front().assign(spec.bands.size(), SideOptics{0.25, 0.25});
}

void read_spectrum(Values& values, DirectiveContext& context) {
    Specification& spec = context.spec;
    for (std::size_t b = 0; b < spec.band_count() && !values.failed(); ++b) {
        const auto wavelength =
            values.number(fmt::format("the wavelength of band {}", b + 1), kNotNegativeNumber);
        const auto irradiance =
            values.number(fmt::format("the irradiance of band {}", b + 1), kNotNegativeNumber);
        if (wavelength && irradiance) {
            spec.bands[b].name = fmt::format("{}: {}", b + 1, shortest(*wavelength));
            spec.irradiance[b] = *irradiance;
        }
    }
    if (!values.failed() && !values.at_end()) {
        values.notice(fmt::format(
            "there are more bands than the {} of 'spectrum samples'; {} is not read",
            spec.band_count(), shown(values.rest())));
    }
}

/// Reads one band of a material: reflectance, its exponent, transmittance, its exponent, and an
/// unused number.
std::optional<SideOptics> read_band(Values& values) {
    SideOptics optics;
    const auto rho = values.number("the reflectance", {0, 1});
    const auto rho_exponent = values.number("the exponent of reflection", {-1e30, 1e30});
    const auto tau = values.number("the transmittance", {0, 1});
    const auto tau_exponent = values.number("the exponent of transmission", {-1e30, 1e30});
    if (!rho || !rho_exponent || !tau || !tau_exponent) {
        return std::nullopt;
    }
    static_cast<void>(values.number_or(1, "the last number", kAnyNumber));
    if (*rho + *tau > 1) {
        values.fault(
            fmt::format("reflectance {} and transmittance {}", shortest(*rho), shortest(*tau)),
            "their sum exceeds 1");
        return std::nullopt;
    }
    optics.reflectance = *rho;
    optics.reflection_parameters["exponent"] = *rho_exponent;
    optics.transmittance = *tau;
    optics.transmission_parameters["exponent"] = *tau_exponent;
    return optics;
}

/// Reads the bands of a material, one line each.
std::optional<std::vector<SideOptics>> read_material_bands(
    Values& values, DirectiveContext& context) {
    const DirectiveLine& line = *context.line;
    const std::size_t bands = context.spec.band_count();
    if (line.block.size() + 1 != bands) {
        static_cast<void>(values.rest());
        values.fault(
            fmt::format("{} lines", line.block.size() + 1),
            fmt::format("'spectrum samples' is {}, and each band needs a line", bands),
            "lines after the first must begin with ':'");
        return std::nullopt;
    }
    std::vector<SideOptics> material;
    const auto add = [&](Values& of_line) {
        if (const auto optics = read_band(of_line)) {
            material.push_back(*optics);
        }
    };
    add(values);
    for (const auto& [number, text] : line.block) {
        Values more(
            fmt::format("{}:{}", context.file, number), line.name, text, values.faults(),
            context.notices);
        add(more);
        more.finish();
    }
    return material.size() == bands ? std::optional(material) : std::nullopt;
}

void read_leaf_upper(Values& values, DirectiveContext& context) {
    if (context.has_leaf_upper) {
        values.notice("a second one replaces the first");
    }
    context.has_leaf_upper = true;
    if (auto material = read_material_bands(values, context)) {
        context.spec.materials.front() = std::move(*material);
    }
}

void read_leaf_lower(Values& values, DirectiveContext& context) {
    if (auto material = read_material_bands(values, context)) {
        context.spec.leaf_lower = context.spec.materials.size();
        context.spec.materials.push_back(std::move(*material));
    }
}

void read_material(Values& values, DirectiveContext& context) {
    if (auto material = read_material_bands(values, context)) {
        context.spec.materials.push_back(std::move(*material));
    }
}

void read_parameter(Values& values, DirectiveContext& context) {
    if (const auto index = values.integer("the number of the parameter", {1, 60})) {
        context.spec.material_parameter = static_cast<std::size_t>(*index);
    }
}

constexpr std::array kMaterialDirectives{
    DirectiveEntry{"spectrum samples", Dialect::both, read_samples},
    DirectiveEntry{"source spectrum", Dialect::both, read_spectrum},
    DirectiveEntry{"leaf material (top)", Dialect::both, read_leaf_upper},
    DirectiveEntry{"leaf material (bottom)", Dialect::both, read_leaf_lower},
    DirectiveEntry{"material", Dialect::both, read_material},
    DirectiveEntry{"material parameter", Dialect::both, read_parameter},
};

}  // namespace

std::span<const DirectiveEntry> material_directives() {
    return kMaterialDirectives;
}

}  // namespace quasimc
