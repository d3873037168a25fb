#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "base/memory_need.h"
#include "commands.h"
#include "files/standard_streams.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "rank_team.h"

namespace {

int status_of(Exit exit) {
    return static_cast<int>(exit);
}

int internal_error(const char* what) {
    std::fprintf(
        stderr, "quasimc: internal error: %s\nThis is a fault of the program; please report it.\n",
        what);
    return status_of(Exit::internal_error);
}

Program make_program(bool& dump_default) {
    return {
        "quasimc",
        "quasimc " + std::string(quasimc::version()),
        "Light on virtual plants: what every organ absorbs, with standard errors",
        "Exit status: 0 done, 1 the input has faults, 2 wrong usage, 3 internal error,\n"
        "4 stopped before the target error or all paths were reached, 130 stopped by Ctrl-C (in "
        "both\n"
        "cases the results so far are written, if there are any), 141 the reader of standard "
        "output\n"
        "has ended, as head does.",
        {{"--dump-default", &dump_default,
          "print a run file with every option, its default and a comment"}},
        {run_command(), merge_command(), check_command(), info_command(), convert_command(),
         list_command(), show_command(), view_command(), report_command(), sky_command()}};
}

/// Ranks that MPI's launcher has started share the work of `run`. All else the first does alone.
bool is_left_to_the_first_rank(int argc, char** argv) {
    return RankTeam::is_another_rank() && (argc < 2 || std::string_view(argv[1]) != "run");
}

Exit run_program(int argc, char** argv) {
    if (is_left_to_the_first_rank(argc, argv)) {
        return Exit::done;
    }
    bool dump_default = false;
    const Program program = make_program(dump_default);
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

/// run_program(), after whose end no progress line is left on the terminal, even where it throws.
Exit run_program_to_its_end(int argc, char** argv) {
    try {
        return run_program(argc, argv);
    } catch (...) {
        end_progress_line();
        throw;
    }
}

/// Writes what is left for standard output.
/// @param exit  of the command. @returns the program's
Exit finish_output(Exit exit) {
    const bool is_whole = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (is_whole || !quasimc::has_standard_output()) {
        return exit;
    }
    if (quasimc::is_reader_gone()) {
        return exit == Exit::done ? Exit::reader_gone : exit;
    }
    std::fprintf(stderr, "standard output: can't be written\n");
    return Exit::input_error;
}

}  // namespace

int main(int argc, char** argv) {
    quasimc::open_standard_streams();
    // A reader that is gone and a file that grows too large are noticed by the error of the write.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return status_of(finish_output(run_program_to_its_end(argc, argv)));
    } catch (const quasimc::ReaderGone&) {
        return status_of(Exit::reader_gone);
    } catch (const quasimc::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return status_of(Exit::input_error);
    } catch (const quasimc::Stopped& stopped) {
        std::fprintf(stderr, "%s\nNothing was written.\n", stopped.what());
        return status_of(
            stopped.why() == quasimc::StopReason::interrupted ? Exit::interrupted
                                                              : Exit::target_missed);
    } catch (const quasimc::OutOfMemory& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return status_of(Exit::input_error);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "quasimc: there is not enough memory\n");
        return status_of(Exit::input_error);
    } catch (const std::exception& error) {
        return internal_error(error.what());
    }
}
