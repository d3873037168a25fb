#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "coupling/vlab/comm_file.h"

namespace quasimc {

/// The plant simulator is gone, or its end of the line: there is nobody to answer.
class PeerDisconnected : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// An empty answer: the simulator goes on with the next chunk, or with the values it has.
inline constexpr std::string_view kEmptyAnswer = "Control: 5\n";

/// Whether a message is the last of a reply.
enum class Continuation { done, more_follows };

/// Whether a simulator that was told that there will be no light goes on without us, or still asks
/// at every step and waits for an answer.
enum class RejectAction { it_goes_on, it_asks };

/// A line to the plant simulator: text goes both ways in messages that end with a "Control" line.
/// Functions throw PeerDisconnected when the other side is gone, unless they say otherwise.
class ByteStream {
  public:
    virtual ~ByteStream() = default;
    ByteStream() = default;
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;

    /// Sends the first sign to the simulator, or that there will be no light.
    virtual void announce() = 0;
    [[nodiscard]] virtual RejectAction refuse() = 0;
    /// The next message, whole; valid until the next call. Waits as long as it takes.
    /// @throws InputError  if what is there is no message
    [[nodiscard]] virtual std::string_view receive() = 0;
    /// Sends a message, which ends with a "Control" line and is at most capacity() bytes long.
    /// @throws InputError  if it can't be written
    virtual void send(std::string_view message, Continuation continuation) = 0;
    /// After a message that more follow: waits until the simulator takes the next one.
    virtual void await_request() = 0;
    /// Throws if the plant simulator is gone: for looking up now and then from a long computation.
    virtual void check() = 0;
    /// The answer to the order to exit, with the last sign where there is one, in one piece. A
    /// simulator that has closed the line meanwhile has all it wants: nothing is thrown for it.
    virtual void send_last(std::string_view message) {
        try {
            send(message, Continuation::done);
        } catch (const PeerDisconnected&) {
            return;  // it has said that it goes
        }
    }
    /// For an end that the simulator has not ordered: answers what it asks with nothing, and what
    /// it will ask as well where the line keeps that (semaphores). May be called from another
    /// thread while this one is in receive(), await_request() or check().
    virtual void resign() noexcept = 0;
    /// Longest message that can be sent, bytes.
    [[nodiscard]] virtual std::size_t capacity() const = 0;
    /// Queries or answers in a chunk, unless the environment file says otherwise.
    [[nodiscard]] virtual std::size_t default_chunk() const = 0;
};

/// Standard input and output. SIGPIPE must be ignored.
/// @param in, out  file descriptors, which stay open
[[nodiscard]] std::unique_ptr<ByteStream> make_pipe_stream(int in, int out);

/// TCP: connects to `port`, for what we send, and `port` + 1, for what we receive.
/// @throws InputError  if there is nobody
[[nodiscard]] std::unique_ptr<ByteStream> make_socket_stream(const std::string& host, int port);

/// Files .to_field<extension> and .from_field<extension> in the working folder, and the semaphores
/// of `key`.
/// @throws InputError  if there are no such semaphores
[[nodiscard]] std::unique_ptr<ByteStream> make_file_stream(long key, const std::string& extension);

/// Shared memory of `key` - 1, and the semaphores of `key`.
/// @throws InputError  if there are no such semaphores or memory
[[nodiscard]] std::unique_ptr<ByteStream> make_memory_stream(long key);

}  // namespace quasimc
