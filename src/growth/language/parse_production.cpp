#include <string>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/language/production_parser.h"
#include "growth/module_string.h"

namespace quasimc {
namespace {

constexpr std::string_view kProductionForm = "write 'A(x) : x < 3 --> B(x + 1)'";

}  // namespace

CodeIndex ProductionParser::parse_axiom(LSystem& system) {
    system_ = &system;
    const CodeIndex begin = code_.here();
    code_.set_line(text_.line_of(text_.position()));
    parse_modules();
    code_.add(Op::end);
    return begin;
}

void ProductionParser::parse_production(ProductionSet& set, LSystem& system) {
    system_ = &system;
    names_.begin_production();
    Production production;
    const std::size_t start = text_.position();
    code_.set_line(text_.line_of(start));
    parse_patterns(production);
    if (production.predecessor.empty()) {
        text_.set_position(start);
        text_.fail("the production has no predecessor", "", std::string(kProductionForm));
    }
    if (text_.take(":")) {
        parse_condition(production);
    }
    text_.skip_blanks();
    if (!text_.take("-->")) {
        text_.fail(
            text_.shown_next() + " where '-->' is expected", "", std::string(kProductionForm));
    }
    production.successor = code_.here();
    parse_modules();
    code_.add(Op::end);
    const std::size_t colon = text_.position();
    if (text_.take(":")) {
        if (!system.is_stochastic) {
            notices_.once(
                "probability without seed",
                text_.where(colon) +
                    ": probabilities are ignored, as the header of the L-system has no 'seed:'");
        }
        production.probability = code_.here();
        expressions_.parse_expression(system, ExpressionParser::Newlines::end_lines);
        code_.add(Op::end);
        text_.skip_blanks();
    }
    if (!text_.at_line_end()) {
        text_.fail(text_.shown_next() + " where the end of the production is expected");
    }
    names_.end_production();
    set.by_symbol[static_cast<unsigned char>(production.predecessor.front().symbol)].push_back(
        static_cast<std::uint32_t>(set.productions.size()));
    set.productions.push_back(std::move(production));
}

void ProductionParser::parse_patterns(Production& production) {
    std::vector<PatternModule> modules;
    bool has_left = false, has_right = false, has_star = false;
    for (text_.skip_blanks(); !text_.at_line_end() && text_.peek() != ':' && !at_arrow();
         text_.skip_blanks()) {
        const char c = text_.peek();
        if (c == '<') {
            if (has_left || has_right) {
                text_.fail("a second left context");
            }
            has_left = true;
            production.left = std::move(modules);
            modules.clear();
            text_.advance();
        } else if (c == '>') {
            if (has_right) {
                text_.fail("a second right context");
            }
            has_right = true;
            production.predecessor = std::move(modules);
            modules.clear();
            text_.advance();
        } else if (c == '*') {
            has_star = true;
            text_.advance();
        } else {
            modules.push_back(parse_pattern_module());
        }
    }
    static_cast<void>(has_star);
    (has_right ? production.right : production.predecessor) = std::move(modules);
}

/// Parses a symbol and the names of its parameters.
PatternModule ProductionParser::parse_pattern_module() {
    PatternModule module;
    module.symbol = text_.peek();
    text_.advance();
    text_.skip_blanks();
    if (text_.take("(")) {
        std::vector<std::int32_t> variables;
        do {
            text_.skip_blanks();
            const std::string_view name = text_.take_name();
            if (name.empty()) {
                text_.fail(text_.shown_next() + " where the name of a parameter is expected");
            }
            if (variables.size() >= ModuleString::kMaxParameters) {
                text_.fail(fmt::format(
                    "a module has at most {} parameters", ModuleString::kMaxParameters));
            }
            variables.push_back(names_.add_parameter(name, *system_).index);
            text_.skip_blanks();
        } while (text_.take(","));
        if (!text_.take(")")) {
            text_.fail(text_.shown_next() + " where ',' or ')' is expected");
        }
        module.variables = std::move(variables);
    }
    note_symbol(module.symbol, module.variables.size());
    return module;
}

void ProductionParser::parse_condition(Production& production) {
    text_.skip_blanks();
    if (text_.peek() == '{') {
        production.before = code_.here();
        expressions_.parse_block(*system_);
        code_.add(Op::end);
        text_.skip_blanks();
    }
    if (!text_.take("*") && !at_arrow()) {
        production.condition = code_.here();
        expressions_.parse_expression(*system_, ExpressionParser::Newlines::end_lines);
        code_.add(Op::end);
    }
    text_.skip_blanks();
    if (text_.peek() == '{') {
        production.after = code_.here();
        expressions_.parse_block(*system_);
        code_.add(Op::end);
    }
}

void ProductionParser::parse_modules() {
    text_.skip_blanks();
    if (text_.take("*")) {
        text_.skip_blanks();
        return;
    }
    for (; !text_.at_line_end() && text_.peek() != ':'; text_.skip_blanks()) {
        const char c = text_.peek();
        if (c == '<' || c == '>') {
            text_.fail(
                fmt::format("'{}' is not a symbol", c), "it marks contexts of a predecessor");
        }
        if (c == '*') {
            text_.fail("'*' among modules", "alone it means no modules");
        }
        parse_module();
    }
}

/// Parses a parameter. A text, as that of a label @L, is a number in the string: its index.
void ProductionParser::parse_parameter(char symbol) {
    text_.skip_blanks();
    if (text_.peek() != '"') {
        expressions_.parse_expression(*system_, ExpressionParser::Newlines::end_lines);
        return;
    }
    if (symbol == 'S') {
        text_.fail("a command of the shell is refused", "models start no programs", "remove it");
    }
    expressions_.parse_text(*system_);
}

void ProductionParser::parse_module() {
    const char symbol = text_.peek();
    text_.advance();
    text_.skip_blanks();
    std::size_t count = 0;
    if (text_.peek() == '(') {
        text_.advance();
        do {
            if (++count > ModuleString::kMaxParameters) {
                text_.fail(fmt::format(
                    "a module has at most {} parameters", ModuleString::kMaxParameters));
            }
            parse_parameter(symbol);
            text_.skip_blanks();
        } while (text_.take(","));
        if (!text_.take(")")) {
            text_.fail(text_.shown_next() + " where ',' or ')' is expected");
        }
    }
    code_.add(Op::emit, static_cast<unsigned char>(symbol), count);
    note_symbol(symbol, count);
}

/// Queries and cuts that are kept need environment passes.
void ProductionParser::note_symbol(char symbol, std::size_t count) {
    program_.has_queries = program_.has_queries || (symbol == 'E' && last_symbol_ == '?');
    last_symbol_ = symbol;
    program_.asks_environment =
        program_.asks_environment || (symbol == '?' && count == 0) || (symbol == '%' && count > 0);
}

}  // namespace quasimc
