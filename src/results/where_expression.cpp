#include "results/where_expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

using Clause = WhereExpression::Clause;
using Comparison = WhereExpression::Comparison;
using Operand = WhereExpression::Operand;

constexpr int kMaxDepth = 64;

constexpr std::array<std::pair<std::string_view, Comparison>, 6> kComparisons{{
    {"==", Comparison::equal},
    {"!=", Comparison::unequal},
    {"<=", Comparison::at_most},
    {">=", Comparison::at_least},
    {"<", Comparison::less},
    {">", Comparison::more},
}};

/// All of a text as a finite number; empty if it is none. Independent of the locale.
std::optional<double> finite_number(std::string_view text) {
    text.remove_prefix(text.starts_with('+') ? 1 : 0);
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number);
    const bool is_whole = error == std::errc() && last == end && !text.empty();
    return is_whole && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

bool is_digit(char c) {
    return '0' <= c && c <= '9';
}

/// Whether a character can be part of a name; bytes above ASCII are those of letters in UTF-8.
bool is_of_name(char c) {
    const bool is_letter = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
    return is_letter || is_digit(c) || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

/// Recursive descent: any_of -> all_of {or all_of}; all_of -> negation {and negation}; negation ->
/// not negation | ( any_of ) | comparison.
class WhereParser {
  public:
    explicit WhereParser(std::string_view text) : text_(text), rest_(text) {}

    Clause parse() {
        Clause clause = any_of();
        skip_blanks();
        if (!rest_.empty()) {
            refuse(
                fmt::format("'{}' does not belong here", rest_), "", "join conditions by and, or");
        }
        return clause;
    }

  private:
    Clause any_of() { return joined_clauses(Clause::Kind::any_of, "or"); }

    Clause joined_clauses(Clause::Kind kind, std::string_view word) {
        const auto next = [&] { return kind == Clause::Kind::any_of ? all_of() : negation(); };
        std::vector<Clause> parts{next()};
        while (take_keyword(word)) {
            parts.push_back(next());
        }
        return parts.size() == 1 ? std::move(parts.front())
                                 : Clause{.kind = kind, .parts = std::move(parts)};
    }

    Clause all_of() { return joined_clauses(Clause::Kind::all_of, "and"); }

    Clause negation() {
        if (++depth_ > kMaxDepth) {
            refuse("it is nested too deeply", fmt::format("{} levels at most", kMaxDepth));
        }
        Clause clause = take_keyword("not")
                            ? Clause{.kind = Clause::Kind::negation, .parts = {negation()}}
                        : take("(") ? in_parentheses()
                                    : comparison();
        --depth_;
        return clause;
    }

    Clause in_parentheses() {
        Clause clause = any_of();
        expect(")");
        return clause;
    }

    Clause comparison() {
        Clause clause;
        clause.left = operand();
        if (take_keyword("in")) {
            expect("[");
            do {
                clause.right.push_back(operand());
            } while (take(","));
            expect("]");
            return clause;
        }
        clause.comparison = comparison_sign();
        clause.right.push_back(operand());
        return clause;
    }

    Comparison comparison_sign() {
        for (const auto& [sign, comparison] : kComparisons) {
            if (take(sign)) {
                return comparison;
            }
        }
        if (take("=")) {
            refuse("'=' sets nothing here", "", "compare with '=='");
        }
        refuse(
            rest_.empty() ? "a comparison is missing at its end"
                          : fmt::format("a comparison is missing before '{}'", rest_),
            "", "write as kind == 'leaf' or height > 1.2");
    }

    Operand operand() {
        skip_blanks();
        const char c = rest_.empty() ? '\0' : rest_.front();
        if (c == '\'' || c == '"') {
            return {false, quoted_text(c)};
        }
        if (is_digit(c) || c == '-' || c == '+' || c == '.') {
            return {false, number()};
        }
        const std::string_view name = take_name();
        if (name.empty()) {
            refuse(
                rest_.empty() ? "a value is missing at its end"
                              : fmt::format("'{}' is no value", rest_),
                "a value is a label, a number, or a text in quotes");
        }
        return {true, {std::string(name)}};
    }

    WhereValue quoted_text(char quote) {
        const std::size_t end = rest_.find(quote, 1);
        if (end == rest_.npos) {
            refuse(fmt::format("{} has no second quote", rest_), "", "end the text with a quote");
        }
        WhereValue value{std::string(rest_.substr(1, end - 1))};
        rest_.remove_prefix(end + 1);
        return value;
    }

    WhereValue number() {
        const auto is_of_number = [](char c) {
            return is_of_name(c) || c == '.' || c == '-' || c == '+';
        };
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_of_number);
        const std::string_view word(rest_.begin(), end);
        const std::optional<double> number = finite_number(word);
        if (!number) {
            refuse(
                fmt::format("'{}' is no number", word), "", "put texts in quotes: kind == 'leaf'");
        }
        rest_.remove_prefix(word.size());
        return WhereValue::of_number(*number);
    }

    std::string_view take_name() {
        skip_blanks();
        const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_of_name);
        const std::string_view name(rest_.begin(), end);
        rest_.remove_prefix(name.size());
        return name;
    }

    bool take_keyword(std::string_view word) {
        const std::string_view before = rest_;
        if (take_name() == word) {
            return true;
        }
        rest_ = before;
        return false;
    }

    bool take(std::string_view sign) {
        skip_blanks();
        if (!rest_.starts_with(sign)) {
            return false;
        }
        rest_.remove_prefix(sign.size());
        return true;
    }

    void expect(std::string_view sign) {
        if (!take(sign)) {
            refuse(
                rest_.empty() ? fmt::format("'{}' is missing at its end", sign)
                              : fmt::format("'{}' is missing before '{}'", sign, rest_));
        }
    }

    void skip_blanks() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    }

    [[noreturn]] void refuse(
        std::string problem, std::string why = {}, std::string suggestion = {}) {
        throw InputError(
            {{"where", fmt::format("\"{}\": {}", text_, problem), std::move(why),
              std::move(suggestion)}});
    }

    std::string_view text_, rest_;
    int depth_ = 0;
};

