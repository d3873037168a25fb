#pragma once

#include <cstddef>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace quasimc {

/// Gives memory that was freed between what is still used back to the system; the standard library
/// keeps it. Takes milliseconds where many small things were freed.
/// @param organs  of the scene: of few it is not worth while
inline void give_back_free_memory([[maybe_unused]] std::size_t organs) {
#ifdef __GLIBC__
    constexpr std::size_t kMany = 1 << 16;  // some ten megabytes
    if (organs >= kMany) {
        malloc_trim(0);
    }
#endif
}

}  // namespace quasimc
