#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/language/parser.h"

namespace quasimc {
namespace {

/// Largest depth of nested statements, and number of elements of all arrays.
constexpr int kMaxStatementNesting = 50;
constexpr double kMaxElements = 10'000'000;

}  // namespace

void ExpressionParser::parse_block(LSystem& system) {
    system_ = &system;
    newlines_ = Newlines::are_blanks;
    depth_ = 0;
    statements();
}

void ExpressionParser::statements() {
    expect("{", "a block is in braces");
    if (++depth_ > kMaxStatementNesting) {
        text_.fail("blocks are nested too deeply");
    }
    skip();
    if (text_.peek() == '}') {
        text_.fail("an empty block", "a block has at least one statement");
    }
    while (!text_.take("}")) {
        if (text_.at_end()) {
            text_.fail("a block is not closed", "'}' is missing");
        }
        statement();
        skip();
    }
    --depth_;
}

void ExpressionParser::statement() {
    skip();
    code_.set_line(text_.line_of(text_.position()));
    const std::size_t position = text_.position();
    const std::string_view name = text_.take_name();
    if (name.empty()) {
        text_.fail(text_.shown_next() + " where a statement is expected");
    }
    if (name == "if") {
        if_statement();
    } else if (name == "while") {
        while_statement();
    } else if (name == "do") {
        do_statement();
    } else {
        skip();
        if (text_.peek() == '(') {
            call(name, position);
            code_.add(Op::drop);
        } else {
            assignment(name, position);
        }
        expect(";", "a statement ends with it");
    }
}

void ExpressionParser::assignment(std::string_view name, std::size_t position) {
    const std::int32_t* array = names_.find_array(name);
    const std::size_t count = array != nullptr ? indices(name) : 0;
    skip();
    if (text_.peek() != '=' || text_.peek(1) == '=') {
        text_.fail(
            fmt::format("{} where '=' is expected", text_.shown_next()),
            fmt::format("{} is assigned a value, or called", shown(name)));
    }
    text_.advance();
    ternary();
    if (array != nullptr) {
        code_.add(Op::store_array, *array, count);
        return;
    }
    if (find_plant_function(name) != nullptr) {
        text_.set_position(position);
        text_.fail(shown(name) + " is a function", "it can't be assigned a value");
    }
    const VariableName* found = names_.find(name);
    const VariableName target = found != nullptr ? *found : names_.add(name, *system_);
    code_.add(target.is_global ? Op::store_global : Op::store, target.index);
}

void ExpressionParser::if_statement() {
    expect("(", "a condition is in parentheses");
    ternary();
    expect(")", "a parenthesis is open");
    const CodeIndex to_else = code_.add(Op::jump_if_zero);
    statements();
    skip();
    const std::size_t after = text_.position();
    if (text_.take_name() == "else") {
        const CodeIndex to_end = code_.add(Op::jump);
        code_.land(to_else);
        statements();
        code_.land(to_end);
        return;
    }
    text_.set_position(after);
    code_.land(to_else);
}

void ExpressionParser::while_statement() {
    expect("(", "a condition is in parentheses");
    const CodeIndex begin = code_.here();
    code_.add(Op::next_round);
    ternary();
    expect(")", "a parenthesis is open");
    const CodeIndex to_end = code_.add(Op::jump_if_zero);
    statements();
    code_.add(Op::jump, begin);
    code_.land(to_end);
}

void ExpressionParser::do_statement() {
    const CodeIndex begin = code_.here();
    code_.add(Op::next_round);
    statements();
    skip();
    if (text_.take_name() != "while") {
        text_.fail("'do' without 'while'", "", "write do { ... } while (condition);");
    }
    expect("(", "a condition is in parentheses");
    ternary();
    expect(")", "a parenthesis is open");
    code_.add(Op::jump_if_true, begin);
    expect(";", "a statement ends with it");
}

void ExpressionParser::parse_definitions(LSystem& system, PlantProgram& program) {
    system_ = &system;
    newlines_ = Newlines::are_blanks;
    depth_ = 0;
    expect("{", "definitions are in braces");
    skip();
    while (!text_.take("}")) {
        if (text_.take_name() != "array") {
            text_.fail(
                text_.shown_next() + " where 'array' is expected", "",
                "write define: { array a[3] = {1, 2, 3}; }");
        }
        define_array(program);
        skip();
    }
}

/// A number with a sign.
double ExpressionParser::define_number() {
    skip();
    const bool is_negative = text_.take("-");
    skip();
    const double value = read_number();
    return is_negative ? -value : value;
}

void ExpressionParser::define_array(PlantProgram& program) {
    skip();
    const std::string name(text_.take_name());
    if (name.empty()) {
        text_.fail(text_.shown_next() + " where the name of an array is expected");
    }
    PlantArray array{static_cast<std::int32_t>(system_->variables.size()), {}};
    double elements = 1;
    skip();
    while (text_.take("[")) {
        const double size = define_number();
        elements *= size;
        if (!(size >= 1) || size != std::floor(size)) {
            text_.fail(
                fmt::format("the size of array {} is not an integer from 1 on", shown(name)));
        }
        if (elements + static_cast<double>(system_->variables.size()) > kMaxElements) {
            text_.fail(
                fmt::format("array {} is too large", shown(name)),
                fmt::format("all arrays together have at most {} elements", kMaxElements));
        }
        array.sizes.push_back(static_cast<std::int32_t>(size));
        expect("]", "a size is open");
        skip();
    }
    if (array.sizes.empty()) {
        text_.fail(fmt::format("array {} without a size", shown(name)), "", "write array a[3];");
    }
    std::vector<double> values;
    if (text_.take("=")) {
        expect("{", "values of an array are in braces");
        do {
            values.push_back(define_number());
            skip();
        } while (text_.take(","));
        expect("}", "a list of values is open");
    }
    expect(";", "a definition ends with it");
    values.resize(static_cast<std::size_t>(elements));
    system_->variables.insert(system_->variables.end(), values.begin(), values.end());
    names_.add_array(name, static_cast<std::int32_t>(program.arrays.size()));
    program.arrays.push_back(std::move(array));
}

}  // namespace quasimc
