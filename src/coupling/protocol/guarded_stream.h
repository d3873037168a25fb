#pragma once

#include <memory>
#include <mutex>
#include <string_view>

#include "coupling/protocol/byte_stream.h"

namespace quasimc {

/// A connection that another thread may close at any time, after the message that is being sent.
/// Has no connection before open().
class GuardedStream final : public ByteStream {
  public:
    void open(std::unique_ptr<ByteStream> connection);
    [[nodiscard]] bool is_open() const { return connection_ != nullptr; }

    void announce() override;
    [[nodiscard]] RejectAction refuse() override;
    [[nodiscard]] std::string_view receive() override { return connection_->receive(); }
    void send(std::string_view message, Continuation continuation) override;
    void await_request() override { connection_->await_request(); }
    void check() override { connection_->check(); }
    void send_last(std::string_view message) override;
    /// Does nothing without a connection, or if the message being sent is not finished within a
    /// second because the simulator doesn't read.
    void close() noexcept override;
    [[nodiscard]] std::size_t capacity() const override { return connection_->capacity(); }
    [[nodiscard]] std::size_t default_chunk() const override {
        return connection_->default_chunk();
    }

  private:
    std::timed_mutex sending_;
    std::unique_ptr<ByteStream> connection_;
};

}  // namespace quasimc
