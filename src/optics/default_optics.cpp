#include "optics/default_optics.h"

#include <algorithm>
#include <array>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr std::array kUsual{
    DefaultOptics{
        "needle_leaf", "needles of trees, leaves of evergreen shrubs", {.07, .35}, {.05, .10}},
    DefaultOptics{
        "broad_leaf", "leaves of broadleaf trees and deciduous shrubs", {.10, .45}, {.05, .25}},
    DefaultOptics{
        "grass_leaf", "leaves of grasses and crops: wheat, maize, soybean", {.11, .35}, {.05, .34}},
    DefaultOptics{
        "tropical_crop_leaf",
        "leaves of cotton, rice, sugarcane, maize and soybean of the tropics",
        {.11, .58},
        {.07, .25}},
    DefaultOptics{"woody_stem", "stems of trees and shrubs", {.16, .39}, {.001, .001}},
    DefaultOptics{"grass_stem", "stems of grasses and crops", {.31, .53}, {.12, .25}}};

/// Reflectance of a soil colour, dry and saturated.
struct SoilColor {
    OpticsByRegion dry, saturated;
};
constexpr std::array<SoilColor, kSoilColors> kSoils{
    {{{.36, .61}, {.25, .50}}, {{.34, .57}, {.23, .46}}, {{.32, .53}, {.21, .42}},
     {{.31, .51}, {.20, .40}}, {{.30, .49}, {.19, .38}}, {{.29, .48}, {.18, .36}},
     {{.28, .45}, {.17, .34}}, {{.27, .43}, {.16, .32}}, {{.26, .41}, {.15, .30}},
     {{.25, .39}, {.14, .28}}, {{.24, .37}, {.13, .26}}, {{.23, .35}, {.12, .24}},
     {{.22, .33}, {.11, .22}}, {{.20, .31}, {.10, .20}}, {{.18, .29}, {.09, .18}},
     {{.16, .27}, {.08, .16}}, {{.14, .25}, {.07, .14}}, {{.12, .23}, {.06, .12}},
     {{.10, .21}, {.05, .10}}, {{.08, .16}, {.04, .08}}}};

}  // namespace

std::span<const DefaultOptics> usual_optics() {
    return kUsual;
}

const DefaultOptics* find_usual_optics(std::string_view name) {
    const auto* found = std::find_if(
        kUsual.begin(), kUsual.end(),
        [&](const DefaultOptics& optics) { return optics.name == name; });
    return found == kUsual.end() ? nullptr : found;
}

OpticsByRegion soil_reflectance(int color, double water) {
    EXPECT(color >= 1 && color <= kSoilColors);
    const SoilColor& soil = kSoils[static_cast<std::size_t>(color - 1)];
    const double drier = std::max(0.0, 0.11 - 0.40 * water);
    return {
        std::min(soil.dry.visible, soil.saturated.visible + drier),
        std::min(soil.dry.near_infrared, soil.saturated.near_infrared + drier)};
}

}  // namespace quasimc
