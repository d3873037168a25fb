// Messages in a piece of shared memory, handed over with semaphores: first the simulator's, then
// ours. A message has no end but its "Control" line.

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <sys/ipc.h>
#include <sys/shm.h>

#include "base/checks.h"
#include "coupling/protocol/byte_stream.h"
#include "coupling/protocol/messages.h"
#include "coupling/protocol/semaphores.h"

namespace quasimc {
namespace {

constexpr std::size_t kToUs = 50000, kFromUs = 10000;
/// Bytes of our part that are left free, as the simulators do.
constexpr std::size_t kReserve = 25;

class SharedMemory {
  public:
    explicit SharedMemory(long key) {
        constexpr int kMode = 0600;
        errno = 0;
        id_ = ::shmget(static_cast<key_t>(key), kToUs + kFromUs, kMode);
        void* place = id_ < 0 ? nullptr : ::shmat(id_, nullptr, 0);
        if (errno != 0) {  // both set it when they fail, and only then
            throw InputError(
                {{fmt::format("-k {}", key + 1),
                  fmt::format("there is no shared memory of key {}", key),
                  std::generic_category().message(errno),
                  "do both programs read the same communication type in the environment file?"}});
        }
        bytes_ = static_cast<char*>(place);
    }
    ~SharedMemory() { ::shmdt(bytes_); }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    [[nodiscard]] std::string_view to_us() const { return {bytes_, kToUs}; }
    [[nodiscard]] char* from_us() const { return bytes_ + kToUs; }
    void remove() const { ::shmctl(id_, IPC_RMID, nullptr); }

  private:
    int id_ = -1;
    char* bytes_ = nullptr;
};

class MemoryStream final : public ByteStream {
  public:
    explicit MemoryStream(long key) : semaphores_(key), memory_(key - 1) {}
    ~MemoryStream() override {
        if (semaphores_.master_died()) {
            memory_.remove();
            semaphores_.remove();
        }
    }

    MemoryStream(const MemoryStream&) = delete;
    MemoryStream& operator=(const MemoryStream&) = delete;

    void announce() override {
        prepare_for_our_end();
        semaphores_.announce();
    }
    /// cpfg takes silence for a refusal, but then leaves its semaphores and memory behind.
    [[nodiscard]] AfterRefusal refuse() override {
        announce();
        return AfterRefusal::it_asks;
    }
    [[nodiscard]] std::string_view receive() override {
        semaphores_.wait_for_master();
        prepare_for_our_end();
        const std::size_t end = message_end(memory_.to_us());
        if (end == std::string_view::npos) {
            throw InputError(
                {{"shared memory", "the message breaks off", "it has no line 'Control'", ""}});
        }
        buffer_ = memory_.to_us().substr(0, end);
        return buffer_;
    }
    void send(std::string_view message, Continuation /*continuation*/) override {
        write(message);
        semaphores_.post_to_master();
    }
    void send_last(std::string_view message) override {
        write(message);
        semaphores_.post_last();
    }
    void await_request() override { semaphores_.wait_for_master(); }
    void check() override { semaphores_.check(); }
    void resign() noexcept override {
        prepare_for_our_end();
        semaphores_.post_forever();
    }
    [[nodiscard]] std::size_t capacity() const override { return kFromUs - kReserve; }
    [[nodiscard]] std::size_t default_chunk() const override { return kFromUs; }

  private:
    /// What the simulator reads if we come to an end before we have answered.
    void prepare_for_our_end() const noexcept {
        std::memcpy(memory_.from_us(), kEmptyAnswer.data(), kEmptyAnswer.size());
    }

    /// Writes the head last, so that at any time the memory begins with a message that is whole.
    void write(std::string_view message) const {
        const std::size_t head = kEmptyAnswer.size();
        EXPECT(message.size() >= head && message.size() <= kFromUs);
        std::memcpy(memory_.from_us() + head, message.data() + head, message.size() - head);
        std::atomic_signal_fence(std::memory_order_seq_cst);
        std::memcpy(memory_.from_us(), message.data(), head);
    }

    SemaphorePair semaphores_;
    SharedMemory memory_;
    std::string buffer_;
};

}  // namespace

std::unique_ptr<ByteStream> make_memory_stream(long key) {
    return std::make_unique<MemoryStream>(key);
}

}  // namespace quasimc
