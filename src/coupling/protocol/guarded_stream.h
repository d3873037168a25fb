#pragma once

#include <memory>
#include <mutex>
#include <string_view>

#include "coupling/protocol/byte_stream.h"

namespace quasimc {

/// A line from which another thread may resign at any time: what is being sent is sent whole first.
/// Has no line until it is given one.
class GuardedStream final : public ByteStream {
  public:
    void open(std::unique_ptr<ByteStream> line);
    [[nodiscard]] bool is_open() const { return line_ != nullptr; }

    void announce() override;
    [[nodiscard]] RejectAction refuse() override;
    [[nodiscard]] std::string_view receive() override { return line_->receive(); }
    void send(std::string_view message, Continuation continuation) override;
    void await_request() override { line_->await_request(); }
    void check() override { line_->check(); }
    void send_last(std::string_view message) override;
    /// Does nothing without a line, and if a message can't be sent to its end within a second
    /// because the simulator doesn't read.
    void resign() noexcept override;
    [[nodiscard]] std::size_t capacity() const override { return line_->capacity(); }
    [[nodiscard]] std::size_t default_chunk() const override { return line_->default_chunk(); }

  private:
    std::timed_mutex sending_;
    std::unique_ptr<ByteStream> line_;
};

}  // namespace quasimc
