#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/language/format_values.h"
#include "growth/language/machine.h"

namespace quasimc {
namespace {

constexpr double kPerDegree = std::numbers::pi / 180;

/// A function of one number; degrees for angles.
double call_number(PlantFunctionId function, double x) {
    using F = PlantFunctionId;
    switch (function) {
        case F::sin:
            return std::sin(x * kPerDegree);
        case F::cos:
            return std::cos(x * kPerDegree);
        case F::tan:
            return std::tan(x * kPerDegree);
        case F::asin:
            return std::asin(x) / kPerDegree;
        case F::acos:
            return std::acos(x) / kPerDegree;
        case F::atan:
            return std::atan(x) / kPerDegree;
        case F::exp:
            return std::exp(x);
        case F::log:
            return std::log(x);
        case F::sqrt:
            return std::sqrt(x);
        case F::fabs:
            return std::abs(x);
        case F::floor:
            return std::floor(x);
        case F::ceil:
            return std::ceil(x);
        case F::trunc:
            return std::floor(x + 0.5);
        case F::sign:
            return x > 0 ? 1 : x < 0 ? -1 : 0;
        default:
            return 0;
    }
}

/// The item with a number from 1; null if there is none.
template <typename Item>
const Item* numbered(const std::vector<Item>& items, double number) {
    return number >= 1 && number < static_cast<double>(items.size()) + 1
               ? &items[static_cast<std::size_t>(number) - 1]
               : nullptr;
}

}  // namespace

double Machine::call(
    PlantFunctionId function,
    std::span<const double> arguments,
    double* variables,
    const Instruction& at) {
    using F = PlantFunctionId;
    const double x = arguments[0];
    const double y = arguments.size() > 1 ? arguments[1] : 0;
    switch (function) {
        case F::srand:
            state_.random.srand(x);
            return 0;
        case F::ran:
            return state_.random.ran(x);
        case F::nran:
            return state_.random.nran(x, y);
        case F::bran:
            return state_.random.bran(x, y);
        case F::biran:
            return state_.random.biran(x, y);
        case F::func: {
            const PlantFunction* found = numbered(program_.view.functions, x);
            if (found == nullptr) {
                warn(at, fmt::format("there is no function {}; its value is 0", x));
            }
            return found == nullptr ? 0 : found->value(y);
        }
        case F::curve_x:
        case F::curve_y:
        case F::curve_z:
        case F::curve_length:
            return read_curve(function, arguments);
        case F::printf:
            return print(arguments, at, false);
        case F::fprintf:
            return print(arguments, at, true);
        case F::fscanf:
            return scan(arguments, variables);
        case F::fopen:
            return open_file(text(x), text(y), at);
        case F::fclose:
            return state_.files.close(x);
        case F::fflush:
            return state_.files.flush(x);
        case F::stop:
            state_.stops = true;
            return 0;
        case F::get_length:
            return static_cast<double>(state_.length);
        case F::set_length: {
            constexpr double kLongest = 1e9;
            state_.length =
                static_cast<std::int64_t>(std::clamp(std::isnan(x) ? 0 : x, 0.0, kLongest));
            return 0;
        }
        case F::window:
            warn(at, "functions of the window have the value 0, as there is none");
            return 0;
        default:
            return call_number(function, x);
    }
}

double Machine::open_file(const std::string& name, const std::string& mode, const Instruction& at) {
    const double file = state_.files.open(name, mode);
    if (file < 0 && mode != "r") {
        warn(
            at, fmt::format(
                    "the file {} can't be opened to be written; models write below the current "
                    "folder",
                    shown(name)));
    }
    return file;
}

double Machine::read_curve(PlantFunctionId function, std::span<const double> arguments) const {
    using F = PlantFunctionId;
    const PlantCurve* curve = numbered(program_.view.curves, arguments[0]);
    if (curve == nullptr) {
        return 0;
    }
    if (function == F::curve_length) {
        return curve->length;
    }
    const Vec3 p = curve->at(arguments[1]);
    return function == F::curve_x ? p.x : function == F::curve_y ? p.y : p.z;
}

double Machine::print(std::span<const double> arguments, const Instruction& at, bool to_file) {
    const std::size_t first = to_file ? 1 : 0;
    const FormattedText formatted =
        format_values(text(arguments[first]), arguments.subspan(first + 1));
    for (const std::string& problem : formatted.problems) {
        warn(at, problem);
    }
    if (to_file && !state_.is_silent) {
        return state_.files.write(arguments[0], formatted.text);
    }
    if (state_.print && !state_.is_silent) {
        state_.print(formatted.text);
    }
    return static_cast<double>(formatted.text.size());
}

/// Reads numbers into variables, whose indices are the arguments after the format.
double Machine::scan(std::span<const double> arguments, double* variables) {
    const ScannedValues read = state_.files.scan(arguments[0], text(arguments[1]));
    double count = 0;
    for (std::size_t i = 0; i < read.values.size() && i + 2 < arguments.size(); ++i) {
        if (read.values[i]) {
            variables[static_cast<std::size_t>(arguments[i + 2])] = *read.values[i];
            ++count;
        }
    }
    return count;
}

}  // namespace quasimc
