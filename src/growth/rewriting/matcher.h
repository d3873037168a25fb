#pragma once

#include <cstddef>
#include <vector>

#include "growth/language/machine.h"
#include "growth/language/program.h"
#include "growth/module_string.h"

namespace quasimc {

/// An L-system at work: its variables.
struct SystemInstance {
    const LSystem* system = nullptr;
    std::vector<double> variables;
};

/// Modules of a string: the positions from `first` to before `end`.
struct ModuleRange {
    const ModuleString& string;
    ModuleString::Position first, end;
};

/// The end of a branch: the unmatched ']' or '$', the next %(p), or the end of the string.
/// @param p  a module of the branch
[[nodiscard]] ModuleString::Position branch_end(
    const ModuleString& string, ModuleString::Position p);

/// Tests whether productions apply.
class Matcher {
  public:
    explicit Matcher(Machine& machine) : machine_(machine) {}

    /// Tests a production for the modules from `p` on, binds its parameters, and runs the code
    /// before and in its condition.
    /// @param origin  whose neighbours are the contexts; null: the predecessor itself
    /// @returns the position after the predecessor; kNone if the production does not apply
    [[nodiscard]] ModuleString::Position match(
        const Production& production,
        const ModuleString& text,
        ModuleString::Position p,
        const ModuleRange* origin,
        SystemInstance& instance);

  private:
    using Position = ModuleString::Position;

    bool find_right(const Production& production, const ModuleRange& origin, const LSystem& system);
    bool find_left(const Production& production, const ModuleRange& origin, const LSystem& system);

    Machine& machine_;
    std::vector<Position> right_, left_;  // modules that were found; scratch
};

}  // namespace quasimc
