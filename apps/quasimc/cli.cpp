// The tables of flags as a parser of CLI11. No other file includes it, as it takes seconds to
// compile.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_line.h"
#include "terminal.h"
#include "usage_errors.h"

namespace {

/// Values, default and need of a flag.
std::string value_text(const Flag& flag) {
    std::vector<std::string> parts;
    if (!flag.takes.empty()) {
        parts.push_back(flag.takes);
    } else if (!flag.choices.empty()) {
        parts.push_back(fmt::format("one of {}", fmt::join(flag.choices, ", ")));
    } else if (is_number(flag)) {
        const double low = is_whole(flag) ? 0 : -HUGE_VAL;
        parts.push_back(number_text(is_whole(flag), flag.range.value_or(std::pair(low, HUGE_VAL))));
    }
    if (!flag.default_text.empty()) {
        parts.push_back("default " + flag.default_text);
    }
    if (flag.required && !is_argument(flag)) {
        parts.push_back("required");
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// The summary of a flag, with its values in one pair of parentheses at the end.
std::string described(const Flag& flag) {
    const std::string values = value_text(flag);
    if (values.empty()) {
        return flag.summary;
    }
    return flag.summary.ends_with(')')
               ? fmt::format("{}; {})", flag.summary.substr(0, flag.summary.size() - 1), values)
               : fmt::format("{} ({})", flag.summary, values);
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
        const std::string text = make_description(app) + make_usage(app, std::move(name)) +
                                 make_subcommands(app, mode) + make_positionals(app) +
                                 make_groups(app, mode) + "\n" + make_footer(app);
        return CLI::detail::find_and_replace(text, "\n\n\n", "\n\n");
    }
    std::string make_description(const CLI::App* app) const override {
        std::string text = app->get_description();
        text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
        return folded(text, width_, 0) + (text.ends_with('.') ? "\n\n" : ".\n\n");
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

/// CLI11 treats an empty text as a missing one.
CLI::Option* add_target(CLI::App& app, const Flag& flag, std::optional<std::string>* target) {
    return app.add_option_function<std::string>(
        flag.name, [target](const std::string& text) { *target = text; }, flag.summary);
}

template <typename T>
CLI::Option* add_target(CLI::App& app, const Flag& flag, T* target) {
    return app.add_option(flag.name, *target, flag.summary);
}

bool takes_one_value(const Flag& flag) {
    return !std::holds_alternative<bool*>(flag.target) &&
           !std::holds_alternative<std::vector<std::string>*>(flag.target);
}

bool has_checked_values(const Flag& flag) {
    return !flag.choices.empty() || is_number(flag);
}

void add_flag(CLI::App& app, const Flag& flag) {
    CLI::Option& option =
        *std::visit([&](auto* target) { return add_target(app, flag, target); }, flag.target);
    option.required(flag.required);
    option.description(described(flag));
    option.group(flag.group);
    if (!std::holds_alternative<bool*>(flag.target)) {
        option.option_text(type_name(flag));
    }
    if (has_checked_values(flag)) {
        option.check([&flag](const std::string& text) { return about_value(flag, text); });
    }
}

void add_flags(CLI::App& app, const std::vector<Flag>& flags) {
    app.set_help_flag();  // added again below, so that its group is last
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
    added.group("Commands");
    added.footer("");
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

/// `quasimc help run` as `quasimc run --help`.
std::vector<std::string> arguments_of(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty() && arguments.front() == "help") {
        arguments.front() = "--help";
        std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
    }
    return arguments;
}

/// Replaces the flags that another program names otherwise.
std::vector<std::string> with_own_names(
    const Command& command, std::vector<std::string> arguments) {
    for (std::string& word : arguments) {
        const auto old = std::find_if(
            command.old_flags.begin(), command.old_flags.end(),
            [&](const OldFlag& flag) { return flag.old == word; });
        word = old != command.old_flags.end() ? std::string(old->flag) : word;
    }
    return arguments;
}

/// The errors of an option: repeated, excluded by another, or of wrong values; one line each.
std::string about_option(const CLI::App& app, const Flag& flag) {
    const CLI::Option& option = *app.get_option(std::string(names_of(flag).front()));
    const std::string name = option.get_name();
    std::string lines;
    if (takes_one_value(flag) && option.count() > 1) {
        lines += fmt::format(
            "{}: it is given {} times (it takes one value); give it once\n", name, option.count());
    }
    if (!flag.excludes.empty() && option.count() > 0 &&
        app.get_option(flag.excludes)->count() > 0) {
        lines += fmt::format(
            "{0}: it is given with {1} (each excludes the other); remove one of them\n", name,
            flag.excludes);
    }
    for (const std::string& text : has_checked_values(flag) ? option.results() : CLI::results_t()) {
        const std::string problem = about_value(flag, text);
        lines += problem.empty() ? "" : fmt::format("{}: {}\n", name, problem);
    }
    return lines;
}

/// The errors of all options; if there are none, that of the parser.
std::string about_options(
    const CLI::App& app, const Command* command, const CLI::ParseError& error) {
    std::string lines;
    for (const Flag& flag : command != nullptr ? command->flags : std::vector<Flag>()) {
        lines += about_option(*app.get_subcommand(command->name), flag);
    }
    return lines.empty() ? error.what() : lines;
}

/// Prints the errors of a command line.
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
    std::vector<std::string> arguments = arguments_of(argc, argv);
    const Command* command = command_of(program, arguments);
    if (command != nullptr) {
        arguments = with_own_names(*command, std::move(arguments));
    }
    if (command == nullptr && !arguments.empty() && !arguments.front().starts_with('-')) {
        return refuse(program, command, about_command(program, arguments.front()));
    }
    // The parser would take another flag for the value.
    const std::string flag = command != nullptr ? flag_without_value(*command, arguments) : "";
    if (!flag.empty()) {
        return refuse(program, command, flag + ": a value is missing");
    }
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
        parsed.help = app.help();
    } catch (const CLI::ExtrasError&) {
        return refuse(program, command, about_extras(program, command, app.remaining(true)));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            return refuse(program, command, about_options(app, command, error));
        }
        app.exit(error, std::cout, std::cerr);
        parsed.exit = Exit::done;
    }
    return parsed;
}
