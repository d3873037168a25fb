// Large arrays on large pages. Each page of 4 KB that a program touches first costs a fault, and
// each look-up beyond those the processor remembers a walk through tables; a scene of a million
// triangles pays a third of its processor time for that. So memory of some megabytes from `new` is
// offered to the system for pages of 2 MB (Linux: "transparent huge pages", asked for by madvise
// where the system does not give them by itself). It is an offer: what is there stays as it is
// where the system has none.
//
// This is the program's choice, not the library's: who embeds the library keeps his own `new`.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace {

constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
constexpr std::size_t kLarge = 2 * kHugePage;  // at least one whole page lies in it

void offer_huge_pages(void* memory, std::size_t size) {
    const auto block = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (block + kHugePage - 1) / kHugePage * kHugePage;
    const std::uintptr_t end = (block + size) / kHugePage * kHugePage;
    char* const first_page = static_cast<char*>(memory) + (begin - block);
    // A refusal changes nothing but speed.
    static_cast<void>(madvise(first_page, end - begin, MADV_HUGEPAGE));
}

/// Asks `allocate` for memory until it has some or nobody can free any.
template <typename Allocate>
void* new_memory(std::size_t size, const Allocate& allocate) {
    for (;;) {
        if (void* memory = allocate()) {
            if (size >= kLarge) {
                offer_huge_pages(memory, size);
            }
            return memory;
        }
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) {
            throw std::bad_alloc();
        }
        handler();
    }
}

}  // namespace

void* operator new(std::size_t size) {
    return new_memory(size, [=] { return std::malloc(size > 0 ? size : 1); });
}

void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto step = static_cast<std::size_t>(alignment);
    const std::size_t whole = (size + step - 1) / step * step;
    return new_memory(size, [=] { return std::aligned_alloc(step, whole > 0 ? whole : step); });
}

// Not inlined: GCC would see `free` of what `new` returned, and warn that the two do not belong
// together.
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}

[[gnu::noinline]] void operator delete(
    void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}
