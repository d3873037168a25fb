#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "growth/language/machine.h"
#include "growth/rewriting/matcher.h"

namespace quasimc {

/// The L-systems of a plant at work: the main one, and those of modules ?(id, scale).
class SystemInstances {
  public:
    SystemInstances(const PlantProgram& program, Machine& machine);

    [[nodiscard]] SystemInstance& main() { return *instances_.front(); }
    /// The instance of a module ?(id, scale); the first call makes it and runs its block Start.
    /// @throws InputError  if there is no L-system of that id
    [[nodiscard]] SystemInstance& of(ModuleString& string, ModuleString::Position p);

    /// The variables of all instances.
    [[nodiscard]] std::vector<std::vector<double>> variables() const;
    /// Sets the variables of the first instances.
    void set_variables(const std::vector<std::vector<double>>& variables);

  private:
    const PlantProgram& program_;
    Machine& machine_;
    std::vector<std::unique_ptr<SystemInstance>> instances_;
    std::size_t variables_ = 0;  // of sub-L-systems
};

/// A production that applies to modules, and the end of its predecessor.
struct AppliedProduction {
    const Production* production = nullptr;  ///< null: none applies
    ModuleString::Position end = ModuleString::kNone;
};

/// Searches a set for the first production that applies.
[[nodiscard]] AppliedProduction first_match(
    Matcher& matcher,
    const ProductionSet& set,
    const ModuleString& text,
    ModuleString::Position p,
    const ModuleRange* origin,
    SystemInstance& instance);

/// Makes derivation steps.
class Rewriter {
  public:
    /// All outlive the rewriter.
    Rewriter(MachineState& state, Machine& machine, SystemInstances& instances, Notices& notices)
        : state_(state),
          machine_(machine),
          instances_(instances),
          notices_(notices),
          matcher_(machine) {}

    /// Rewrites all modules of a string, from left to right.
    /// @param old  its modules ?(id, scale) get the numbers of their L-systems
    /// @param max_bytes  of the new string
    /// @throws InputError  if it gets too large
    void derive(ModuleString& old, ModuleString& out, std::size_t max_bytes);

  private:
    using Position = ModuleString::Position;

    /// Rewrites the modules at `p`. @returns the position after them
    Position rewrite(
        const ModuleString& old, Position p, SystemInstance& instance, ModuleString& out);
    [[nodiscard]] AppliedProduction choose_at_random(
        const ModuleString& old, Position p, SystemInstance& instance);
    /// Appends the successor of a production with its decomposition.
    /// @param depth  of the production: 0 for those of the derivation
    void apply(
        const Production& production,
        const ModuleRange& origin,
        int depth,
        SystemInstance& instance,
        ModuleString& out);
    /// Appends a text with its decomposition.
    void decompose(
        const ModuleString& text,
        const ModuleRange& origin,
        int depth,
        SystemInstance& instance,
        ModuleString& out);
    Position decompose_module(
        const ModuleRange& module,
        const ModuleRange& origin,
        int depth,
        SystemInstance& instance,
        ModuleString& out);
    /// Appends the decomposition of a module by a production, or the module if there is none.
    Position replace_module(
        const AppliedProduction& applied,
        const ModuleRange& module,
        const ModuleRange& origin,
        int depth,
        SystemInstance& instance,
        ModuleString& out);
    void check_size(const ModuleString& out) const;
    ModuleString& scratch(std::size_t depth);

    MachineState& state_;
    Machine& machine_;
    SystemInstances& instances_;
    Notices& notices_;
    Matcher matcher_;
    std::deque<ModuleString> scratch_;
    std::size_t max_bytes_ = 0;
    struct Candidate {
        AppliedProduction applied;
        double weight = 0;
    };
    std::vector<Candidate> candidates_;  // scratch
};

}  // namespace quasimc
