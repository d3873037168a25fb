// QuasiMC, the environment process of cpfg and lpfg (docs/formats/environment.md).

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>

#include <unistd.h>

#include <fmt/format.h>

#include "coupling/environment.h"
#include "io/standard_streams.h"
#include "quasimc/version.h"

namespace {

/// Exit statuses, those of the program quasimc.
constexpr int kDone = 0;
constexpr int kInputError = 1;
constexpr int kUsage = 2;
constexpr int kInternalError = 3;

void tell(const std::string& text) {
    std::fprintf(stderr, "QuasiMC: %s\n", text.c_str());
}

int run(int argc, char** argv) {
    const quasimc::Arguments arguments =
        quasimc::parse_arguments({argv + 1, static_cast<std::size_t>(argc - 1)});
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
    // A simulator that is gone is noticed by the error of the write.
    std::signal(SIGPIPE, SIG_IGN);
    quasimc::run_environment(arguments, {STDIN_FILENO, STDOUT_FILENO}, tell);
    return kDone;
}

}  // namespace

int main(int argc, char** argv) {
    quasimc::open_standard_streams();
    try {
        return run(argc, argv);
    } catch (const quasimc::UsageError& error) {
        std::fprintf(stderr, "QuasiMC: %s\n%s", error.what(), quasimc::usage_text().c_str());
        return kUsage;
    } catch (const quasimc::PeerDisconnected& error) {
        tell(error.what());
        return kInputError;
    } catch (const quasimc::InputError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return kInputError;
    } catch (const std::bad_alloc&) {
        tell("there is not enough memory");
        return kInputError;
    } catch (const std::exception& error) {
        std::fprintf(
            stderr,
            "QuasiMC: internal error: %s\nThis is a fault of the program; please report it.\n",
            error.what());
        return kInternalError;
    }
}
