#include "growth/language/condition.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/text.h"
#include "growth/language/macros.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

using Int = std::int64_t;
using Bits = std::uint64_t;

struct BinaryOperator {
    std::string_view text;
    int precedence;  ///< 1 binds least
    Int (*apply)(Int, Int);
};

/// Longer texts precede shorter ones with the same start. Sums of unsigned numbers wrap around.
constexpr BinaryOperator kConditionOperators[] = {
    {"||", 1, [](Int a, Int b) { return Int(a != 0 || b != 0); }},
    {"&&", 2, [](Int a, Int b) { return Int(a != 0 && b != 0); }},
    {"==", 3, [](Int a, Int b) { return Int(a == b); }},
    {"!=", 3, [](Int a, Int b) { return Int(a != b); }},
    {"<=", 4, [](Int a, Int b) { return Int(a <= b); }},
    {">=", 4, [](Int a, Int b) { return Int(a >= b); }},
    {"<", 4, [](Int a, Int b) { return Int(a < b); }},
    {">", 4, [](Int a, Int b) { return Int(a > b); }},
    {"+", 5, [](Int a, Int b) { return Int(Bits(a) + Bits(b)); }},
    {"-", 5, [](Int a, Int b) { return Int(Bits(a) - Bits(b)); }},
    {"*", 6, [](Int a, Int b) { return Int(Bits(a) * Bits(b)); }},
    {"/", 6, [](Int a, Int b) { return b == -1 ? Int(-Bits(a)) : a / b; }},
    {"%", 6, [](Int a, Int b) { return b == -1 ? 0 : a % b; }},
};

/// A parser by precedence climbing.
class ConditionParser {
  public:
    explicit ConditionParser(std::string_view text) : rest_(text) {}

    ConditionValue parse() {
        const Int value = binary(1);
        if (!next().empty()) {
            refuse(shown(rest_) + " is not part of an expression");
        }
        return {value, problem_};
    }

  private:
    /// The text after blanks.
    std::string_view next() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
        return rest_;
    }
    bool accept(std::string_view token) {
        const bool matches = next().starts_with(token);
        rest_.remove_prefix(matches ? token.size() : 0);
        return matches;
    }
    /// Records the first problem and ends the text.
    Int refuse(const std::string& problem) {
        problem_ = problem_.empty() ? problem : problem_;
        rest_ = {};
        return 0;
    }
    Int binary(int least_precedence);
    Int operand();
    Int number_or_name();

    std::string_view rest_;
    std::string problem_;
    int depth_ = 0;
    int skipped_ = 0;  ///< above 0 in operands whose value is not used
};

/// operand {operator binary}, of operators that bind at least as strongly as the given precedence
Int ConditionParser::binary(int least_precedence) {
    Int left = operand();
    while (true) {
        const std::string_view rest = next();
        const auto* const found = std::find_if(
            std::begin(kConditionOperators), std::end(kConditionOperators),
            [&](const BinaryOperator& candidate) { return rest.starts_with(candidate.text); });
        if (found == std::end(kConditionOperators) || found->precedence < least_precedence) {
            return left;
        }
        rest_.remove_prefix(found->text.size());
        const bool is_decided =
            (found->text == "||" && left != 0) || (found->text == "&&" && left == 0);
        skipped_ += is_decided ? 1 : 0;
        Int right = binary(found->precedence + 1);
        skipped_ -= is_decided ? 1 : 0;
        if (right == 0 && (found->text == "/" || found->text == "%")) {
            right = skipped_ > 0 ? 1 : refuse("a division by 0") + 1;
        }
        left = found->apply(left, right);
    }
}

/// ( binary ), a sign and an operand, a number or a name
Int ConditionParser::operand() {
    constexpr int kMaxDepth = 200;
    if (++depth_ > kMaxDepth) {
        return refuse("the expression is nested too deeply");
    }
    Int value = 0;
    if (accept("(")) {
        value = binary(1);
        value = accept(")") ? value : refuse("a \")\" is missing");
    } else if (accept("!")) {
        value = operand() == 0 ? 1 : 0;
    } else if (accept("-")) {
        value = Int(-Bits(operand()));
    } else {
        value = accept("+") ? operand() : number_or_name();
    }
    --depth_;
    return value;
}

Int ConditionParser::number_or_name() {
    const std::string_view word = first_token(next());
    rest_.remove_prefix(word.size());
    if (!name_at_start(word).empty()) {
        return 0;
    }
    const std::optional<Int> value = parse_integer(word);
    if (!value) {
        return refuse(
            word.empty() ? "the expression is incomplete" : shown(word) + " is not an integer");
    }
    return *value;
}

}  // namespace

ConditionValue evaluate_condition(std::string_view expression) {
    return ConditionParser(expression).parse();
}

}  // namespace quasimc
