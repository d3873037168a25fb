#include "growth/language/machine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

/// Enough for any expression: nesting is limited to 100, and 24 values are pending at each level.
constexpr std::size_t kStackSize = 4096;

/// A number without its fraction, at most 9e18; not a number is 0.
std::int64_t truncated(double x) {
    constexpr double kLargest = 9e18;
    return std::isnan(x) ? 0 : static_cast<std::int64_t>(std::clamp(x, -kLargest, kLargest));
}

}  // namespace

Machine::Machine(const PlantProgram& program, MachineState& state, Notices& notices)
    : program_(program), state_(state), notices_(notices), stack_(kStackSize) {}

const std::string& Machine::where(CodeIndex code) const {
    return program_.where[program_.lines[static_cast<std::size_t>(code)]];
}

void Machine::warn(const Instruction& at, std::string_view text) {
    const auto index = static_cast<std::size_t>(&at - program_.code.data());
    const std::uint32_t line = program_.lines[index];
    const std::string source = line < program_.where.size() ? program_.where[line] : "the header";
    notices_.once(fmt::format("{}: {}", source, text));
}

// NOLINTNEXTLINE(readability-function-size): one switch over all operations
double* Machine::execute(CodeIndex code, double* variables, ModuleString* out) {
    rounds_ = 0;
    double* top = stack_.data();  // the last value
    const Instruction* at = &program_.code[static_cast<std::size_t>(code)];
    const auto binary = [&top](auto&& operation) {
        --top;
        *top = operation(top[0], top[1]);
    };
    for (;; ++at) {
        switch (at->op) {
            case Op::end:
                return top;
            case Op::constant:
                *++top = program_.constants[static_cast<std::size_t>(at->a)];
                break;
            case Op::load:
                *++top = variables[at->a];
                break;
            case Op::load_global:
                *++top = state_.globals[static_cast<std::size_t>(at->a)];
                break;
            case Op::load_array:
                top -= at->n;
                top[1] = *element(*at, top, variables);
                ++top;
                break;
            case Op::store:
                variables[at->a] = *top--;
                break;
            case Op::store_global:
                state_.globals[static_cast<std::size_t>(at->a)] = *top--;
                break;
            case Op::store_array: {
                const double value = *top;
                top -= at->n + 1;
                *element(*at, top, variables) = value;
                break;
            }
            case Op::negative:
                *top = -*top;
                break;
            case Op::logical_not:
                *top = *top == 0 ? 1 : 0;
                break;
            case Op::add:
                binary([](double a, double b) { return a + b; });
                break;
            case Op::subtract:
                binary([](double a, double b) { return a - b; });
                break;
            case Op::multiply:
                binary([](double a, double b) { return a * b; });
                break;
            case Op::divide:
                binary([&](double a, double b) { return divide(a, b, *at); });
                break;
            case Op::remainder:
                binary([&](double a, double b) { return remainder(a, b, *at); });
                break;
            case Op::power:
                binary([](double a, double b) { return std::pow(a, b); });
                break;
            case Op::less:
                binary([](double a, double b) { return a < b ? 1.0 : 0.0; });
                break;
            case Op::less_equal:
                binary([](double a, double b) { return a <= b ? 1.0 : 0.0; });
                break;
            case Op::greater:
                binary([](double a, double b) { return a > b ? 1.0 : 0.0; });
                break;
            case Op::greater_equal:
                binary([](double a, double b) { return a >= b ? 1.0 : 0.0; });
                break;
            case Op::equal:
                binary([](double a, double b) { return a == b ? 1.0 : 0.0; });
                break;
            case Op::unequal:
                binary([](double a, double b) { return a != b ? 1.0 : 0.0; });
                break;
            case Op::truth:
                *top = *top != 0 ? 1 : 0;
                break;
            case Op::jump:
                at = &program_.code[static_cast<std::size_t>(at->a)] - 1;
                break;
            case Op::jump_if_zero:
                at = *top-- == 0 ? &program_.code[static_cast<std::size_t>(at->a)] - 1 : at;
                break;
            case Op::jump_if_true:
                at = *top-- != 0 ? &program_.code[static_cast<std::size_t>(at->a)] - 1 : at;
                break;
            case Op::next_round:
                count_round(*at);
                break;
            case Op::call:
                top -= at->n;
                top[1] = call(
                    static_cast<PlantFunctionId>(at->a), std::span(top + 1, at->n), variables, *at);
                ++top;
                break;
            case Op::drop:
                --top;
                break;
            case Op::emit:
                top -= at->n;
                out->append(static_cast<char>(at->a), std::span(top + 1, at->n));
                break;
        }
    }
}

/// The element of an array. @param top  the first index comes after it
double* Machine::element(const Instruction& at, double* top, double* variables) {
    const PlantArray& array = program_.arrays[static_cast<std::size_t>(at.a)];
    std::int64_t offset = 0;
    for (std::size_t i = 0; i < array.sizes.size(); ++i) {
        const std::int64_t size = array.sizes[i];
        const std::int64_t index = i < at.n ? truncated(top[1 + i]) : 0;
        if (index < 0 || index >= size) {
            warn(
                at, fmt::format(
                        "the index {} is outside of the array, whose last index is {}; the "
                        "nearest is used",
                        index, size - 1));
        }
        offset = offset * size + std::clamp<std::int64_t>(index, 0, size - 1);
    }
    return variables + array.first + offset;
}

double Machine::divide(double a, double b, const Instruction& at) {
    if (b == 0) {
        warn(at, "division by 0; the divisor is taken as 1");
        return a;
    }
    return a / b;
}

double Machine::remainder(double a, double b, const Instruction& at) {
    const std::int64_t divisor = truncated(b);
    if (divisor == 0) {
        warn(at, "remainder of a division by 0; it is taken as 0");
        return 0;
    }
    return static_cast<double>(truncated(a) % divisor);
}

void Machine::count_round(const Instruction& at) {
    if (++rounds_ > state_.max_rounds) {
        const auto index = static_cast<CodeIndex>(&at - program_.code.data());
        throw InputError(
            {{where(index), "a loop does not end",
              fmt::format("the loops of the block have gone round {} times", state_.max_rounds),
              "check its condition"}});
    }
}

double evaluate_constant(
    const PlantProgram& program, CodeIndex code, const LSystem& system, Notices& notices) {
    MachineState state;
    std::vector<double> variables = system.variables;
    return Machine(program, state, notices).evaluate(code, variables);
}

}  // namespace quasimc
