#include "coupling/protocol/guarded_stream.h"

#include <chrono>
#include <utility>

namespace quasimc {

void GuardedStream::open(std::unique_ptr<ByteStream> line) {
    const std::lock_guard lock(sending_);
    line_ = std::move(line);
}

void GuardedStream::announce() {
    const std::lock_guard lock(sending_);
    line_->announce();
}

RejectAction GuardedStream::refuse() {
    const std::lock_guard lock(sending_);
    return line_->refuse();
}

void GuardedStream::send(std::string_view message, Continuation continuation) {
    const std::lock_guard lock(sending_);
    line_->send(message, continuation);
}

void GuardedStream::send_last(std::string_view message) {
    const std::lock_guard lock(sending_);
    line_->send_last(message);
}

void GuardedStream::resign() noexcept {
    const std::unique_lock lock(sending_, std::chrono::seconds(1));
    if (lock.owns_lock() && line_) {
        line_->resign();
    }
}

}  // namespace quasimc
