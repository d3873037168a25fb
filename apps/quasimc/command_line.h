#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// Exit statuses of the program.
enum class Exit {
    done = 0,
    input_error = 1,
    usage = 2,
    internal_error = 3,
    target_missed = 4,  ///< or stopped by the time limit
    interrupted = 130,  ///< by Ctrl-C, as shells report SIGINT
    reader_gone = 141,  ///< standard output was closed, as shells report SIGPIPE
};

/// The variable that a flag sets. It must outlive the parsing.
using FlagTarget = std::variant<
    bool*,
    int*,
    std::size_t*,
    double*,
    std::string*,
    std::optional<double>*,
    std::optional<std::string>*,
    std::vector<std::string>*>;  ///< for an argument: one or several

/// A flag or an argument of a command: one row of the command's table.
struct Flag {
    std::string name;  ///< "--csv", "-q,--quiet"; of an argument "FILE"
    FlagTarget target;
    std::string summary;
    bool required = false;
    std::string type_name = {};             ///< in the help: FILE; by default NAME, X, N or TEXT
    std::string excludes = {};              ///< the name of a flag that excludes it
    std::vector<std::string> choices = {};  ///< valid values; empty: any
    std::optional<std::pair<double, double>> range = {};  ///< range of a number, ends included
    std::string group = "Options";                        ///< heading in the help
    std::string default_text = {};                        ///< shown in the help
    std::string takes = {};  ///< shown in the help; by default from choices, range and target
};

/// The names of a flag: "-q,--quiet" has two.
[[nodiscard]] std::vector<std::string_view> names_of(const Flag& flag);

/// Whether it is an argument, not a flag.
[[nodiscard]] inline bool is_argument(const Flag& flag) {
    return !flag.name.starts_with('-');
}

/// Thrown by Command::check for contradictory flags.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A flag by the name that another program has for it: a long name after one dash.
struct OldFlag {
    std::string_view old;   ///< "-str"
    std::string_view flag;  ///< "--string"
};

/// A command of the program, as "run" in `quasimc run FILE`.
struct Command {
    std::string name, summary;
    std::vector<Flag> flags;
    std::function<Exit()> run;            ///< called after its flags are set
    std::function<void()> check = {};     ///< throws UsageError for contradictory flags
    std::vector<OldFlag> old_flags = {};  ///< replaced before the parsing
};

/// The program: flags of its own, and its commands.
struct Program {
    std::string name, version, summary, footer;
    std::vector<Flag> flags;
    std::vector<Command> commands;  ///< `help` has no run: it is the flag --help
};

/// A parsed command line.
struct Parsed {
    std::optional<Exit> exit;          ///< set if help, version or a usage error was printed
    const Command* command = nullptr;  ///< the command, if one was named
    std::string help;                  ///< help of the program
};

/// Sets the targets of flags. Prints help and version to stdout, usage errors to stderr.
[[nodiscard]] Parsed parse_command_line(const Program& program, int argc, char** argv);
