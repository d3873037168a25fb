// The tables of flags as a parser of CLI11: the only file that includes it, for it takes seconds to
// compile.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "command_line.h"
#include "terminal.h"
#include "text/numbers.h"

namespace {

bool is_whole(const Flag& flag) {
    return std::holds_alternative<int*>(flag.target) ||
           std::holds_alternative<std::size_t*>(flag.target);
}

bool is_number(const Flag& flag) {
    return is_whole(flag) || std::holds_alternative<double*>(flag.target) ||
           std::holds_alternative<std::optional<double>*>(flag.target);
}

/// "whole number, 0 to 150", "number >= 0".
std::string number_text(const Flag& flag) {
    constexpr double kHigh = 1e5;  // such a bound says little
    const std::string kind = is_whole(flag) ? "whole number" : "number";
    if (!flag.range) {
        return is_whole(flag) ? kind + " >= 0" : kind;
    }
    const auto [low, high] = *flag.range;
    return high >= kHigh ? fmt::format("{} >= {}", kind, low)
                         : fmt::format("{}, {} to {}", kind, low, high);
}

/// Values, default and need of a flag, in parentheses.
std::string value_text(const Flag& flag) {
    std::vector<std::string> parts;
    if (!flag.takes.empty()) {
        parts.push_back(flag.takes);
    } else if (!flag.choices.empty()) {
        parts.push_back(fmt::format("one of {}", fmt::join(flag.choices, ", ")));
    } else if (is_number(flag)) {
        parts.push_back(number_text(flag));
    }
    if (!flag.default_text.empty()) {
        parts.push_back("default " + flag.default_text);
    }
    if (flag.required && !is_argument(flag)) {
        parts.push_back("required");
    }
    return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, "; "));
}

std::string type_name(const Flag& flag) {
    if (!flag.type_name.empty() || is_argument(flag)) {
        return flag.type_name;
    }
    return !flag.choices.empty() ? "NAME" : is_whole(flag) ? "N" : is_number(flag) ? "X" : "TEXT";
}

/// Help that is folded at the width of the terminal.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter() { label("Positionals", "Arguments"); }

    std::string make_help(
        const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        const std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
        return CLI::detail::find_and_replace(text, "\n\n\n", "\n\n");
    }
    std::string make_description(const CLI::App* app) const override {
        return folded(app->get_description(), width_, 0) + "\n\n";
    }
    std::string make_usage(const CLI::App* app, std::string name) const override {
        std::string text = CLI::Formatter::make_usage(app, std::move(name));
        text = CLI::detail::find_and_replace(text, "SUBCOMMAND", "COMMAND");
        return app->get_parent() != nullptr
                   ? text
                   : text + folded("quasimc help COMMAND explains a command.", width_, 0) + "\n";
    }
    std::string make_footer(const CLI::App* app) const override {
        return app->get_footer().empty() ? "" : folded(app->get_footer(), width_, 0) + "\n";
    }
    std::string make_subcommand(const CLI::App* command) const override {
        return row(command->get_name(), command->get_description());
    }
    std::string make_option(const CLI::Option* option, bool is_positional) const override {
        const std::string type = option->get_option_text();
        return row(
            make_option_name(option, is_positional) + (type.empty() ? "" : " " + type),
            option->get_description());
    }

  private:
    [[nodiscard]] std::string row(const std::string& left, const std::string& right) const {
        constexpr std::size_t kNarrow = 70;
        const std::size_t column = width_ < kNarrow ? 8 : 26;
        std::string text = "  " + left;
        text += text.size() + 2 > column ? "\n" + std::string(column, ' ')
                                         : std::string(column - text.size(), ' ');
        return text + folded(right, width_, column, column) + "\n";
    }

    std::size_t width_ = terminal_width();
};

CLI::Option* add_target(CLI::App& app, const Flag& flag, bool* target) {
    return app.add_flag(flag.name, *target, flag.summary);
}

/// CLI11 takes an empty text for none.
CLI::Option* add_target(CLI::App& app, const Flag& flag, std::optional<std::string>* target) {
    return app.add_option_function<std::string>(
        flag.name, [target](const std::string& text) { *target = text; }, flag.summary);
}

template <typename T>
CLI::Option* add_target(CLI::App& app, const Flag& flag, T* target) {
    return app.add_option(flag.name, *target, flag.summary);
}

