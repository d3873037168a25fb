#pragma once

#include <string>

#include "coupling/protocol/byte_stream.h"

namespace quasimc {

/// Messages through a pair of file descriptors: pipes and sockets.
class DescriptorStream final : public ByteStream {
  public:
    /// Whether the destructor closes the descriptors.
    enum class Ownership { borrowed, owned };
    /// Longest line that is not truncated, bytes; the original program has 2048.
    static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
    /// Both descriptors may be the same.
    DescriptorStream(int in, int out, Ownership ownership)
        : in_(in), out_(out), ownership_(ownership) {}
    ~DescriptorStream() override;
    DescriptorStream(const DescriptorStream&) = delete;
    DescriptorStream& operator=(const DescriptorStream&) = delete;

    void announce() override;
    [[nodiscard]] RejectAction refuse() override;
    [[nodiscard]] std::string_view receive() override;
    void send(std::string_view message, Continuation continuation) override;
    void await_request() override {}
    void check() override;
    void send_last(std::string_view message) override;
    void close() noexcept override;
    [[nodiscard]] std::size_t capacity() const override;
    [[nodiscard]] std::size_t default_chunk() const override { return 100; }

  private:
    void write_all(std::string_view bytes);
    /// Reads the available bytes; returns false at the end of input.
    [[nodiscard]] bool read_some();
    /// Adds bytes to the buffer, at most the first kLongestLine of each line.
    void keep(std::string_view bytes);
    /// Terminates an unterminated last line "Control". @throws PeerDisconnected  if there is none
    void end_input();

    int in_, out_;
    Ownership ownership_;
    std::string buffer_, piece_;
    std::size_t line_size_ = 0;  // of the buffer's last line
    std::size_t taken_ = 0;      // bytes of the buffer that were given out
};

}  // namespace quasimc
