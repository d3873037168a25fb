#include <array>
#include <cctype>
#include <string>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/language/parser.h"
#include "growth/module_string.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Largest depth of nested expressions.
constexpr int kMaxNesting = 100;

struct OperatorCode {
    std::string_view text;
    Op op;
};

/// Operators of one precedence; longer ones first.
struct PrecedenceRow {
    std::array<OperatorCode, 4> operators;
    std::size_t count;
};

constexpr std::array<PrecedenceRow, 5> kPrecedence{{
    {{{{"==", Op::equal}, {"!=", Op::unequal}, {"<>", Op::unequal}}}, 3},
    {{{{"<=", Op::less_equal}, {">=", Op::greater_equal}, {"<", Op::less}, {">", Op::greater}}}, 4},
    {{{{"+", Op::add}, {"-", Op::subtract}}}, 2},
    {{{{"*", Op::multiply}, {"/", Op::divide}, {"%", Op::remainder}}}, 3},
    {{{{"^", Op::power}}}, 1},
}};

bool is_digit_character(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

void ExpressionParser::skip() {
    newlines_ == Newlines::are_blanks ? text_.skip_space() : text_.skip_blanks();
}

void ExpressionParser::expect(std::string_view word, std::string_view why) {
    skip();
    if (!text_.take(word)) {
        text_.fail(
            fmt::format("{} where '{}' is expected", text_.shown_next(), word), std::string(why));
    }
}

void ExpressionParser::parse_expression(LSystem& system, Newlines newlines) {
    system_ = &system;
    newlines_ = newlines;
    depth_ = 0;
    code_.set_line(text_.line_of(text_.position()));
    ternary();
}

void ExpressionParser::parse_text(LSystem& system) {
    system_ = &system;
    text_literal();
}

void ExpressionParser::ternary() {
    if (++depth_ > kMaxNesting) {
        text_.fail(
            "the expression is nested too deeply", fmt::format("the limit is {}", kMaxNesting));
    }
    logical_or();
    skip();
    if (text_.take("?")) {
        const CodeIndex to_else = code_.add(Op::jump_if_zero);
        ternary();
        expect(":", "a condition has two values: a ? b : c");
        const CodeIndex to_end = code_.add(Op::jump);
        code_.land(to_else);
        ternary();
        code_.land(to_end);
    }
    --depth_;
}

void ExpressionParser::logical_or() {
    logical_and();
    skip();
    while (text_.take("||")) {
        const CodeIndex to_true = code_.add(Op::jump_if_true);
        logical_and();
        code_.add(Op::truth);
        const CodeIndex to_end = code_.add(Op::jump);
        code_.land(to_true);
        code_.add_constant(1);
        code_.land(to_end);
        skip();
    }
}

void ExpressionParser::logical_and() {
    binary(0);
    skip();
    while (text_.take("&&")) {
        const CodeIndex to_false = code_.add(Op::jump_if_zero);
        binary(0);
        code_.add(Op::truth);
        const CodeIndex to_end = code_.add(Op::jump);
        code_.land(to_false);
        code_.add_constant(0);
        code_.land(to_end);
        skip();
    }
}

void ExpressionParser::binary(std::size_t row) {
    if (row == kPrecedence.size()) {
        unary();
        return;
    }
    binary(row + 1);
    const auto& [operators, count] = kPrecedence[row];
    for (bool is_found = true; is_found;) {
        is_found = false;
        skip();
        for (std::size_t i = 0; i < count && !is_found; ++i) {
            // "-->" is no minus, and "<>" no less-than.
            const bool is_other = text_.starts_with("-->") ||
                                  (text_.starts_with("<>") && operators[i].op == Op::less);
            if (!is_other && text_.take(operators[i].text)) {
                binary(row + 1);
                code_.add(operators[i].op);
                is_found = true;
            }
        }
    }
}

void ExpressionParser::unary() {
    skip();
    if (++depth_ > kMaxNesting) {
        text_.fail(
            "the expression is nested too deeply", fmt::format("the limit is {}", kMaxNesting));
    }
    if (text_.peek() == '-' && !text_.starts_with("-->")) {
        text_.advance();
        unary();
        code_.add(Op::negative);
    } else if (text_.peek() == '!' && text_.peek(1) != '=') {
        text_.advance();
        unary();
        code_.add(Op::logical_not);
    } else {
        primary();
    }
    --depth_;
}

void ExpressionParser::primary() {
    skip();
    const char c = text_.peek();
    if (text_.take("(")) {
        ternary();
        expect(")", "a parenthesis is open");
    } else if (is_digit_character(c) || (c == '.' && is_digit_character(text_.peek(1)))) {
        number();
    } else if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') {
        name();
    } else if (c == '"') {
        text_.fail("a text where a number is expected");
    } else {
        text_.fail(text_.shown_next() + " where a number, a name or '(' is expected");
    }
}

void ExpressionParser::number() {
    code_.add_constant(read_number());
}

