#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "optics/default_optics.h"
#include "runfile/run_file_sections.h"
#include "runfile/run_file_time.h"

namespace quasimc {
namespace {

constexpr std::string_view kSoil = "soil";

/// The value of each band's spectral region; empty after a fault.
std::optional<std::vector<double>> by_band(
    TableReader& table, const RunFileContext& context, const OpticsByRegion& optics) {
    constexpr double kBorder = 700;
    std::vector<double> values;
    const std::vector<SpectralSpan> spans = band_spans(table, context.bands);
    if (table.failed()) {
        return std::nullopt;
    }
    for (std::size_t b = 0; b < spans.size(); ++b) {
        if (spans[b].from_nm < kBorder && spans[b].to_nm > kBorder) {
            table.fault_at(
                "optics",
                fmt::format(
                    "band '{}' covers {} to {} nm", context.bands[b].name, spans[b].from_nm,
                    spans[b].to_nm),
                "these optics are defined below and above 700 nm",
                "split the band, or give reflectance and transmittance");
            return std::nullopt;
        }
        values.push_back(spans[b].to_nm <= kBorder ? optics.visible : optics.near_infrared);
    }
    return values;
}

std::optional<SpectralOptics> read_soil(TableReader& table, const RunFileContext& context) {
    const auto color = table.required("soil_color", table.integer("soil_color", {1, kSoilColors}));
    const double water = table.real("water_content", {0, 1}).value_or(0);
    if (!color) {
        return std::nullopt;
    }
    auto values = by_band(table, context, soil_reflectance(static_cast<int>(*color), water));
    if (!values) {
        return std::nullopt;
    }
    return SpectralOptics{std::move(*values), std::vector<double>(context.bands.size(), 0.0)};
}

}  // namespace

std::optional<SpectralOptics> read_usual_optics(TableReader& table, const RunFileContext& context) {
    const Node* node = table.any("optics");
    if (node != nullptr && node->as<Node::Table>() != nullptr) {
        return read_leaf_model(table, *node, context);
    }
    const std::optional<std::string> name = table.text("optics");
    if (!name) {
        return std::nullopt;
    }
    if (*name == kSoil) {
        return read_soil(table, context);
    }
    const DefaultOptics* usual = find_usual_optics(*name);
    if (usual == nullptr) {
        std::vector<std::string_view> names = names_in(usual_optics());
        names.insert(names.begin(), kSoil);
        table.fault_at(
            "optics", fmt::format("optics: '{}' is not one of {}", *name, joined(names, ", ")), "",
            near_word_text(*name, names));
        return std::nullopt;
    }
    auto reflectance = by_band(table, context, usual->reflectance);
    auto transmittance = by_band(table, context, usual->transmittance);
    if (!reflectance || !transmittance) {
        return std::nullopt;
    }
    return SpectralOptics{std::move(*reflectance), std::move(*transmittance)};
}

}  // namespace quasimc
