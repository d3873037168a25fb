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
    LengthUnit{"um", 1e-6},         LengthUnit{"µm", 1e-6},
    LengthUnit{"mm", 1e-3},         LengthUnit{"cm", 1e-2},
    LengthUnit{"dm", 1e-1},         LengthUnit{"m", 1},
    LengthUnit{"km", 1e3},          LengthUnit{"in", 0.0254},
    LengthUnit{"ft", 0.3048},       LengthUnit{"yd", 0.9144},
    LengthUnit{"metre", 1},         LengthUnit{"metres", 1},
    LengthUnit{"meter", 1},         LengthUnit{"meters", 1},
    LengthUnit{"centimetre", 1e-2}, LengthUnit{"centimetres", 1e-2},
    LengthUnit{"centimeter", 1e-2}, LengthUnit{"centimeters", 1e-2},
    LengthUnit{"millimetre", 1e-3}, LengthUnit{"millimetres", 1e-3},
    LengthUnit{"millimeter", 1e-3}, LengthUnit{"millimeters", 1e-3},
    LengthUnit{"inch", 0.0254},     LengthUnit{"inches", 0.0254},
    LengthUnit{"foot", 0.3048},     LengthUnit{"feet", 0.3048}};

/// The short names, for messages.
inline constexpr std::string_view kLengthUnitText = "m, cm, mm, dm, km, um, ft, in and yd";

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
