#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace quasimc {

/// Memory that processes of one machine have in common: bytes that several of them hold, such as
/// the corners of a scene that each has read, need to be there once.
class CommonMemory {
  public:
    CommonMemory() = default;
    virtual ~CommonMemory() = default;
    CommonMemory(const CommonMemory&) = delete;
    CommonMemory& operator=(const CommonMemory&) = delete;

    /// The same bytes in common memory, which nobody can change; null if they can't be there.
    /// @returns aligned to pages
    [[nodiscard]] virtual std::shared_ptr<const std::byte> keep(
        std::span<const std::byte> bytes) = 0;
};

}  // namespace quasimc
