#pragma once

// Messages on errors in command lines.

#include <string>
#include <utility>
#include <vector>

#include "command_line.h"

/// Whether a flag takes a whole number.
[[nodiscard]] bool is_whole(const Flag& flag);

/// Whether a flag takes a number.
[[nodiscard]] bool is_number(const Flag& flag);

/// The valid numbers: "whole number, 0 to 150", "number >= 0"; large bounds are left out.
[[nodiscard]] std::string number_text(bool is_whole, std::pair<double, double> range);

/// The command that the arguments name, or null.
[[nodiscard]] const Command* command_of(
    const Program& program, const std::vector<std::string>& words);

/// The message on the value of a flag that takes a number or has choices; "" if it is valid.
[[nodiscard]] std::string about_value(const Flag& flag, const std::string& text);

/// The message on a word that is no command.
[[nodiscard]] std::string about_command(const Program& program, const std::string& word);

/// The messages on words that belong to no command or flag, one line each.
/// @param command  may be null
[[nodiscard]] std::string about_extras(
    const Program& program, const Command* command, const std::vector<std::string>& extras);

/// The flag without its value, at the end or before another flag; "" if there is none.
[[nodiscard]] std::string flag_without_value(
    const Command& command, const std::vector<std::string>& words);
