#include "usage_errors.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "text/numbers.h"

namespace {

/// "; did you mean '--paths'?", or nothing if no candidate is near.
template <typename Candidates>
std::string nearest(std::string_view word, const Candidates& candidates) {
    const std::vector<std::string_view> views(candidates.begin(), candidates.end());
    const std::string near = quasimc::near_word_text(word, views);
    return near.empty() ? "" : "; " + near;
}

/// The flag of a command by one of its names, or null.
const Flag* find_flag(const Command& command, std::string_view word) {
    for (const Flag& flag : command.flags) {
        const auto names = names_of(flag);
        if (word.starts_with('-') && std::find(names.begin(), names.end(), word) != names.end()) {
            return &flag;
        }
    }
    return nullptr;
}

}  // namespace

std::vector<std::string_view> names_of(const Flag& flag) {
    std::vector<std::string_view> names;
    for (std::string_view rest = flag.name; !rest.empty();) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        names.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return names;
}

bool is_whole(const Flag& flag) {
    return std::holds_alternative<int*>(flag.target) ||
           std::holds_alternative<std::size_t*>(flag.target);
}

bool is_number(const Flag& flag) {
    return is_whole(flag) || std::holds_alternative<double*>(flag.target) ||
           std::holds_alternative<std::optional<double>*>(flag.target);
}

std::string number_text(bool is_whole, std::pair<double, double> range) {
    constexpr double kLarge = 1e5;
    const std::string kind = is_whole ? "whole number" : "number";
    const auto [low, high] = range;
    if (high < kLarge) {
        return fmt::format("{}, {} to {}", kind, low, high);
    }
    return std::isfinite(low) ? fmt::format("{} >= {}", kind, low) : kind;
}

std::string about_value(const Flag& flag, const std::string& text) {
    const auto& names = flag.choices;
    if (!names.empty()) {
        return std::find(names.begin(), names.end(), text) != names.end()
                   ? ""
                   : fmt::format(
                         "'{}' is not one of {}{}", text, fmt::join(names, ", "),
                         nearest(text, names));
    }
    const auto number = quasimc::parse_real(text);
    if (!number || !std::isfinite(*number) || (is_whole(flag) && !quasimc::parse_integer(text))) {
        return fmt::format("'{}' is not a {}", text, is_whole(flag) ? "whole number" : "number");
    }
    const auto [low, high] = flag.range.value_or(
        is_whole(flag) ? std::pair(0.0, 0x1p31) : std::pair(-HUGE_VAL, HUGE_VAL));
    return *number < low || *number > high
               ? fmt::format("{} is out of range ({} to {})", text, low, high)
               : "";
}

std::string about_command(const Program& program, const std::string& word) {
    std::vector<std::string_view> names;
    for (const Command& command : program.commands) {
        names.push_back(command.name);
    }
    const std::string near = word.ends_with(".toml")
                                 ? fmt::format("; did you mean 'quasimc run {}'?", word)
                                 : nearest(word, names);
    return fmt::format(
        "unknown command '{}'{}", word,
        near.empty() ? fmt::format(" (one of {})", fmt::join(names, ", ")) : near);
}

std::string about_extras(
    const Program& program, const Command* command, const std::vector<std::string>& extras) {
    std::vector<std::string_view> flags{"--help"};
    for (const Flag& flag : command != nullptr ? command->flags : program.flags) {
        for (const std::string_view name : names_of(flag)) {
            if (name.starts_with("--")) {
                flags.push_back(name);
            }
        }
    }
    std::string flag_lines;
    std::string word_lines;
    for (const std::string& word : extras) {
        const std::string name = word.substr(0, word.find('='));
        if (word.size() > 1 && word.starts_with('-')) {
            flag_lines += fmt::format("unknown option {}{}\n", name, nearest(name, flags));
        } else if (command == nullptr) {
            word_lines += about_command(program, word) + "\n";
        } else {
            word_lines += fmt::format("unexpected argument '{}'\n", word);
        }
    }
    // A word next to an unknown flag is probably its value, and a command precedes its flags.
    const bool has_list = command == nullptr ? !word_lines.empty() : flag_lines.empty();
    return has_list ? word_lines.substr(0, word_lines.find('\n') + 1) : flag_lines;
}

std::string flag_without_value(const Command& command, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const Flag* flag = find_flag(command, words[i]);
        const bool has_value = i + 1 < words.size() && find_flag(command, words[i + 1]) == nullptr;
        if (flag != nullptr && !std::holds_alternative<bool*>(flag->target) && !has_value) {
            return words[i];
        }
    }
    return "";
}

const Command* command_of(const Program& program, const std::vector<std::string>& words) {
    for (const Command& command : program.commands) {
        if (std::find(words.begin(), words.end(), command.name) != words.end()) {
            return &command;
        }
    }
    return nullptr;
}
