#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "base/memory_need.h"
#include "commands.h"
#include "completion.h"
#include "files/standard_streams.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "rank_team.h"
#include "terminal.h"

namespace {

int status_of(Exit exit) {
    return static_cast<int>(exit);
}

/// Errors in the command line are wrong usage: they begin with the name of a flag or of the
/// argument OUTPUT.
Exit exit_of(const quasimc::InputError& error) {
    const auto& faults = error.faults();
    const bool is_usage = std::all_of(faults.begin(), faults.end(), [](const auto& fault) {
        return fault.where.starts_with("--") || fault.where == "-o" || fault.where == "OUTPUT";
    });
    return is_usage ? Exit::usage : Exit::input_error;
}

int internal_error(const char* what) {
    std::fprintf(
        stderr, "quasimc: internal error: %s\nThis is a fault of the program; please report it.\n",
        what);
    return status_of(Exit::internal_error);
}

/// The entry of `help` in lists; the parser handles it as the flag --help.
Command help_command() {
    const auto name = std::make_shared<std::string>();
    return {
        "help",
        "print the help of the program or of a command",
        {{"COMMAND", name.get(), "name of a command"}},
        [name] { return Exit::done; }};
}

Command version_command() {
    return {"version", "print the version", {}, [] {
                std::printf("quasimc %s\n", std::string(quasimc::version()).c_str());
                return Exit::done;
            }};
}

Program make_program(bool& dump_default) {
    return {
        "quasimc",
        "quasimc " + std::string(quasimc::version()),
        "Computes the light that every organ of virtual plants absorbs, with standard errors.",
        "Exit status: 0 done; 1 errors in the input, or an output can't be written; 2 wrong usage; "
        "3 internal error; 4 stopped before the target error or all paths were reached; 130 "
        "stopped "
        "by Ctrl-C; 141 standard output was closed by its reader. With 4 and 130 the results so "
        "far "
        "are written.",
        {{"--dump-default", &dump_default,
          "print a run file with every key, its default and a comment"}},
        {run_command(), merge_command(), check_command(), info_command(), convert_command(),
         list_command(), show_command(), view_command(), report_command(), sky_command(),
         gaps_command(), grow_command(), help_command(), version_command()}};
}

/// Whether this rank has nothing to do: only the work of `run` is shared between ranks.
bool is_left_to_the_first_rank(int argc, char** argv) {
    return RankTeam::is_another_rank() && (argc < 2 || std::string_view(argv[1]) != "run");
}

Exit run_program(int argc, char** argv) {
    if (is_left_to_the_first_rank(argc, argv)) {
        return Exit::done;
    }
    bool dump_default = false;
    Program program = make_program(dump_default);
    program.commands.push_back(completion_command(program));
    const Parsed parsed = parse_command_line(program, argc, argv);
    if (parsed.exit) {
        return *parsed.exit;
    }
    if (dump_default) {
        std::fputs(quasimc::default_run_file().c_str(), stdout);
        return Exit::done;
    }
    if (parsed.command == nullptr) {
        std::fputs(parsed.help.c_str(), stderr);
        return Exit::usage;
    }
    return parsed.command->run();
}

/// run_program(), which also wipes the progress line if it throws.
Exit run_program_to_its_end(int argc, char** argv) {
    try {
        return run_program(argc, argv);
    } catch (...) {
        end_progress_line();
        throw;
    }
}

/// Flushes standard output.
/// @param exit  exit status of the command. @returns that of the program
Exit finish_output(Exit exit) {
    const bool is_whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (is_whole || !quasimc::has_standard_output()) {
        return exit;
    }
    if (quasimc::is_reader_gone()) {
        return exit == Exit::done ? Exit::reader_gone : exit;
    }
    print_error("standard output: can't be written");
    return Exit::input_error;
}

}  // namespace

int main(int argc, char** argv) {
    quasimc::open_standard_streams();
    // Closed pipes and files that grow too large are reported by the failing write.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return status_of(finish_output(run_program_to_its_end(argc, argv)));
    } catch (const quasimc::ReaderGone&) {
        return status_of(Exit::reader_gone);
    } catch (const quasimc::InputError& error) {
        print_errors(error);
        return status_of(exit_of(error));
    } catch (const quasimc::Stopped& stopped) {
        std::fprintf(stderr, "%s\nNothing was written.\n", stopped.what());
        return status_of(
            stopped.why() == quasimc::StopReason::interrupted ? Exit::interrupted
                                                              : Exit::target_missed);
    } catch (const quasimc::OutOfMemory& error) {
        print_error(error.what());
        return status_of(Exit::input_error);
    } catch (const std::bad_alloc&) {
        print_error("there is not enough memory");
        return status_of(Exit::input_error);
    } catch (const std::exception& error) {
        return internal_error(error.what());
    }
}
