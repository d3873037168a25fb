#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__

#include <sys/mman.h>
#endif

namespace quasimc {

/// Returns free memory to the system, which the standard library retains between used blocks. Takes
/// milliseconds where many small blocks were freed.
/// @param organs  of the scene: with few it is not worthwhile
inline void give_back_free_memory([[maybe_unused]] std::size_t organs) {
#ifdef __GLIBC__
    constexpr std::size_t kMany = 1 << 16;  // some ten megabytes
    if (organs >= kMany) {
        malloc_trim(0);
    }
#endif
}

/// Sets numbers to 0. Whole pages are returned to the system, which provides zeros on the next
/// access.
/// @param numbers  private memory, as from the standard library
inline void clear_pages(std::span<std::int64_t> numbers) {
    std::int64_t* begin = numbers.data();
    std::int64_t* end = begin + numbers.size();
#ifdef __linux__
    constexpr std::uintptr_t kPage = 1 << 16;  // a multiple of the size of a page
    const auto up = [](std::uintptr_t address) { return (address + kPage - 1) / kPage * kPage; };
    const auto from = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = up(from);
    const std::uintptr_t last = reinterpret_cast<std::uintptr_t>(end) / kPage * kPage;
    if (first < last) {
        std::int64_t* const pages = begin + (first - from) / sizeof(std::int64_t);
        if (madvise(pages, last - first, MADV_DONTNEED) == 0) {
            std::fill(begin, pages, 0);
            begin = pages + (last - first) / sizeof(std::int64_t);
        }
    }
#endif
    std::fill(begin, end, 0);
}

}  // namespace quasimc
