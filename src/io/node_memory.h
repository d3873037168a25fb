#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "base/common_memory.h"

namespace quasimc {

struct NodeArrays;

/// Common memory of processes that are started together. An array lies in memory of a file without
/// a name (memfd_create), which whoever holds the bytes first makes and seals; the others find it
/// in a list that all share, compare it byte by byte, and map it. It is gone when the last of them
/// has given it up, or has died, in whatever way.
class NodeMemory final : public CommonMemory {
  public:
    /// What the list takes, in memory that is all zero at first and aligned to 64 bytes.
    [[nodiscard]] static std::size_t bytes_of_list();
    /// Makes the list. One process does, before the others use it.
    static void make_list(void* list);

    /// @param list  made, shared by the processes, there until this object is gone
    explicit NodeMemory(void* list);
    ~NodeMemory() override { close(); }
    NodeMemory(const NodeMemory&) = delete;
    NodeMemory& operator=(const NodeMemory&) = delete;
    /// The list goes. What was kept stays, and nothing more is kept. No thread is in keep().
    void close();

    /// Null where the list is full, or the system gives no such memory, or not that of another. Nor
    /// are there more arrays of one process than a quarter of the files that it may open: each
    /// takes one.
    /// May be called by several threads.
    [[nodiscard]] std::shared_ptr<const std::byte> keep(std::span<const std::byte> bytes) override;

    /// Bytes that this process has put there for all, and that it took from others.
    [[nodiscard]] std::size_t bytes_given() const { return given_; }
    [[nodiscard]] std::size_t bytes_taken() const { return taken_; }

  private:
    std::shared_ptr<NodeArrays> arrays_;
    std::atomic<std::size_t> given_ = 0, taken_ = 0;
};

}  // namespace quasimc
