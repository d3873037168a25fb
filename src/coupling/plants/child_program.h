#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/types.h>

namespace quasimc {

/// The environment program can't be started, or refuses its work.
class ProgramNotStarted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A program that runs beside this process.
class ChildProgram {
  public:
    /// Starts a program in the working folder, found as a shell finds it, with default signals.
    /// @param words  its name and arguments; not empty
    /// @param in, out  its standard input and output; -1: no input, and output to standard error
    /// @throws ProgramNotStarted
    ChildProgram(const std::vector<std::string>& words, int in, int out);
    /// Ends the program if it still runs: by SIGTERM, then by SIGKILL.
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool has_ended();
    /// Waits for the end. @returns false if it still runs after the time
    bool wait(std::chrono::milliseconds limit);
    /// Whether it has ended with status 0.
    [[nodiscard]] bool has_succeeded();
    /// Text about the end: "it ended with status 3".
    [[nodiscard]] std::string ending();

  private:
    std::string name_;
    pid_t pid_ = -1;
    std::optional<int> status_;  // of waitpid, after the end
};

}  // namespace quasimc