/// "; did you mean '--paths'?", or nothing if no candidate is near.
template <typename Words>
std::string nearest(std::string_view word, const Words& candidates) {
    const std::vector<std::string_view> views(candidates.begin(), candidates.end());
    const std::string_view near = quasimc::nearest_word(word, views);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

/// What is wrong with the value of a flag; "" if nothing is.
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

void add_flag(CLI::App& app, const Flag& flag) {
    CLI::Option& option =
        *std::visit([&](auto* target) { return add_target(app, flag, target); }, flag.target);
    option.required(flag.required);
    option.description(flag.summary + value_text(flag));
    option.group(flag.group);
    if (!std::holds_alternative<bool*>(flag.target)) {
        option.option_text(type_name(flag));
    }
    if (!flag.choices.empty() || is_number(flag)) {
        option.check([&flag](const std::string& text) { return about_value(flag, text); });
    }
}

void add_flags(CLI::App& app, const std::vector<Flag>& flags) {
    app.set_help_flag();  // its group stands last
    for (const Flag& flag : flags) {
        add_flag(app, flag);
    }
    for (const Flag& flag : flags) {
        if (!flag.excludes.empty()) {
            app.get_option(flag.name)->excludes(app.get_option(flag.excludes));
        }
    }
    app.set_help_flag("-h,--help", "print this help")->group("Help");
}

void add_command(CLI::App& app, const Command& command, Parsed& parsed) {
    CLI::App& added = *app.add_subcommand(command.name, command.summary);
    add_flags(added, command.flags);
    added.callback([&command, &parsed] {
        try {
            if (command.check) {
                command.check();
            }
        } catch (const UsageError& error) {
            throw CLI::ValidationError(error.what());
        }
        parsed.command = &command;
    });
}

/// That a word is no command.
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

/// What is wrong with words that no command or flag asked for: one line each.
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
    // A word beside an unknown flag was probably its value, and a command goes before its flags.
    const bool has_list = command == nullptr ? !word_lines.empty() : flag_lines.empty();
    return has_list ? word_lines.substr(0, word_lines.find('\n') + 1) : flag_lines;
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

/// The flag of a command that stands there without its value, at the end or before another flag; ""
/// if none does.
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

/// The command that the words name.
const Command* command_of(const Program& program, const std::vector<std::string>& words) {
    for (const Command& command : program.commands) {
        if (std::find(words.begin(), words.end(), command.name) != words.end()) {
            return &command;
        }
    }
    return nullptr;
}

/// `quasimc help run` as `quasimc run --help`.
std::vector<std::string> words_of(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (!words.empty() && words.front() == "help") {
        words.front() = "--help";
        std::rotate(words.begin(), words.begin() + 1, words.end());
    }
    return words;
}

/// Prints what is wrong with a command line.
/// @param lines  of text
Parsed refuse(const Program& program, const Command* command, const std::string& lines) {
    for (const std::string& line : CLI::detail::split(lines, '\n')) {
        if (!line.empty()) {
            print_error(line);
        }
    }
    fmt::print(
        stderr, "Run '{}{} --help' for more information.\n", program.name,
        command != nullptr ? " " + command->name : "");
    return {.exit = Exit::usage, .command = nullptr, .help = ""};
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

Parsed parse_command_line(const Program& program, int argc, char** argv) {
    Parsed parsed;
    CLI::App app(program.summary);
    app.formatter(std::make_shared<HelpFormatter>());
    app.name(program.name);
    add_flags(app, program.flags);
    app.set_version_flag("-V,--version", program.version, "print the version")->group("Help");
    app.footer(program.footer);
    for (const Command& command : program.commands) {
        add_command(app, command, parsed);
    }
    app.require_subcommand(0, 1);
    const std::vector<std::string> words = words_of(argc, argv);
    const Command* command = command_of(program, words);
    if (command == nullptr && !words.empty() && !words.front().starts_with('-')) {
        return refuse(program, command, about_command(program, words.front()));
    }
    // The parser would take another flag for the value.
    const std::string flag = command != nullptr ? flag_without_value(*command, words) : "";
    if (!flag.empty()) {
        return refuse(program, command, flag + ": a value is missing");
    }
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        parsed.help = app.help();
    } catch (const CLI::ExtrasError&) {
        return refuse(program, command, about_extras(program, command, app.remaining(true)));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            return refuse(program, command, error.what());
        }
        app.exit(error, std::cout, std::cerr);
        parsed.exit = Exit::done;
    }
    return parsed;
}
