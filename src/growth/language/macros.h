#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/notices.h"
#include "quasimc/error.h"

namespace quasimc {

/// A macro of the preprocessor.
struct Macro {
    bool is_function = false;
    std::vector<std::string> parameters;
    std::string body;
    std::string definition;  ///< parameters and body as written, to compare definitions
    int active = 0;          ///< number of its expansions that are being read
};

using MacroTable = std::map<std::string, Macro, std::less<>>;

/// Collects the faults of a text and sends warnings, with the current line; counts the bytes made.
struct PreprocessorLog {
    Notices& notices;
    Faults faults{};
    std::string file{};
    std::uint32_t line = 1;
    std::size_t bytes = 0;

    /// "file:line" of the current line.
    [[nodiscard]] std::string where() const { return file + ":" + std::to_string(line); }
    void warn(const std::string& text) const { notices.once(where() + ": " + text); }
    void add_fault(const std::string& problem, const std::string& why) {
        faults.add({where(), problem, why, ""});
    }
    /// Records a fault. @throws InputError  always
    [[noreturn]] void fail(const std::string& problem, const std::string& why) {
        add_fault(problem, why);
        throw InputError(faults.all());
    }
    /// Counts bytes. @throws InputError  above 64 MiB
    void spend(std::size_t more_bytes);
};

/// Marks a name that must not be expanded again. No text to be expanded contains it.
inline constexpr char kPaint = '\x01';

/// The string, word (letters and digits) or other character at the start of a text; "" at its end.
[[nodiscard]] std::string_view first_token(std::string_view text);

/// The name at the start of a text, or "".
[[nodiscard]] std::string_view name_at_start(std::string_view text);

/// Reads the definition of a macro, the text after its name. Empty if its parameters are wrong.
[[nodiscard]] std::optional<Macro> read_macro(std::string_view definition);

/// Reads the line after a text; empty: there is none.
using NextLine = std::function<std::optional<std::string>()>;

/// Expands the macros of a text. Arguments are expanded before they are inserted; a macro is not
/// expanded within its own expansion; expansions get a trailing blank.
/// @param next_line  for arguments that extend over lines
[[nodiscard]] std::string expand_macros(
    std::string text, MacroTable& macros, PreprocessorLog& log, const NextLine& next_line = {});

}  // namespace quasimc
