#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace quasimc::test {

/// Long enough for a loaded machine; nothing waits so long unless something is wrong.
inline constexpr std::chrono::seconds kPatience{60};

/// How a process ended.
struct Ending {
    bool by_signal = false;
    int status = 0;  ///< or the signal
    friend bool operator==(const Ending&, const Ending&) = default;
};

/// A program that runs in a folder beside us. Killed at the end of the object's life.
class Process {
  public:
    /// @param in, out  its standard input and output; -1: nothing, and the file "out"
    /// Standard error goes to the file "err" of the folder.
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
    /// Waits for its end; nothing if it doesn't come.
    [[nodiscard]] std::optional<Ending> wait();
    /// Waits for its end, which wait() still tells; false if it doesn't come.
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
