#pragma once

// Text for terminals: messages on standard error, and paragraphs that fit the width.

#include <cstddef>
#include <string>
#include <string_view>

#include "quasimc/error.h"

/// Columns of the terminal that standard output goes to: the environment variable COLUMNS, or what
/// the terminal says, or 80. At least 40.
[[nodiscard]] std::size_t terminal_width();

/// A text broken at blanks so that no line is longer than `width`, if its words allow. Lines after
/// the first begin with `indent` blanks.
/// @param used  columns of the first line that are taken
[[nodiscard]] std::string folded(
    std::string_view text, std::size_t width, std::size_t indent, std::size_t used = 0);

/// Prints "error: text" on standard error; the first word is red on a terminal, unless NO_COLOR is
/// set (no-color.org).
void print_error(std::string_view text);

/// Prints an error for each fault, for the first 50 of them.
void print_errors(const quasimc::InputError& error);

/// Prints "warning: text" on standard error, on one line, the first word in yellow or as above.
void print_warning(std::string_view text);
