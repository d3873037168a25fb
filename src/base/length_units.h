#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace quasimc {

struct LengthUnit {
    std::string_view name;
    double metres;
};

inline constexpr std::array kLengthUnits{
    LengthUnit{"um", 1e-6},   LengthUnit{"µm", 1e-6},     LengthUnit{"mm", 1e-3},
    LengthUnit{"cm", 1e-2},   LengthUnit{"dm", 1e-1},     LengthUnit{"m", 1},
    LengthUnit{"metre", 1},   LengthUnit{"meter", 1},     LengthUnit{"km", 1e3},
    LengthUnit{"in", 0.0254}, LengthUnit{"inch", 0.0254}, LengthUnit{"ft", 0.3048},
    LengthUnit{"yd", 0.9144}};

/// Metres per unit of length, if its name is known.
[[nodiscard]] constexpr std::optional<double> metres_per(std::string_view unit) {
    for (const LengthUnit& known : kLengthUnits) {
        if (known.name == unit) {
            return known.metres;
        }
    }
    return std::nullopt;
}

}  // namespace quasimc
