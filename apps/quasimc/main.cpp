#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "quasimc/quasimc.h"

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

void describe(CLI::App& program) {
    program.name("quasimc");
    program.set_version_flag("--version", "quasimc " + std::string(quasimc::version()));
    program.footer(
        "Exit status: 0 done, 1 the input has faults, 2 wrong usage, 3 internal error,\n"
        "4 stopped before the target error was reached (the results are written all the same).");
}

int run_program(int argc, char** argv) {
    CLI::App program("Light on virtual plants: what every organ absorbs, with standard errors");
    describe(program);
    Action action;
    bool dump_default = false;
    program.add_flag(
        "--dump-default", dump_default,
        "print a run file with every option, its default and a comment");
    add_run_command(program, action);
    add_check_command(program, action);
    add_export_command(program, action);
    add_list_command(program, action);
    add_sky_command(program, action);
    program.require_subcommand(0, 1);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool is_help = error.get_exit_code() == 0;
        program.exit(error, std::cout, std::cerr);
        return status_of(is_help ? Exit::done : Exit::usage);
    }
    if (dump_default) {
        std::cout << quasimc::default_run_file();
        return status_of(Exit::done);
    }
    if (!action) {
        std::cerr << program.help();
        return status_of(Exit::usage);
    }
    return status_of(action());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int status = run_program(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            std::fprintf(stderr, "standard output: can't be written\n");
            return status_of(Exit::input_error);
        }
        return status;
    } catch (const quasimc::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return status_of(Exit::input_error);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "quasimc: not enough memory\n");
        return status_of(Exit::internal_error);
    } catch (const std::exception& error) {
        return internal_error(error.what());
    }
}
