// The tables of flags as a parser of CLI11: the only file that includes it, for it takes seconds to
// compile.

#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.h"
#include "command_line.h"

namespace {

constexpr std::string_view kSeeHelp = "Run with --help for more information.\n";

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

void add_range(CLI::Option& option, const Flag& flag) {
    const auto [low, high] = *flag.range;
    if (std::holds_alternative<double*>(flag.target)) {
        option.check(CLI::Range(low, high));
    } else {
        option.check(CLI::Range(static_cast<int>(low), static_cast<int>(high)));
    }
}

void add_flag(CLI::App& app, const Flag& flag) {
    CLI::Option& option =
        *std::visit([&](auto* target) { return add_target(app, flag, target); }, flag.target);
    option.required(flag.required);
    if (flag.type_name) {
        option.type_name(*flag.type_name);
    }
    if (!flag.choices.empty()) {
        option.check(CLI::IsMember(flag.choices));
    }
    if (flag.range) {
        add_range(option, flag);
    }
    if (flag.group) {
        option.group(*flag.group);
    }
    if (!flag.default_text.empty()) {
        option.default_str(flag.default_text);
    }
}

void add_flags(CLI::App& app, const std::vector<Flag>& flags) {
    for (const Flag& flag : flags) {
        add_flag(app, flag);
    }
    for (const Flag& flag : flags) {
        if (!flag.excludes.empty()) {
            app.get_option(flag.name)->excludes(app.get_option(flag.excludes));
        }
    }
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

/// The names of a flag: "-q,--quiet" has two.
std::vector<std::string_view> names_of(const Flag& flag) {
    std::vector<std::string_view> names;
    for (std::string_view rest = flag.name; !rest.empty();) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        names.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return names;
}

/// "; did you mean '--paths'?", or nothing if no candidate is near.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
    const std::string_view near = quasimc::nearest_word(word, candidates);
    return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

/// What is wrong with words that no command or flag asked for: one line each.
std::string about_extras(
    const Program& program, const Command* command, const std::vector<std::string>& extras) {
    std::vector<std::string_view> flags{"--help"};
    for (const Flag& flag : command != nullptr ? command->flags : program.flags) {
        const bool is_shown = !flag.group || !flag.group->empty();
        for (const std::string_view name : names_of(flag)) {
            if (is_shown && name.starts_with("--")) {
                flags.push_back(name);
            }
        }
    }
    std::vector<std::string_view> commands;
    for (const Command& each : program.commands) {
        commands.push_back(each.name);
    }
    std::string flag_lines;
    std::string word_lines;
    for (const std::string& word : extras) {
        const std::string name = word.substr(0, word.find('='));
        if (word.size() > 1 && word.starts_with('-')) {
            flag_lines += fmt::format("{}: there is no such flag{}\n", name, nearest(name, flags));
        } else if (command == nullptr) {
            word_lines +=
                fmt::format("{}: there is no such command{}\n", word, nearest(word, commands));
        } else {
            word_lines += fmt::format("{}: is one argument too many\n", word);
        }
    }
    // A word beside an unknown flag was probably its value, and a command goes before its flags.
    const bool tells_words = command == nullptr ? !word_lines.empty() : flag_lines.empty();
    return tells_words ? word_lines.substr(0, word_lines.find('\n') + 1) : flag_lines;
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

/// What to tell of a wrong command line in better words than the parser's; "" if there are none.
std::string about(
    const CLI::ParseError& error,
    const Program& program,
    const std::vector<std::string>& words,
    const std::vector<std::string>& extras) {
    const Command* command = command_of(program, words);
    return dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr
               ? about_extras(program, command, extras)
               : "";
}

}  // namespace

Parsed parse_command_line(const Program& program, int argc, char** argv) {
    Parsed parsed;
    CLI::App app(program.summary);
    app.name(program.name);
    app.set_version_flag("--version", program.version);
    app.footer(program.footer);
    add_flags(app, program.flags);
    for (const Command& command : program.commands) {
        add_command(app, command, parsed);
    }
    app.require_subcommand(0, 1);
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (const Command* command = command_of(program, words)) {
        // The parser would take another flag for the value.
        const std::string flag = flag_without_value(*command, words);
        if (!flag.empty()) {
            std::cerr << flag << ": its value is missing\n" << kSeeHelp;
            parsed.exit = Exit::usage;
            return parsed;
        }
    }
    try {
        app.parse(argc, argv);
        parsed.help = app.help();
    } catch (const CLI::ParseError& error) {
        const bool is_help = error.get_exit_code() == 0;
        const std::string text = about(error, program, words, app.remaining(true));
        if (text.empty()) {
            app.exit(error, std::cout, std::cerr);
        } else {
            std::cerr << text << kSeeHelp;
        }
        parsed.exit = is_help ? Exit::done : Exit::usage;
    }
    return parsed;
}
