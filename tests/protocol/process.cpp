#include "process.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <sys/syscall.h>
#include <sys/wait.h>

namespace quasimc::test {
namespace {

/// In the child: becomes the program.
[[noreturn]] void become(
    const std::string& program, std::vector<char*>& words, const char* folder, int in, int out) {
    const int nothing = ::open("/dev/null", O_RDWR);
    const bool in_folder = ::chdir(folder) == 0;
    const int err = ::open("err", O_WRONLY | O_CREAT | O_APPEND, 0600);
    const int own = out >= 0 ? out : ::open("out", O_WRONLY | O_CREAT | O_APPEND, 0600);
    ::dup2(in >= 0 ? in : nothing, STDIN_FILENO);
    ::dup2(own, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (in_folder) {
        ::execv(program.c_str(), words.data());
    }
    ::_exit(127);
}

/// Whether a process ends within kPatience.
bool await_end(pid_t pid) {
    const auto process = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
    pollfd end{process, POLLIN, 0};
    const auto limit = std::chrono::milliseconds(kPatience).count();
    const bool ended = process < 0 || ::poll(&end, 1, static_cast<int>(limit)) > 0;
    ::close(process);
    return ended;
}

}  // namespace

std::optional<Ending> wait_for(pid_t pid) {
    int status = 0;
    if (!await_end(pid) || ::waitpid(pid, &status, 0) != pid) {
        return std::nullopt;
    }
    return WIFSIGNALED(status) ? Ending{true, WTERMSIG(status)}
                               : Ending{false, WEXITSTATUS(status)};
}

Process::Process(
    const std::string& program,
    const std::vector<std::string>& arguments,
    const std::filesystem::path& folder,
    int in,
    int out) {
    std::vector<std::string> copies{program};
    copies.insert(copies.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& copy : copies) {
        words.push_back(copy.data());
    }
    words.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
        become(program, words, folder.c_str(), in, out);
    }
    if (pid_ < 0) {
        throw std::runtime_error("fork failed");
    }
}

Process::~Process() {
    if (!waited_) {
        kill();
        static_cast<void>(wait());
    }
}

bool Process::wait_for_end() const {
    return await_end(pid_);
}

bool Process::has_ended() const {
    siginfo_t ending{};
    const int options = WEXITED | WNOHANG | WNOWAIT;
    return ::waitid(P_PID, static_cast<id_t>(pid_), &ending, options) == 0 && ending.si_pid != 0;
}

void Process::kill() const {
    send(SIGKILL);
}

void Process::send(int signal) const {
    ::kill(pid_, signal);
}

std::optional<Ending> Process::wait() {
    waited_ = true;
    return wait_for(pid_);
}

}  // namespace quasimc::test
