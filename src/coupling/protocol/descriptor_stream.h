#pragma once

#include <string>

#include "coupling/protocol/byte_stream.h"

namespace quasimc {

/// Messages through a pair of file descriptors: pipes and sockets.
class DescriptorStream final : public ByteStream {
  public:
    /// What becomes of the descriptors at the end.
    enum class Ownership { borrowed, owned };
    /// Bytes of a line that are kept; the original keeps 2048.
    static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;
    /// May name one descriptor for both directions.
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
    void resign() noexcept override;
    [[nodiscard]] std::size_t capacity() const override;
    [[nodiscard]] std::size_t default_chunk() const override { return 100; }

  private:
    void write_all(std::string_view bytes);
    /// Reads what there is; false at the end of input.
    [[nodiscard]] bool read_some();
    /// Adds what was read to the buffer, of each line its first kLongestLine bytes.
    void keep(std::string_view bytes);
    /// Ends a last line "Control" that has no end. @throws PeerDisconnected  if there is none
    void end_input();

    int in_, out_;
    Ownership ownership_;
    std::string buffer_, piece_;
    std::size_t line_size_ = 0;  // of the buffer's last line
    std::size_t taken_ = 0;      // bytes of the buffer that were given out
};

}  // namespace quasimc
