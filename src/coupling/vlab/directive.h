#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/notices.h"
#include "base/range.h"
#include "quasimc/error.h"

namespace quasimc {

/// A line "name: values" of a specification file, with the lines ": values" that continue it.
struct DirectiveLine {
    std::uint32_t number = 0;
    std::string name;  ///< lower case
    std::string_view value;
    std::vector<std::pair<std::uint32_t, std::string_view>> block;
};

/// The directives of a text in their order. Other lines are skipped, with a notice.
/// @param where  location of the text, for messages
[[nodiscard]] std::vector<DirectiveLine> split_directives(
    std::string_view text, const std::string& where, Notices& notices);

inline constexpr Range kAnyNumber{-1e30, 1e30};
inline constexpr Range kNotNegativeNumber{0, 1e30};

/// The values of a directive, read from left to right. Reports at most one fault per directive.
class Values {
  public:
    /// @param what  the directive as messages call it
    Values(
        std::string where,
        std::string what,
        std::string_view text,
        Faults& faults,
        Notices& notices);

    /// The next word, or "" at the end. Blanks, commas, semicolons and colons separate words.
    std::string_view word();
    [[nodiscard]] bool at_end() const;
    [[nodiscard]] std::size_t words_left() const;
    /// The next number; a fault if it is missing or out of range.
    std::optional<double> number(std::string_view name, Range range = kAnyNumber);
    std::optional<std::int64_t> integer(std::string_view name, Range range);
    /// A number, or `otherwise` at the end.
    std::optional<double> number_or(double otherwise, std::string_view name, Range range);
    /// The next word as one of `names`, without regard to case: its index among them.
    std::optional<std::size_t> choice(std::span<const std::string_view> names);
    std::optional<bool> yes_no();
    /// The unread text, unchanged: a file's name.
    std::string rest();

    void fault(std::string problem, std::string why = {}, std::string suggestion = {});
    void notice(const std::string& text);
    /// Sends a notice if there are unread words.
    void finish();

    [[nodiscard]] const std::string& where() const { return where_; }
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] Faults& faults() { return *faults_; }

  private:
    std::string where_, what_;
    std::string_view text_;
    Faults* faults_;
    Notices* notices_;
    bool failed_ = false;
};

}  // namespace quasimc
