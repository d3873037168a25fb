#include "growth/language/functions.h"

#include <algorithm>
#include <array>

namespace quasimc {
namespace {

using F = PlantFunctionId;
constexpr std::uint8_t kMany = 20;

/// All functions. To add one, add a row here and a case in call_function.cpp.
constexpr std::array kFunctionEntries{
    FunctionEntry{"sin", F::sin},
    FunctionEntry{"cos", F::cos},
    FunctionEntry{"tan", F::tan},
    FunctionEntry{"asin", F::asin},
    FunctionEntry{"acos", F::acos},
    FunctionEntry{"atan", F::atan},
    FunctionEntry{"exp", F::exp},
    FunctionEntry{"log", F::log},
    FunctionEntry{"sqrt", F::sqrt},
    FunctionEntry{"fabs", F::fabs},
    FunctionEntry{"floor", F::floor},
    FunctionEntry{"ceil", F::ceil},
    FunctionEntry{"trunc", F::trunc},
    FunctionEntry{"sign", F::sign},
    FunctionEntry{"srand", F::srand},
    FunctionEntry{"ran", F::ran},
    FunctionEntry{"nran", F::nran, 2, 2},
    FunctionEntry{"bran", F::bran, 2, 2},
    FunctionEntry{"biran", F::biran, 2, 2},
    FunctionEntry{"func", F::func, 2, 2},
    FunctionEntry{"curveX", F::curve_x, 2, 2},
    FunctionEntry{"curveY", F::curve_y, 2, 2},
    FunctionEntry{"curveZ", F::curve_z, 2, 2},
    FunctionEntry{"curveGAL", F::curve_length},
    FunctionEntry{"printf", F::printf, 1, kMany, 0},
    FunctionEntry{"fopen", F::fopen, 2, 2, 0, true},
    FunctionEntry{"fclose", F::fclose},
    FunctionEntry{"fflush", F::fflush},
    FunctionEntry{"fprintf", F::fprintf, 2, kMany, 1},
    FunctionEntry{"fscanf", F::fscanf, 2, kMany, 1, false, true},
    FunctionEntry{"stop", F::stop},
    FunctionEntry{"GetDerivationLength", F::get_length},
    FunctionEntry{"SetDerivationLength", F::set_length},
    FunctionEntry{"vvXmin", F::window},
    FunctionEntry{"vvXmax", F::window},
    FunctionEntry{"vvYmin", F::window},
    FunctionEntry{"vvYmax", F::window},
    FunctionEntry{"vvZmin", F::window},
    FunctionEntry{"vvZmax", F::window},
    FunctionEntry{"vvScale", F::window},
    FunctionEntry{"Display", F::window},
    FunctionEntry{"inblob", F::window, 4, 4},
};

}  // namespace

const FunctionEntry* find_plant_function(std::string_view name) {
    const auto* found = std::find_if(
        kFunctionEntries.begin(), kFunctionEntries.end(),
        [&](const FunctionEntry& entry) { return entry.name == name; });
    return found == kFunctionEntries.end() ? nullptr : found;
}

}  // namespace quasimc
