#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "base/notices.h"
#include "growth/language/model_files.h"
#include "growth/language/program.h"
#include "growth/language/random.h"
#include "growth/module_string.h"

namespace quasimc {

/// The state that the code of a model reads and changes besides its variables.
struct MachineState {
    PlantRandom random;
    StochasticRandom choice;  ///< among productions
    ModelFiles files;
    std::array<double, kGlobalVariables> globals{};
    std::int64_t length = 0;  ///< derivation length
    bool stops = false;       ///< stop() was called
    std::uint64_t max_rounds = 0;
    bool is_silent = false;  ///< nothing is printed
    std::function<void(std::string_view)> print;
};

/// Runs the code of a program: a stack machine.
class Machine {
  public:
    /// All outlive the machine.
    Machine(const PlantProgram& program, MachineState& state, Notices& notices);

    /// Runs code that has no value; modules go to `out`. kNoCode does nothing.
    /// @param variables  of the L-system
    /// @throws InputError  for an infinite loop
    void run(CodeIndex code, std::vector<double>& variables, ModuleString* out = nullptr) {
        if (code != kNoCode) {
            execute(code, variables.data(), out);
        }
    }
    /// The value of an expression.
    [[nodiscard]] double evaluate(CodeIndex code, std::vector<double>& variables) {
        return *execute(code, variables.data(), nullptr);
    }

    /// "file:line" of an instruction.
    [[nodiscard]] const std::string& where(CodeIndex code) const;

  private:
    /// @returns the top of the stack
    double* execute(CodeIndex code, double* variables, ModuleString* out);
    double* element(const Instruction& at, double* top, double* variables);
    [[nodiscard]] double divide(double a, double b, const Instruction& at);
    [[nodiscard]] double remainder(double a, double b, const Instruction& at);
    void count_round(const Instruction& at);
    [[nodiscard]] double call(
        PlantFunctionId function,
        std::span<const double> arguments,
        double* variables,
        const Instruction& at);
    [[nodiscard]] double print(
        std::span<const double> arguments, const Instruction& at, bool to_file);
    [[nodiscard]] double open_file(
        const std::string& name, const std::string& mode, const Instruction& at);
    [[nodiscard]] double scan(std::span<const double> arguments, double* variables);
    [[nodiscard]] double read_curve(
        PlantFunctionId function, std::span<const double> arguments) const;
    void warn(const Instruction& at, std::string_view text);
    [[nodiscard]] const std::string& text(double index) const {
        return program_.strings[static_cast<std::size_t>(index)];
    }

    const PlantProgram& program_;
    MachineState& state_;
    Notices& notices_;
    std::vector<double> stack_;
    std::uint64_t rounds_ = 0;  // of the loops of the code that runs
};

/// The value of code at the time of reading: other variables are 0.
[[nodiscard]] double evaluate_constant(
    const PlantProgram& program, CodeIndex code, const LSystem& system, Notices& notices);

}  // namespace quasimc
