#pragma once

#include <cstddef>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace quasimc {

/// From how many organs on what is freed is worth to be given back: some ten megabytes.
inline constexpr std::size_t kOrgansWorthFreeing = 1 << 16;

/// Gives memory that was freed between what is still used back to the system; the standard library
/// keeps it. Takes milliseconds where many small things were freed.
inline void give_back_free_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

}  // namespace quasimc
