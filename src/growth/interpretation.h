#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "growth/environment.h"
#include "growth/language/machine.h"
#include "growth/rewriting/rewriter.h"
#include "growth/turtle/turtle.h"

namespace quasimc {

/// The parts of a plant that its interpretations use.
struct InterpreterParts {
    const PlantProgram& program;
    MachineState& state;
    Machine& machine;
    SystemInstances& instances;
    Notices& notices;
    std::uint64_t max_modules = 0;  ///< that a homomorphism may make
};

/// A cut %(p) and the turtle there, from which the part that was cut off continues.
struct CutState {
    std::shared_ptr<const Turtle::State> turtle;
};

/// Where an interpretation goes. All may be null.
struct InterpretationOutputs {
    Drawing* drawing = nullptr;
    ModuleString* image = nullptr;            ///< receives the string with its homomorphism
    PlantEnvironment* environment = nullptr;  ///< receives the queries
    bool is_pass = false;                     ///< cuts %(p) keep their turtle
};

/// Interprets a string: from left to right, with its homomorphism, by a turtle. Modules ?P, ?H, ?L
/// and ?U receive values of the turtle.
class Interpretation {
  public:
    /// @param cuts  turtles of the cuts %(p, k); in a pass those of new cuts are added
    Interpretation(
        const InterpreterParts& parts,
        const InterpretationOutputs& outputs,
        Turtle::Commands commands,
        std::vector<CutState>& cuts);

    /// Interprets a string. To be called once. @throws InputError  if the homomorphism makes too
    /// many modules
    void run(ModuleString& string);

    [[nodiscard]] const Turtle& turtle() const { return turtle_; }
    /// Positions of the modules E that were queried, and their ids, which increase.
    struct QueryPosition {
        std::int64_t id = 0;
        ModuleString::Position position = 0;
    };
    [[nodiscard]] const std::vector<QueryPosition>& queries() const { return queries_; }

  private:
    using Position = ModuleString::Position;

    void run_modules(ModuleString& string);
    void begin_module(const ModuleString& string, Position p);
    Position interpret(ModuleString& text, Position p, const ModuleRange* origin, int depth);
    void interpret_successor(
        const Production& production,
        const ModuleRange& origin,
        int depth,
        SystemInstance& instance);
    Position interpret_terminal(ModuleString& text, Position p, int depth);
    Position interpret_question(ModuleString& text, Position p, int depth);
    Position interpret_cut(ModuleString& text, Position p, int depth);
    void query(ModuleString& text, Position e, int depth);
    void fill(ModuleString& text, Position p, char kind) const;
    void fill_old_position(ModuleString& text, Position p) const;
    void end_shapes_of_query();
    void count_module();
    void warn_depth(const ProductionSet& set, char symbol);

    InterpreterParts parts_;
    InterpretationOutputs outputs_;
    Turtle::Commands commands_;
    std::vector<CutState>& cuts_;
    Matcher matcher_;
    Turtle turtle_;
    std::deque<ModuleString> scratch_;
    std::vector<SystemInstance*> systems_;
    std::vector<QueryPosition> queries_;
    DrawnModule module_;
    std::vector<std::size_t> branches_;
    std::size_t branch_count_ = 0;
    std::int64_t offset_ = 0;  // bytes before the module, as cpfg stores them
    std::int64_t first_query_ = -1;
    Drawing* shapes_of_query_ = nullptr;  // for the next module
    std::uint64_t modules_ = 0;
};

}  // namespace quasimc
