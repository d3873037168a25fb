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
    target_missed = 4,  ///< or the paths that were asked for, for want of time
    interrupted = 130,  ///< by Ctrl-C, as a shell says it
    reader_gone = 141,  ///< from standard output, as a shell reports SIGPIPE
};

/// What a flag sets. Whoever owns it must outlive the parsing.
using FlagTarget = std::variant<
    bool*,
    int*,
    std::size_t*,
    double*,
    std::string*,
    std::optional<double>*,
    std::optional<std::string>*,
    std::vector<std::string>*>;  ///< of an argument: one or several

/// A flag or an argument of a command: one row of the command's table.
struct Flag {
    std::string name;  ///< "--csv", "-q,--quiet"; of an argument "FILE"
    FlagTarget target;
    std::string summary;
    bool required = false;
    std::string type_name = {};             ///< in the help: FILE; by default NAME, X, N or TEXT
    std::string excludes = {};              ///< the name of a flag that excludes it
    std::vector<std::string> choices = {};  ///< if there are any, it must be one of them
    std::optional<std::pair<double, double>> range = {};  ///< of a number, ends included
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

/// Thrown by Command::check: the command line asks for what can't be.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A command of the program, as "run" in `quasimc run FILE`.
struct Command {
    std::string name, summary;
    std::vector<Flag> flags;
    std::function<Exit()> run;         ///< what it does, once its flags are set
    std::function<void()> check = {};  ///< throws UsageError if flags don't go together
};

/// The program: flags of its own, and its commands.
struct Program {
    std::string name, version, summary, footer;
    std::vector<Flag> flags;
    std::vector<Command> commands;  ///< of them `help` needs no run: it is the flag --help
};

/// What a command line asks for.
struct Parsed {
    std::optional<Exit> exit;          ///< help, version or a usage error was printed: end so
    const Command* command = nullptr;  ///< the command, if one was named
    std::string help;                  ///< of the program
};

/// Sets what the flags name. Prints help and version to stdout, usage errors to stderr.
[[nodiscard]] Parsed parse_command_line(const Program& program, int argc, char** argv);