/// Digits with a point; an exponent only after a point.
double ExpressionParser::read_number() {
    const std::size_t first = text_.position();
    bool has_point = false;
    while (is_digit_character(text_.peek()) || (text_.peek() == '.' && !has_point)) {
        has_point = has_point || text_.peek() == '.';
        text_.advance();
    }
    const char e = text_.peek();
    if (e == 'e' || e == 'E') {
        const std::size_t sign = text_.peek(1) == '+' || text_.peek(1) == '-' ? 1 : 0;
        if (is_digit_character(text_.peek(1 + sign))) {
            if (!has_point) {
                text_.fail(
                    "an exponent after a number without a point", "cpfg refuses it",
                    "write 1.0e10 for 1e10");
            }
            text_.advance(1 + sign);
            while (is_digit_character(text_.peek())) {
                text_.advance();
            }
        }
    }
    const auto digits = text_.text().substr(first, text_.position() - first);
    const auto value = parse_real(digits);
    if (!value) {
        text_.set_position(first);
        text_.fail(shown(digits) + " is not a number in range");
    }
    return *value;
}

void ExpressionParser::name() {
    const std::size_t position = text_.position();
    const std::string_view name = text_.take_name();
    skip();
    if (text_.peek() == '(') {
        call(name, position);
    } else if (const std::int32_t* array = names_.find_array(name)) {
        const std::size_t count = indices(name);
        code_.add(Op::load_array, *array, count);
    } else if (text_.peek() == '[') {
        text_.set_position(position);
        text_.fail(
            shown(name) + " is no array", "", "define it: define: { array a[3] = {1, 2, 3}; }");
    } else {
        const VariableName found = variable(name, position);
        code_.add(found.is_global ? Op::load_global : Op::load, found.index);
    }
}

VariableName ExpressionParser::variable(std::string_view name, std::size_t position) {
    if (const VariableName* found = names_.find(name)) {
        return *found;
    }
    notices_.once(fmt::format(
        "{}: the variable {} has no value yet and is 0", text_.where(position), shown(name)));
    return names_.add(name, *system_);
}

/// Parses the indices of an array element. @returns their number
std::size_t ExpressionParser::indices(std::string_view array) {
    std::size_t count = 0;
    constexpr std::size_t kMaxDimensions = 8;
    while (text_.take("[")) {
        if (++count > kMaxDimensions) {
            text_.fail(fmt::format("array {} has too many indices", shown(array)));
        }
        ternary();
        expect("]", "an index is open");
        skip();
    }
    if (count == 0) {
        text_.fail(fmt::format("array {} without an index", shown(array)));
    }
    return count;
}

void ExpressionParser::call(std::string_view function, std::size_t position) {
    const FunctionEntry* entry = find_plant_function(function);
    if (entry == nullptr) {
        text_.set_position(position);
        text_.fail(shown(function) + " is no function");
    }
    text_.take("(");
    std::size_t count = 0;
    do {
        const auto index = static_cast<int>(count);
        const bool is_text =
            entry->text >= 0 &&
            (index == entry->text || (entry->second_is_text && index == entry->text + 1));
        argument(is_text, entry->takes_addresses && index > entry->text);
        ++count;
        skip();
    } while (count < ModuleString::kMaxParameters && text_.take(","));
    expect(")", "a list of arguments is open");
    code_.add(
        Op::call, static_cast<std::int32_t>(entry->id), settled_arguments(*entry, count, position));
}

/// Completes a list of arguments by zeros, and drops those that are too many. @returns their number
std::size_t ExpressionParser::settled_arguments(
    const FunctionEntry& entry, std::size_t count, std::size_t position) {
    if (count >= entry.least && count <= entry.most) {
        return count;
    }
    if (entry.text >= static_cast<int>(count) || (entry.second_is_text && count == 1)) {
        text_.fail(fmt::format("{} needs a text", shown(entry.name)));
    }
    notices_.once(fmt::format(
        "{}: {} has {} arguments; {} are expected: {}", text_.where(position), shown(entry.name),
        count, count < entry.least ? entry.least : entry.most,
        count < entry.least ? "the others are 0" : "the others are dropped"));
    for (; count < entry.least; ++count) {
        code_.add_constant(0);
    }
    for (; count > entry.most; --count) {
        code_.add(Op::drop);
    }
    return count;
}

void ExpressionParser::argument(bool is_text, bool is_address) {
    skip();
    if (is_text) {
        text_literal();
        return;
    }
    if (!is_address) {
        ternary();
        return;
    }
    if (!text_.take("&")) {
        text_.fail("an argument without '&'", "values that are read need a variable");
    }
    skip();
    const std::string_view name = text_.take_name();
    if (name.empty()) {
        text_.fail(text_.shown_next() + " where the name of a variable is expected");
    }
    const VariableName* known = names_.find(name);
    const VariableName found = known != nullptr ? *known : names_.add(name, *system_);
    if (found.is_global) {
        text_.fail(shown(name) + " can't be read", "it is set by the program");
    }
    code_.add_constant(found.index);
}

void ExpressionParser::text_literal() {
    code_.add_constant(code_.text(read_text()));
}

std::string ExpressionParser::read_text() {
    if (text_.peek() != '"') {
        text_.fail(text_.shown_next() + " where a text in quotes is expected");
    }
    text_.advance();
    std::string result;
    while (text_.peek() != '"') {
        if (text_.at_end() || text_.peek() == '\n') {
            text_.fail("the quotes are not closed");
        }
        char c = text_.peek();
        text_.advance();
        if (c == '\\' && !text_.at_end()) {
            c = text_.peek();
            text_.advance();
            c = c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
        }
        result += c;
    }
    text_.advance();
    return result;
}

}  // namespace quasimc
