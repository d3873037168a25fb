#include "picture/color_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasimc {
namespace {

constexpr std::size_t kMapStops = 33;
using Stops = std::array<std::uint32_t, kMapStops>;

// Smith and van der Walt (2015), matplotlib 1.5.
constexpr Stops kViridis{0x440154, 0x470D60, 0x48186A, 0x482374, 0x472D7B, 0x453781, 0x424086,
                         0x3E4989, 0x3B528B, 0x375B8D, 0x33638D, 0x2F6B8E, 0x2C728E, 0x297A8E,
                         0x26828E, 0x23898E, 0x21918C, 0x1F988B, 0x1FA088, 0x22A785, 0x28AE80,
                         0x32B67A, 0x3FBC73, 0x4EC36B, 0x5EC962, 0x70CF57, 0x84D44B, 0x98D83E,
                         0xADDC30, 0xC2DF23, 0xD8E219, 0xECE51B, 0xFDE725};
// Nunez, Anderton and Renslow (2018), doi:10.1371/journal.pone.0199239.
constexpr Stops kCividis{0x00224E, 0x00285B, 0x002E6A, 0x053371, 0x1A386F, 0x273E6E, 0x32436D,
                         0x3B496C, 0x434E6C, 0x4B546C, 0x535A6D, 0x5A5F6E, 0x61656F, 0x686A71,
                         0x6F7073, 0x767676, 0x7D7C78, 0x848279, 0x8C8878, 0x938E78, 0x9B9476,
                         0xA39A74, 0xABA072, 0xB4A76F, 0xBCAE6C, 0xC4B468, 0xCDBB63, 0xD5C25E,
                         0xDEC958, 0xE7D150, 0xF0D846, 0xF9E03A, 0xFEE838};
// Smith and van der Walt (2015), matplotlib 1.5.
constexpr Stops kMagma{0x000004, 0x030312, 0x0A0822, 0x130D34, 0x1D1147, 0x29115A, 0x36106B,
                       0x440F76, 0x51127C, 0x5D177F, 0x6A1C81, 0x762181, 0x832681, 0x902A81,
                       0x9C2E7F, 0xAA337D, 0xB73779, 0xC43C75, 0xD0416F, 0xDC4869, 0xE75263,
                       0xEF5D5E, 0xF56B5C, 0xF9795D, 0xFC8961, 0xFD9869, 0xFEA772, 0xFEB67C,
                       0xFEC488, 0xFED395, 0xFDE2A3, 0xFCF0B2, 0xFCFDBF};

// Brewer and Harrower (2003), RdBu, reversed; nearly white in the middle.
constexpr std::array<std::uint32_t, 9> kDifference{0x2166AC, 0x4393C3, 0x92C5DE, 0xD1E5F0, 0xF4F1EC,
                                                   0xFDDBC7, 0xF4A582, 0xD6604D, 0xB2182B};

// Eight colours that people of any colour vision can distinguish: Okabe and Ito (2008), with grey
// instead of black.
constexpr std::array<std::uint32_t, 8> kCategories{0x0072B2, 0xE69F00, 0x009E73, 0xD55E00,
                                                   0x56B4E9, 0xCC79A7, 0xF0E442, 0x888888};
// Tableau 20, with two dark colours instead of its greys.
constexpr std::array<std::uint32_t, 20> kMoreCategories{
    0x1F77B4, 0xFF7F0E, 0x2CA02C, 0xD62728, 0x9467BD, 0x8C564B, 0xE377C2,
    0x393B79, 0xBCBD22, 0x17BECF, 0xAEC7E8, 0xFFBB78, 0x98DF8A, 0xFF9896,
    0xC5B0D5, 0xC49C94, 0xF7B6D2, 0x637939, 0xDBDB8D, 0x9EDAE5};

Rgb unpack(std::uint32_t rgb) {
    const auto byte = [rgb](unsigned shift) {
        return static_cast<std::uint8_t>((rgb >> shift) & 0xFFU);
    };
    return {byte(16), byte(8), byte(0)};
}

/// A saturated colour. @param hue  0 to 1: red, yellow, green, cyan, blue, magenta, red
/// @param value  0: black, 1: bright
Rgb color_of_hue(double hue, double value) {
    constexpr double kSaturation = 0.7;
    const auto channel = [&](double offset) {
        const double turn = std::fmod(6 * hue + offset, 6);
        const double away = std::clamp(std::min(turn, 4 - turn), 0.0, 1.0);
        return static_cast<std::uint8_t>(std::lround(255 * value * (1 - kSaturation * away)));
    };
    return {channel(5), channel(3), channel(1)};
}

}  // namespace

const std::array<ColorMap, 3>& color_map_table() {
    static const std::array<ColorMap, 3> table{{
        {"viridis", kViridis},
        {"cividis", kCividis},
        {"magma", kMagma},
    }};
    return table;
}

const ColorMap* find_color_map(std::string_view name) {
    const auto& table = color_map_table();
    const auto found = std::find_if(
        table.begin(), table.end(), [&](const ColorMap& map) { return map.name == name; });
    return found == table.end() ? nullptr : &*found;
}

Rgb color_at(const ColorMap& map, double part) {
    if (std::isnan(part)) {
        return kNoValue;
    }
    const double position = std::clamp(part, 0.0, 1.0) * static_cast<double>(map.stops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), map.stops.size() - 2);
    return mixed(
        unpack(map.stops[below]), unpack(map.stops[below + 1]),
        position - static_cast<double>(below));
}

const ColorMap& difference_map() {
    static const ColorMap map{"difference", kDifference};
    return map;
}

std::vector<Rgb> category_colors(std::size_t count) {
    const std::span<const std::uint32_t> table =
        count <= kCategories.size() ? std::span<const std::uint32_t>(kCategories)
                                    : std::span<const std::uint32_t>(kMoreCategories);
    std::vector<Rgb> colors;
    colors.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        // Further hues by the golden angle are far from their predecessors.
        const double hue = static_cast<double>(i) * (std::numbers::phi - 1);
        colors.push_back(
            i < table.size() ? unpack(table[i])
                             : color_of_hue(hue - std::floor(hue), i % 2 == 0 ? 0.9 : 0.6));
    }
    return colors;
}

}  // namespace quasimc
