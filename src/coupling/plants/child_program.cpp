#include "coupling/plants/child_program.h"

#include <algorithm>
#include <csignal>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <fmt/format.h>
#include <sys/wait.h>

namespace quasimc {
namespace {

using std::chrono::milliseconds;

/// Standard streams and signals of a program to be started.
class SpawnSettings {
  public:
    SpawnSettings(int in, int out) {
        ::posix_spawn_file_actions_init(&streams_);
        ::posix_spawnattr_init(&attributes_);
        if (in >= 0) {
            ::posix_spawn_file_actions_adddup2(&streams_, in, STDIN_FILENO);
        } else {
            ::posix_spawn_file_actions_addopen(&streams_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        }
        ::posix_spawn_file_actions_adddup2(
            &streams_, out >= 0 ? out : STDERR_FILENO, STDOUT_FILENO);
        sigset_t none{}, defaults{};
        sigemptyset(&none);
        sigemptyset(&defaults);
        sigaddset(&defaults, SIGPIPE);
        ::posix_spawnattr_setsigmask(&attributes_, &none);
        ::posix_spawnattr_setsigdefault(&attributes_, &defaults);
        ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnSettings() {
        ::posix_spawn_file_actions_destroy(&streams_);
        ::posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    /// @returns 0 or the error number
    [[nodiscard]] int spawn(pid_t& pid, char* const* words) const {
        return ::posix_spawnp(&pid, words[0], &streams_, &attributes_, words, environ);
    }

  private:
    posix_spawn_file_actions_t streams_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& words, int in, int out)
    : name_(words.front()) {
    std::vector<std::string> copies = words;
    std::vector<char*> pointers;
    pointers.reserve(copies.size() + 1);
    for (std::string& copy : copies) {
        pointers.push_back(copy.data());
    }
    pointers.push_back(nullptr);
    const int error = SpawnSettings(in, out).spawn(pid_, pointers.data());
    if (error != 0) {
        throw ProgramNotStarted(std::generic_category().message(error));
    }
}

ChildProgram::~ChildProgram() {
    constexpr milliseconds kAfterRequest{2000};
    if (has_ended()) {
        return;
    }
    ::kill(pid_, SIGTERM);
    if (!wait(kAfterRequest)) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
}

bool ChildProgram::has_ended() {
    int status = 0;
    if (!status_ && ::waitpid(pid_, &status, WNOHANG) != 0) {
        status_ = status;  // 0 if this process does not learn it
    }
    return status_.has_value();
}

bool ChildProgram::wait(milliseconds limit) {
    constexpr milliseconds kPause{5};
    const auto until = std::chrono::steady_clock::now() + limit;
    while (!has_ended()) {
        if (std::chrono::steady_clock::now() >= until) {
            return false;
        }
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

bool ChildProgram::has_succeeded() {
    return has_ended() && *status_ == 0;
}

std::string ChildProgram::ending() {
    if (!has_ended()) {
        return "it still runs";
    }
    return WIFSIGNALED(*status_) ? fmt::format("it was ended by signal {}", WTERMSIG(*status_))
                                 : fmt::format("it ended with status {}", WEXITSTATUS(*status_));
}

}  // namespace quasimc
