#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quasimc {

/// The value of a preprocessor's expression, or what is wrong with it.
struct ConditionValue {
    std::int64_t value = 0;
    std::string problem;  ///< "" if there is none
};

/// Evaluates the expression of an #if, after the macros: decimal integers, parentheses, and the
/// operators ! + - * / % < <= > >= == != && || of C. Names are 0. Results that exceed 64 bits wrap
/// around.
[[nodiscard]] ConditionValue evaluate_condition(std::string_view expression);

}  // namespace quasimc
