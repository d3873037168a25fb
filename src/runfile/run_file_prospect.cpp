#include <array>
#include <string>
#include <vector>

#include "optics/prospect.h"
#include "runfile/run_file_sections.h"
#include "runfile/run_file_spectrum.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 1> kLeafModels{"prospect_d"};

/// Reads the constituents of a leaf. The upper bounds detect wrong units.
std::optional<LeafConstituents> read_constituents(TableReader& table) {
    constexpr double kMaxPlates = 10, kMaxPigment = 500, kMaxBrown = 10, kMaxWater = 1,
                     kMaxDryMatter = 0.5;
    const auto plates = table.required("structure", table.real("structure", {1, kMaxPlates}));
    const auto chlorophyll =
        table.required("chlorophyll_ug_cm2", table.real("chlorophyll_ug_cm2", {0, kMaxPigment}));
    const auto carotenoids =
        table.required("carotenoids_ug_cm2", table.real("carotenoids_ug_cm2", {0, kMaxPigment}));
    const auto anthocyanins = table.real("anthocyanins_ug_cm2", {0, kMaxPigment});
    const auto brown = table.real("brown_pigments", {0, kMaxBrown});
    const auto water = table.required("water_cm", table.real("water_cm", {0, kMaxWater}));
    const auto dry_matter =
        table.required("dry_matter_g_cm2", table.real("dry_matter_g_cm2", {0, kMaxDryMatter}));
    table.finish();
    if (table.failed()) {
        return std::nullopt;
    }
    return LeafConstituents{*plates,           *chlorophyll, *carotenoids, anthocyanins.value_or(0),
                            brown.value_or(0), *water,       *dry_matter};
}

SurfaceSpectrum leaf_spectrum(const LeafConstituents& leaf) {
    SurfaceSpectrum spectrum;
    for (const LeafConstants& row : leaf_constants()) {
        const LeafOptics optics = prospect(row, leaf);
        spectrum.nm.push_back(row.nm);
        spectrum.reflectance.push_back(optics.reflectance);
        spectrum.transmittance.push_back(optics.transmittance);
    }
    return spectrum;
}

}  // namespace

std::optional<SpectralOptics> read_leaf_model(
    TableReader& material, const Node& node, const RunFileContext& context) {
    TableReader table(node, material.what() + ": optics", material.reporter());
    const auto model = table.required("model", table.choice("model", kLeafModels));
    const std::optional<LeafConstituents> leaf = read_constituents(table);
    if (!model || !leaf) {
        return std::nullopt;
    }
    const Node* light_node = material.any("spectrum_light");  // read_spectral_optics checks it
    const auto* light = light_node == nullptr ? nullptr : light_node->as<std::string>();
    return optics_of_bands(
        material, context, leaf_spectrum(*leaf),
        {"optics", *model, light == nullptr ? std::nullopt : std::optional(*light)});
}

}  // namespace quasimc
