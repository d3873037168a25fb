#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "growth/language/functions.h"
#include "growth/view/view.h"

namespace quasimc {

/// Operations of the stack machine. `a` and `n` are the operands of an instruction.
enum class Op : std::uint8_t {
    end,          ///< ends the code
    constant,     ///< pushes constants[a]
    load,         ///< pushes the variable a
    load_global,  ///< pushes the global variable a
    load_array,   ///< replaces n indices by the element of array a
    store,        ///< pops a value into the variable a
    store_global,
    store_array,  ///< pops a value, then n indices
    negative,
    logical_not,
    add,
    subtract,
    multiply,
    divide,
    remainder,
    power,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    unequal,
    truth,         ///< replaces a value by 0 or 1
    jump,          ///< goes to instruction a
    jump_if_zero,  ///< pops a value
    jump_if_true,  ///< pops a value
    next_round,    ///< counts a round of a loop
    call,          ///< calls function a with n arguments
    drop,          ///< pops a value
    emit,          ///< pops n values and appends a module with the symbol a
};

struct Instruction {
    Op op = Op::end;
    std::uint8_t n = 0;
    std::int32_t a = 0;
};

/// The first instruction of a piece of code, which ends with Op::end; kNoCode: none.
using CodeIndex = std::int32_t;
inline constexpr CodeIndex kNoCode = -1;

/// A module of a production's predecessor or context.
struct PatternModule {
    char symbol = 0;
    std::vector<std::int32_t> variables;  ///< that receive its parameters
};

struct Production {
    std::vector<PatternModule> left, predecessor, right;
    CodeIndex before = kNoCode;  ///< block before the condition
    CodeIndex condition = kNoCode;
    CodeIndex after = kNoCode;  ///< block after the condition
    CodeIndex successor = kNoCode;
    CodeIndex probability = kNoCode;
};

/// Productions of a section, in the order of the file.
struct ProductionSet {
    std::vector<Production> productions;
    std::array<std::vector<std::uint32_t>, 256> by_symbol;  ///< by the first predecessor
    int max_depth = 1;
    bool warns = true;           ///< warns of the maximum depth
    std::optional<double> seed;  ///< for a homomorphism

    [[nodiscard]] const std::vector<std::uint32_t>& candidates(char symbol) const {
        return by_symbol[static_cast<unsigned char>(symbol)];
    }
};

/// An array of variables in row-major order.
struct PlantArray {
    std::int32_t first = 0;  ///< variable of the first element
    std::vector<std::int32_t> sizes;
};

/// An L-system of a file.
struct LSystem {
    std::optional<std::int64_t> id;
    std::string name;
    std::bitset<256> ignored;  ///< symbols that contexts skip
    std::bitset<256> copied;   ///< symbols whose modules no derivation step changes
    bool is_ring = false;
    bool is_stochastic = false;
    CodeIndex start = kNoCode, start_each = kNoCode, end_each = kNoCode, end = kNoCode;
    CodeIndex axiom = kNoCode;
    ProductionSet productions, decomposition, homomorphism;
    std::vector<double> variables;  ///< initial values
};

/// Global variables: the current step and the derivation length.
inline constexpr std::int32_t kStepVariable = 0, kLengthVariable = 1, kGlobalVariables = 2;

/// A compiled model.
struct PlantProgram {
    std::vector<LSystem> systems;  ///< the first is the main one
    std::vector<Instruction> code;
    std::vector<std::uint32_t> lines;  ///< lines of the instructions, as indices of `where`
    std::vector<double> constants;
    std::vector<std::string> strings;
    std::vector<PlantArray> arrays;
    std::int64_t steps = 0;
    bool asks_environment = false;   ///< whether passes are made
    bool has_queries = false;        ///< whether ?E occurs
    std::vector<std::string> where;  ///< "file:line" of each line
    View view;
    std::vector<InputFile> inputs;
};

}  // namespace quasimc
