// The tables of flags as a parser of CLI11: the only file that includes it, for it takes seconds to
// compile.

#include <iostream>

#include <CLI/CLI.hpp>

#include "command_line.h"

namespace {

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
    try {
        app.parse(argc, argv);
        parsed.help = app.help();
    } catch (const CLI::ParseError& error) {
        const bool is_help = error.get_exit_code() == 0;
        app.exit(error, std::cout, std::cerr);
        parsed.exit = is_help ? Exit::done : Exit::usage;
    }
    return parsed;
}
