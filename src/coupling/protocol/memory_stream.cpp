// Messages in a piece of shared memory, handed over with semaphores: first the simulator's part,
// then the answers. Only its "Control" line ends a message.

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <sys/ipc.h>
#include <sys/shm.h>

#include "base/checks.h"
#include "coupling/protocol/byte_stream.h"
#include "coupling/protocol/semaphore_stream.h"

namespace quasimc {
namespace {

constexpr std::size_t kToUs = 50000, kFromUs = 10000;
/// Bytes at the end of the part for answers that stay free, as in the simulators.
constexpr std::size_t kReserve = 25;

class SharedMemory {
  public:
    static constexpr std::size_t kCapacity = kFromUs - kReserve;
    static constexpr std::size_t kDefaultChunk = kFromUs;

    explicit SharedMemory(long key) {
        constexpr int kMode = 0600;
        errno = 0;
        id_ = ::shmget(static_cast<key_t>(key), kToUs + kFromUs, kMode);
        void* memory = id_ < 0 ? nullptr : ::shmat(id_, nullptr, 0);
        if (errno != 0) {  // both set it when they fail, and only then
            throw InputError(
                {{fmt::format("-k {}", key + 1),
                  fmt::format("there is no shared memory with key {}", key),
                  std::generic_category().message(errno),
                  "check that both programs read the same communication type in the environment "
                  "file"}});
        }
        bytes_ = static_cast<char*>(memory);
    }
    ~SharedMemory() { ::shmdt(bytes_); }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    [[nodiscard]] std::string name() const { return "shared memory"; }
    void remove() const { ::shmctl(id_, IPC_RMID, nullptr); }
    void read(std::string& text) const { text.assign(bytes_, kToUs); }
    /// Writes an empty answer, which the simulator reads if this process ends before it answers.
    void prepare_for_our_end() const noexcept {
        std::memcpy(from_us(), kEmptyAnswer.data(), kEmptyAnswer.size());
    }

    /// Writes the head last, so that at any time the memory begins with a message that is whole.
    void write(std::string_view message) const {
        const std::size_t head = kEmptyAnswer.size();
        EXPECT(message.size() >= head && message.size() <= kFromUs);
        std::memcpy(from_us() + head, message.data() + head, message.size() - head);
        std::atomic_signal_fence(std::memory_order_seq_cst);
        std::memcpy(from_us(), message.data(), head);
    }

  private:
    [[nodiscard]] char* from_us() const { return bytes_ + kToUs; }

    int id_ = -1;
    char* bytes_ = nullptr;
};

}  // namespace

std::unique_ptr<ByteStream> make_memory_stream(long key) {
    return std::make_unique<SemaphoreStream<SharedMemory>>(key, key - 1);
}

}  // namespace quasimc
