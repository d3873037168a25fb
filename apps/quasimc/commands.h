#pragma once

#include <functional>
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): theirs
class App;
}

/// Exit statuses of the program.
enum class Exit { done = 0, input_error = 1, usage = 2, internal_error = 3, target_missed = 4 };

/// What the chosen subcommand does, set when the command line is parsed.
using Action = std::function<Exit()>;

// Each adds one subcommand to the program; when it is chosen, `action` becomes what it does.
void add_run_command(CLI::App& program, Action& action);
void add_check_command(CLI::App& program, Action& action);
void add_export_command(CLI::App& program, Action& action);
void add_list_command(CLI::App& program, Action& action);
void add_sky_command(CLI::App& program, Action& action);
