#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "coupling/vlab/comm_file.h"

namespace quasimc {

/// The plant simulator has ended or closed its end of the connection.
class PeerDisconnected : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// An empty answer: the simulator goes on with the next chunk, or with the values it has.
inline constexpr std::string_view kEmptyAnswer = "Control: 5\n";

/// Whether a message is the last of a reply.
enum class Continuation { done, more_follows };

/// Whether a refused simulator continues alone, or still sends queries at every step and waits for
/// answers.
enum class RejectAction { continues, keeps_asking };

/// A connection to the plant simulator, for messages in both directions that end with a "Control"
/// line. Functions throw PeerDisconnected when the other side is gone, unless they say otherwise.
class ByteStream {
  public:
    virtual ~ByteStream() = default;
    ByteStream() = default;
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;

    /// Sends the first sign to the simulator.
    virtual void announce() = 0;
    [[nodiscard]] virtual RejectAction refuse() = 0;
    /// The next message, whole; valid until the next call. Waits without a limit.
    /// @throws InputError  if the data are no message
    [[nodiscard]] virtual std::string_view receive() = 0;
    /// Sends a message, which ends with a "Control" line and is at most capacity() bytes long.
    /// @throws InputError  if it can't be written
    virtual void send(std::string_view message, Continuation continuation) = 0;
    /// Waits until the simulator takes the next message of a reply.
    virtual void await_request() = 0;
    /// Throws if the plant simulator is gone; called repeatedly during a long computation.
    virtual void check() = 0;
    /// Sends the answer to the order to exit in one piece, with the last sign where there is one. A
    /// connection that the simulator has closed is no error.
    virtual void send_last(std::string_view message) {
        try {
            send(message, Continuation::done);
        } catch (const PeerDisconnected&) {
            return;  // the simulator has ordered the exit
        }
    }
    /// Ends the connection without an order of the simulator: sends an empty answer to the pending
    /// query, and by semaphores to all later ones. May be called from another thread during
    /// receive(), await_request() or check().
    virtual void close() noexcept = 0;
    /// Longest message that can be sent, bytes.
    [[nodiscard]] virtual std::size_t capacity() const = 0;
    /// Default number of queries or answers in a chunk.
    [[nodiscard]] virtual std::size_t default_chunk() const = 0;
};

/// Standard input and output. SIGPIPE must be ignored.
/// @param in, out  file descriptors, which stay open
[[nodiscard]] std::unique_ptr<ByteStream> make_pipe_stream(int in, int out);

/// TCP: connects to `port`, to send, and to `port` + 1, to receive.
/// @throws InputError  if nothing listens there
[[nodiscard]] std::unique_ptr<ByteStream> make_socket_stream(const std::string& host, int port);

/// Files .to_field<extension> and .from_field<extension> in the working folder, and the semaphores
/// of `key`.
/// @throws InputError  if there are no such semaphores
[[nodiscard]] std::unique_ptr<ByteStream> make_file_stream(long key, const std::string& extension);

/// Shared memory of `key` - 1, and the semaphores of `key`.
/// @throws InputError  if there are no such semaphores or memory
[[nodiscard]] std::unique_ptr<ByteStream> make_memory_stream(long key);

}  // namespace quasimc
