#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "coupling/comm_file.h"

namespace quasimc {

/// The plant simulator is gone, or its end of the line: there is nobody to answer.
class PeerDisconnected : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Whether a message is the last of a reply.
enum class Continuation { done, more_follows };

/// A line to the plant simulator: text goes both ways in messages that end with a "Control" line.
/// Every function throws PeerDisconnected when the other side is gone.
class ByteStream {
  public:
    virtual ~ByteStream() = default;
    ByteStream() = default;
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;

    /// The next message, whole; valid until the next call. Waits as long as it takes.
    [[nodiscard]] virtual std::string_view receive() = 0;
    /// Sends a message, which ends with a "Control" line and is at most capacity() bytes long.
    virtual void send(std::string_view message, Continuation continuation) = 0;
    /// Throws if the plant simulator is gone: for looking up now and then from a long computation.
    virtual void check() = 0;
    /// The last sign, after the answer to the order to exit.
    virtual void finish() = 0;
    /// Longest message that can be sent, bytes.
    [[nodiscard]] virtual std::size_t capacity() const = 0;
    /// Queries or answers in a chunk, unless the environment file says otherwise.
    [[nodiscard]] virtual std::size_t default_chunk() const = 0;
};

/// Standard input and output. Tells the simulator at once that we are there.
/// SIGPIPE must be ignored. @param in, out  file descriptors, which stay open
[[nodiscard]] std::unique_ptr<ByteStream> make_pipe_stream(int in, int out);

/// TCP: connects to `port`, for what we send, and `port` + 1, for what we receive.
/// @throws InputError  if there is nobody
[[nodiscard]] std::unique_ptr<ByteStream> make_socket_stream(const std::string& host, int port);

/// Files .to_field<extension> and .from_field<extension> in the working folder, and the semaphores
/// of `key`. Tells the simulator at once that we are there.
/// @throws InputError  if there are no such semaphores
[[nodiscard]] std::unique_ptr<ByteStream> make_file_stream(long key, const std::string& extension);

/// Shared memory of `key` - 1, and the semaphores of `key`.
/// @throws InputError  if there are no such semaphores or memory
[[nodiscard]] std::unique_ptr<ByteStream> make_memory_stream(long key);

}  // namespace quasimc
