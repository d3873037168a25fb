#pragma once

#include <string_view>
#include <vector>

#include "base/notices.h"
#include "growth/language/code_writer.h"
#include "growth/language/model_text.h"
#include "growth/language/program.h"

namespace quasimc {

/// Parses expressions and statements to code of the stack machine. By increasing precedence:
///
///     e ? e : e    ||    &&    == != <>    < <= > >=    + -    * / %    ^    -e    !e
///
/// Binary operators of a row associate to the left. The condition of ?:, || and && are evaluated
/// first, and decide which operands are.
class ExpressionParser {
  public:
    /// Where newlines are blanks: within braces and parentheses of blocks.
    enum class Newlines { end_lines, are_blanks };

    /// All outlive the parser.
    ExpressionParser(ModelText& text, ModelNames& names, CodeWriter& code, Notices& notices)
        : text_(text), names_(names), code_(code), notices_(notices) {}

    /// Parses an expression, whose value is pushed. @throws SyntaxError
    void parse_expression(LSystem& system, Newlines newlines);
    /// Parses a text in quotes, whose index is pushed. @throws SyntaxError
    void parse_text(LSystem& system);
    /// Parses "{ statements }". @throws SyntaxError
    void parse_block(LSystem& system);
    /// Parses "{ array a[n] = {...}; ... }". @throws SyntaxError
    void parse_definitions(LSystem& system, PlantProgram& program);

  private:
    void ternary();
    void logical_or();
    void logical_and();
    void binary(std::size_t row);
    void unary();
    void primary();
    void number();
    [[nodiscard]] double read_number();
    void name();
    void call(std::string_view function, std::size_t position);
    [[nodiscard]] std::size_t settled_arguments(
        const FunctionEntry& entry, std::size_t count, std::size_t position);
    void argument(bool is_text, bool is_address);
    void text_literal();
    std::string read_text();
    [[nodiscard]] std::size_t indices(std::string_view array);
    [[nodiscard]] VariableName variable(std::string_view name, std::size_t position);

    void statement();
    void statements();
    void if_statement();
    void while_statement();
    void do_statement();
    void assignment(std::string_view name, std::size_t position);
    void define_array(PlantProgram& program);
    double define_number();

    void skip();
    void expect(std::string_view word, std::string_view why);

    ModelText& text_;
    ModelNames& names_;
    CodeWriter& code_;
    Notices& notices_;
    LSystem* system_ = nullptr;
    Newlines newlines_ = Newlines::end_lines;
    int depth_ = 0;
};

/// Parses the preprocessed text of a model.
///
///     file        = system+
///     system      = "Lsystem:" label header* "axiom:" modules production* section* "endlsystem"
///     header      = "ring lsystem" | "seed:" e | "derivation length:" e | "ignore:" symbols
///                 | "consider:" symbols | "define:" "{" array* "}"
///                 | ("Start:" | "StartEach:" | "EndEach:" | "End:") block
///     section     = ("decomposition" | "homomorphism") [":"] ["warnings" | "no warnings"]
///                   ("maximum depth:" e | "seed:" e)* production*
///     production  = [context "<"] pattern [">" context] [":" [block] condition [block]]
///                   "-->" modules [":" e]
///     modules     = "*" | (symbol ["(" e ("," e)* ")"])*
///     pattern     = (symbol ["(" name ("," name)* ")"])+
///     block       = "{" statement+ "}"
///     statement   = name index* "=" e ";" | function "(" arguments ")" ";" | "if" "(" e ")" block
///                   ["else" block] | "while" "(" e ")" block | "do" block "while" "(" e ")" ";"
///
/// A symbol is any character except < > : *. A newline ends a line, unless a tab follows.
/// @throws InputError  with all faults
void parse_model(const PreprocessedText& text, PlantProgram& program, Notices& notices);

}  // namespace quasimc