template <typename T>
bool compared(const T& a, Comparison comparison, const T& b) {
    switch (comparison) {
        case Comparison::equal:
            return a == b;
        case Comparison::unequal:
            return a != b;
        case Comparison::less:
            return a < b;
        case Comparison::at_most:
            return a <= b;
        case Comparison::more:
            return a > b;
        case Comparison::at_least:
            return a >= b;
    }
    return false;
}

/// Numbers are compared as such; a text has no order with a number.
bool compared(const WhereValue& a, Comparison comparison, const WhereValue& b) {
    if (a.number && b.number) {
        return compared(*a.number, comparison, *b.number);
    }
    const bool has_order = a.number.has_value() == b.number.has_value();
    const bool is_equality = comparison == Comparison::equal || comparison == Comparison::unequal;
    return (has_order || is_equality) && compared(a.text, comparison, b.text);
}

std::optional<WhereValue> value_of(const Operand& operand, WhereExpression::Lookup lookup) {
    return operand.is_name ? lookup(operand.value.text) : std::optional(operand.value);
}

void add_names(const Clause& clause, std::vector<std::string>& names) {
    const auto add = [&](const Operand& operand) {
        const bool is_new =
            std::find(names.begin(), names.end(), operand.value.text) == names.end();
        if (operand.is_name && is_new) {
            names.push_back(operand.value.text);
        }
    };
    if (clause.kind == Clause::Kind::comparison) {
        add(clause.left);
        std::for_each(clause.right.begin(), clause.right.end(), add);
    }
    for (const Clause& part : clause.parts) {
        add_names(part, names);
    }
}

}  // namespace

WhereValue WhereValue::of_text(std::string text) {
    const std::optional<double> number = finite_number(text);
    return {std::move(text), number};
}

WhereValue WhereValue::of_number(double number) {
    return {shortest(number), number};
}

WhereExpression::WhereExpression(std::string_view text)
    : text_(text), root_(WhereParser(text_).parse()) {}

bool WhereExpression::holds(const Clause& clause, Lookup lookup) {
    const auto part_holds = [&](const Clause& part) { return holds(part, lookup); };
    switch (clause.kind) {
        case Clause::Kind::any_of:
            return std::any_of(clause.parts.begin(), clause.parts.end(), part_holds);
        case Clause::Kind::all_of:
            return std::all_of(clause.parts.begin(), clause.parts.end(), part_holds);
        case Clause::Kind::negation:
            return !part_holds(clause.parts.front());
        case Clause::Kind::comparison:
            break;
    }
    const std::optional<WhereValue> left = value_of(clause.left, lookup);
    return left && std::any_of(clause.right.begin(), clause.right.end(), [&](const auto& operand) {
               const std::optional<WhereValue> right = value_of(operand, lookup);
               return right && compared(*left, clause.comparison, *right);
           });
}

std::vector<std::string> WhereExpression::names() const {
    std::vector<std::string> names;
    add_names(root_, names);
    return names;
}

void WhereExpression::check_names(
    std::span<const std::string_view> known, std::string_view kind) const {
    Faults faults;
    for (const std::string& name : names()) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            faults.add(
                {"where", fmt::format("unknown {} '{}' in \"{}\"", kind, name, text_),
                 known.empty() ? fmt::format("there are no {}s", kind)
                               : fmt::format("{}s are {}", kind, joined(known, ", ")),
                 near_word_text(name, known)});
        }
    }
    faults.throw_if_any();
}

}  // namespace quasimc
