#include "at_once.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

#include <sys/prctl.h>
#include <sys/wait.h>

namespace quasimc::test {
namespace {

/// Longest wait of the case in this process.
double& longest_wait() {
    static double longest = 0;
    return longest;
}

/// The first child process; 0 if there is none.
pid_t first_child() {
    const std::string list = "/proc/self/task/" + std::to_string(::getpid()) + "/children";
    pid_t id = 0;
    std::ifstream(list) >> id;
    return id;
}

/// Kills remaining descendants; returns whether there were any that had not just ended.
bool has_left_processes() {
    bool has_left = false;
    while (true) {
        const pid_t ended = ::waitpid(-1, nullptr, WNOHANG);
        if (ended < 0) {
            return has_left;
        }
        if (ended == 0) {
            has_left = true;
            const pid_t child = first_child();
            ::kill(child, SIGKILL);
            ::waitpid(child, nullptr, 0);
        }
    }
}

/// Plays a case in this process; returns the reason of a failure, or "".
std::string outcome_of(const Case& one) {
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    std::string reason;
    try {
        one.play();
    } catch (const std::exception& error) {
        reason = error.what();
    }
    if (has_left_processes() && reason.empty()) {
        reason = "a process is left";
    }
    return reason;
}

/// Starts a case; returns the end of a pipe with its outcome.
int start(const Case& one) {
    std::array<int, 2> line{};
    if (::pipe2(line.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    const pid_t child = ::fork();
    if (child == 0) {
        const std::string outcome = outcome_of(one);
        const std::string text = std::to_string(longest_wait()) + " " + outcome;
        const bool is_told =
            ::write(line[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        ::_exit(is_told ? 0 : 1);
    }
    ::close(line[1]);
    return line[0];
}

std::string read_all(int from) {
    std::string text;
    std::array<char, 4096> piece{};
    while (true) {
        const ssize_t count = ::read(from, piece.data(), piece.size());
        if (count == 0 || (count < 0 && errno != EINTR)) {
            return text;
        }
        text.append(piece.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
}

/// Reads the outcome of a case.
void finish(const Case& one, int line, Played& played) {
    const std::string text = read_all(line);
    ::close(line);
    const std::size_t blank = text.find(' ');
    if (blank == std::string::npos) {
        played.failures.push_back(one.name + ": it ended without an outcome");
        return;
    }
    played.longest_seconds = std::max(played.longest_seconds, std::stod(text.substr(0, blank)));
    if (blank + 1 < text.size()) {
        played.failures.push_back(one.name + ": " + text.substr(blank + 1));
    }
}

}  // namespace

Played play_at_once(const std::vector<Case>& cases, unsigned most) {
    Played played;
    std::map<std::size_t, int> lines;  // of the cases under way
    std::size_t next = 0;
    while (next < cases.size() || !lines.empty()) {
        while (next < cases.size() && lines.size() < most) {
            lines[next] = start(cases[next]);
            ++next;
        }
        const auto [first, line] = *lines.begin();
        finish(cases[first], line, played);
        lines.erase(first);
        ::waitpid(-1, nullptr, 0);
    }
    return played;
}

void measure_wait(const std::function<void()>& wait) {
    const auto before = std::chrono::steady_clock::now();
    wait();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
    longest_wait() = std::max(longest_wait(), took.count());
}

void require(bool good, const std::string& reason) {
    if (!good) {
        throw std::runtime_error(reason);
    }
}

}  // namespace quasimc::test
