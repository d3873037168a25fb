#pragma once

#include "growth/language/code_writer.h"
#include "growth/language/model_text.h"
#include "growth/language/parser.h"
#include "growth/language/program.h"

namespace quasimc {

/// Parses productions and strings of modules.
class ProductionParser {
  public:
    /// All outlive the parser.
    ProductionParser(
        ModelText& text,
        ModelNames& names,
        CodeWriter& code,
        ExpressionParser& expressions,
        PlantProgram& program,
        Notices& notices)
        : text_(text),
          names_(names),
          code_(code),
          expressions_(expressions),
          program_(program),
          notices_(notices) {}

    /// Parses the modules of an axiom to code. @throws SyntaxError
    [[nodiscard]] CodeIndex parse_axiom(LSystem& system);
    /// Parses a production and adds it to a set. @throws SyntaxError
    void parse_production(ProductionSet& set, LSystem& system);

  private:
    [[nodiscard]] bool at_arrow() const { return text_.starts_with("-->"); }
    void parse_patterns(Production& production);
    [[nodiscard]] PatternModule parse_pattern_module();
    void parse_condition(Production& production);
    void parse_modules();
    void parse_parameter(char symbol);
    void parse_module();
    void note_symbol(char symbol, std::size_t count);

    ModelText& text_;
    ModelNames& names_;
    CodeWriter& code_;
    ExpressionParser& expressions_;
    PlantProgram& program_;
    Notices& notices_;
    LSystem* system_ = nullptr;
    char last_symbol_ = 0;
};

}  // namespace quasimc
