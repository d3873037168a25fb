#include "coupling/protocol/guarded_stream.h"

#include <chrono>
#include <utility>

namespace quasimc {

void GuardedStream::open(std::unique_ptr<ByteStream> connection) {
    const std::lock_guard lock(sending_);
    connection_ = std::move(connection);
}

void GuardedStream::announce() {
    const std::lock_guard lock(sending_);
    connection_->announce();
}

RejectAction GuardedStream::refuse() {
    const std::lock_guard lock(sending_);
    return connection_->refuse();
}

void GuardedStream::send(std::string_view message, Continuation continuation) {
    const std::lock_guard lock(sending_);
    connection_->send(message, continuation);
}

void GuardedStream::send_last(std::string_view message) {
    const std::lock_guard lock(sending_);
    connection_->send_last(message);
}

void GuardedStream::close() noexcept {
    const std::unique_lock lock(sending_, std::chrono::seconds(1));
    if (lock.owns_lock() && connection_) {
        connection_->close();
    }
}

}  // namespace quasimc
