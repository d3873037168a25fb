#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace quasimc::test {

/// Time limit of waits, enough for a loaded machine.
inline constexpr std::chrono::seconds kPatience{60};

/// How a process ended.
struct Ending {
    bool by_signal = false;
    int status = 0;  ///< or the signal
    friend bool operator==(const Ending&, const Ending&) = default;
};

/// A child process that runs in a folder. The destructor kills it.
class Process {
  public:
    /// @param in, out  its standard input and output; -1: no input, and the file "out" Standard
    /// error goes to the file "err" of the folder.
    Process(
        const std::string& program,
        const std::vector<std::string>& arguments,
        const std::filesystem::path& folder,
        int in = -1,
        int out = -1);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    [[nodiscard]] pid_t pid() const { return pid_; }
    /// Waits for its end; empty if it does not end.
    [[nodiscard]] std::optional<Ending> wait();
    /// Waits for its end, which wait() still returns; false if it does not end.
    [[nodiscard]] bool wait_for_end() const;
    [[nodiscard]] bool has_ended() const;
    void kill() const;
    void send(int signal) const;

  private:
    pid_t pid_ = -1;
    bool waited_ = false;
};

/// Waits for the end of a child.
[[nodiscard]] std::optional<Ending> wait_for(pid_t pid);

}  // namespace quasimc::test
