#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/plants/child_program.h"
#include "coupling/vlab/comm_file.h"

namespace quasimc {

/// Time for the first sign of a started program, and for its end after the order to exit.
struct ProgramPatience {
    std::chrono::milliseconds start{30'000}, exit{10'000};
};

/// Command line of an environment program, without the switches of the transport.
struct ProgramCommand {
    std::vector<std::string> words;  ///< from the line "executable:"; not empty
    std::string comm_file;           ///< for -e
    ProgramPatience patience = {};

    /// All words. Switches follow the name of the program; -e is added unless the second word is
    /// -e.
    [[nodiscard]] std::vector<std::string> with(const std::vector<std::string>& switches) const;
};

/// The plant simulator's side of a connection to an environment program, which it starts.
class ProgramConnection {
  public:
    virtual ~ProgramConnection() = default;
    ProgramConnection(const ProgramConnection&) = delete;
    ProgramConnection& operator=(const ProgramConnection&) = delete;

    /// Sends a message, at most capacity() bytes long. @throws InputError  if the program has ended
    virtual void send(std::string_view message) = 0;
    /// The next line of a reply, without its end; valid until the next call. Waits without a limit.
    /// @throws InputError  if the program has ended, or the line is too long
    [[nodiscard]] virtual std::string_view receive_line() = 0;
    /// Requests the next chunk of a reply.
    virtual void request_chunk() = 0;
    /// Longest message, bytes.
    [[nodiscard]] virtual std::size_t capacity() const = 0;
    /// Default number of queries in a chunk.
    [[nodiscard]] virtual std::size_t default_chunk() const = 0;
    /// Sends the last message and waits for the end of the program, for at most the time for exits.
    /// @returns its ending; empty if it ended with status 0
    [[nodiscard]] std::string close(std::string_view last_message);

  protected:
    /// @param patience  of the command
    explicit ProgramConnection(const ProgramPatience& patience) : patience_(patience) {}

    /// Starts the program. @throws ProgramNotStarted
    /// @param in, out  as for ChildProgram
    void start(const std::vector<std::string>& words, int in, int out);
    /// Waits for the first sign.
    /// @param has_sign  called repeatedly; waits for at most a fraction of a second
    /// @throws ProgramNotStarted  if the program ends before, or the time is over
    void await_sign(const std::function<bool()>& has_sign);
    [[nodiscard]] bool has_ended() { return program_->has_ended(); }
    /// Waits a short time for a program that is about to end. @returns whether it has ended
    bool wait_for_end();
    /// Ends the program now if it still runs; before its connection is removed.
    void stop() { program_.reset(); }
    /// Throws the error of a program that has ended or closed its end of the connection.
    [[noreturn]] void fail_as_ended();
    /// Throws an error of the program.
    [[noreturn]] void fail(std::string problem, std::string why, std::string suggestion = {});

  private:
    /// Sends a last message. A program that is gone is no error.
    virtual void send_last(std::string_view message) = 0;

    ProgramPatience patience_;
    std::unique_ptr<ChildProgram> program_;
};

/// The name of an environment program in messages.
[[nodiscard]] std::string program_in_messages(std::string_view name);

/// Starts an environment program, and waits for its first sign.
/// @throws ProgramNotStarted
[[nodiscard]] std::unique_ptr<ProgramConnection> connect_program(
    Transport transport, const ProgramCommand& command);

/// The same by pipes.
[[nodiscard]] std::unique_ptr<ProgramConnection> connect_by_pipes(const ProgramCommand& command);
/// The same by TCP: the simulator listens on a port and the next one.
[[nodiscard]] std::unique_ptr<ProgramConnection> connect_by_sockets(const ProgramCommand& command);
/// The same by two files of the working folder and a pair of semaphores.
[[nodiscard]] std::unique_ptr<ProgramConnection> connect_by_files(const ProgramCommand& command);
/// The same by shared memory and a pair of semaphores.
[[nodiscard]] std::unique_ptr<ProgramConnection> connect_by_memory(const ProgramCommand& command);

}  // namespace quasimc
