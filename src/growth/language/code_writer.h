#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "growth/language/program.h"

namespace quasimc {

/// A variable of a model.
struct VariableName {
    bool is_global = false;
    std::int32_t index = 0;
};

/// Names of variables and arrays, searched from inside: production, L-system, model.
class ModelNames {
  public:
    /// Names of a new L-system.
    void begin_system();
    /// Names of a new production.
    void begin_production() {
        production_.clear();
        in_production_ = true;
    }
    void end_production() { in_production_ = false; }
    /// Makes Q and Z known.
    void add_globals();

    [[nodiscard]] const VariableName* find(std::string_view name) const;
    /// A new variable of the current production, or of the L-system outside of productions.
    VariableName add(std::string_view name, LSystem& system);
    /// A new variable of the current production, if it has none of that name.
    VariableName add_parameter(std::string_view name, LSystem& system);

    void add_array(std::string_view name, std::int32_t number) {
        arrays_.insert_or_assign(std::string(name), number);
    }
    [[nodiscard]] const std::int32_t* find_array(std::string_view name) const;

  private:
    using Table = std::map<std::string, VariableName, std::less<>>;
    Table production_, system_, global_;
    std::map<std::string, std::int32_t, std::less<>> arrays_;
    bool in_production_ = false;
};

/// Appends instructions to a program.
class CodeWriter {
  public:
    explicit CodeWriter(PlantProgram& program) : program_(program) {}

    void set_line(std::uint32_t line) { line_ = line; }
    /// @returns its index
    CodeIndex add(Op op, std::int32_t a = 0, std::size_t n = 0);
    void add_constant(double value);
    /// The index of a text.
    std::int32_t text(std::string_view text);
    [[nodiscard]] CodeIndex here() const { return static_cast<CodeIndex>(program_.code.size()); }
    /// Makes a jump lead to the next instruction.
    void land(CodeIndex jump) { program_.code[static_cast<std::size_t>(jump)].a = here(); }

  private:
    PlantProgram& program_;
    std::uint32_t line_ = 0;
};

}  // namespace quasimc
