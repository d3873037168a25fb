#pragma once

#include <cstdint>
#include <string_view>

namespace quasimc {

/// Functions of the language.
enum class PlantFunctionId : std::uint8_t {
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    exp,
    log,
    sqrt,
    fabs,
    floor,
    ceil,
    trunc,
    sign,
    srand,
    ran,
    nran,
    bran,
    biran,
    func,
    curve_x,
    curve_y,
    curve_z,
    curve_length,
    printf,
    fopen,
    fclose,
    fflush,
    fprintf,
    fscanf,
    stop,
    get_length,
    set_length,
    window,
};

/// One row of the table of functions.
struct FunctionEntry {
    std::string_view name;
    PlantFunctionId id;
    std::uint8_t least = 1, most = 1;  ///< numbers of arguments
    std::int8_t text = -1;             ///< index of the first argument that is a text; -1: none
    bool second_is_text = false;       ///< whether the next argument is a text too
    bool takes_addresses = false;
};

/// The function with a name, or null.
[[nodiscard]] const FunctionEntry* find_plant_function(std::string_view name);

}  // namespace quasimc
