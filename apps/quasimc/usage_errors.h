#pragma once

// What is wrong with a command line, in words.

#include <string>
#include <utility>
#include <vector>

#include "command_line.h"

/// Whether a flag takes a whole number.
[[nodiscard]] bool is_whole(const Flag& flag);

/// Whether a flag takes a number.
[[nodiscard]] bool is_number(const Flag& flag);

/// What a number may be: "whole number, 0 to 150", "number >= 0"; large bounds are left out.
[[nodiscard]] std::string number_text(bool is_whole, std::pair<double, double> range);

/// The command that the words name, or null.
[[nodiscard]] const Command* command_of(
    const Program& program, const std::vector<std::string>& words);

/// What is wrong with the value of a flag that takes a number or has choices; "" if nothing is.
[[nodiscard]] std::string about_value(const Flag& flag, const std::string& text);

/// That a word is not a command.
[[nodiscard]] std::string about_command(const Program& program, const std::string& word);

/// What is wrong with words that belong to no command or flag: one line each.
/// @param command  may be null
[[nodiscard]] std::string about_extras(
    const Program& program, const Command* command, const std::vector<std::string>& extras);

/// The flag of a command that lacks its value, at the end or before another flag; "" if none does.
[[nodiscard]] std::string flag_without_value(
    const Command& command, const std::vector<std::string>& words);
