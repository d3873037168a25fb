#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/function_ref.h"

namespace quasimc {

/// A value that a condition compares. Numbers are compared as numbers, everything else as text.
struct WhereValue {
    std::string text;
    std::optional<double> number = {};

    /// The value of a label: a number too, if its text is a finite one.
    [[nodiscard]] static WhereValue of_text(std::string text);
    [[nodiscard]] static WhereValue of_number(double number);
};

/// A condition on named values, such as the labels of an organ (`where` of run files):
/// comparisons == != < <= > >= and `in [..]`, joined by and, or, not and parentheses.
class WhereExpression {
  public:
    /// Function that gives the value of a name; empty if there is none.
    using Lookup = FunctionRef<std::optional<WhereValue>(std::string_view name)>;

    /// @throws InputError  if the text is no condition; its location is "where"
    explicit WhereExpression(std::string_view text);

    /// Whether the condition holds. A comparison with a missing value is false.
    [[nodiscard]] bool holds(Lookup lookup) const { return holds(root_, lookup); }
    /// The names that it compares, each once, in their order.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] const std::string& text() const { return text_; }

    /// @throws InputError  if it compares a name that is not known
    /// @param kind  of the names in messages: "label"
    void check_names(std::span<const std::string_view> known, std::string_view kind) const;

    // The parts of a condition.
    enum class Comparison { equal, unequal, less, at_most, more, at_least };
    struct Operand {
        bool is_name = false;
        WhereValue value;  ///< a name's text is the name
    };
    struct Clause {
        enum class Kind { any_of, all_of, negation, comparison };
        Kind kind = Kind::comparison;
        std::vector<Clause> parts = {};  ///< joined conditions; a negation has one
        Comparison comparison = Comparison::equal;
        Operand left = {};
        std::vector<Operand> right = {};  ///< a comparison holds if it does for one of these
    };

  private:
    static bool holds(const Clause& clause, Lookup lookup);

    std::string text_;
    Clause root_;
};

}  // namespace quasimc
