// QuasiMC, the environment process of cpfg and lpfg (docs/reference/environment.md). By the name
// MonteCarlo, a link to it, it reads the files of that program.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include <unistd.h>

#include <fmt/format.h>

#include "base/memory_need.h"
#include "coupling/environment.h"
#include "files/standard_streams.h"
#include "quasimc/run.h"
#include "quasimc/version.h"
#include "step_window.h"

namespace {

/// Exit statuses, as of the program quasimc; 128 + the number of a signal is also possible.
constexpr int kDone = 0;
constexpr int kInputError = 1;
constexpr int kUsage = 2;
constexpr int kInternalError = 3;

/// Marks every line: the simulator writes to the same log.
void send(std::string_view text) {
    std::string lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.append("QuasiMC: ").append(text.substr(0, end)).append("\n");
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    std::fputs(lines.c_str(), stderr);
}

/// Closes files inherited from the simulator. Its own end of the connection, if open here, would
/// hide the simulator's end.
void close_inherited() {
    ::close_range(STDERR_FILENO + 1, ~0U, 0);
}

int status_of(quasimc::SessionOutcome outcome) {
    switch (outcome) {
        case quasimc::SessionOutcome::good:
            return kDone;
        case quasimc::SessionOutcome::rejected:
            return kInputError;
        case quasimc::SessionOutcome::failed:
            break;
    }
    return kInternalError;
}

int run(int argc, char** argv) {
    const quasimc::Arguments arguments = quasimc::parse_arguments(
        {argv + 1, static_cast<std::size_t>(argc - 1)}, quasimc::kind_of_program(argv[0]));
    if (arguments.wants_help) {
        std::fputs(quasimc::usage_text().c_str(), stdout);
        return kDone;
    }
    if (arguments.wants_version) {
        std::printf("QuasiMC %s\n", std::string(quasimc::version()).c_str());
        return kDone;
    }
    if (arguments.specification.empty()) {
        throw quasimc::UsageError("the specification file is missing");
    }
    StepWindow window(send);
    return status_of(
        quasimc::run_environment(arguments, {STDIN_FILENO, STDOUT_FILENO}, send, &window));
}

}  // namespace

int main(int argc, char** argv) {
    quasimc::open_standard_streams();
    close_inherited();
    // A write to a simulator that has ended fails with an error instead of a signal.
    std::signal(SIGPIPE, SIG_IGN);
    try {
        return run(argc, argv);
    } catch (const quasimc::UsageError& error) {
        send(error.what());
        std::fputs(quasimc::usage_text().c_str(), stderr);
        quasimc::refuse_simulator({argv + 1, static_cast<std::size_t>(argc - 1)});
        return kUsage;
    } catch (const quasimc::PeerDisconnected& error) {
        send(error.what());
        return kInputError;
    } catch (const quasimc::InputError& error) {
        send(error.what());
        return kInputError;
    } catch (const quasimc::Stopped& stopped) {
        send(stopped.what());
        return kInputError;
    } catch (const quasimc::OutOfMemory& error) {
        send(error.what());
        return kInputError;
    } catch (const std::bad_alloc&) {
        send("there is not enough memory");
        return kInputError;
    } catch (const std::exception& error) {
        send(fmt::format(
            "internal error: {}\nThis is an error in the program; please report it.",
            error.what()));
        return kInternalError;
    }
}
