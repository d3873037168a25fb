// Compiled once for each vector unit: foreach_target.h includes this file repeatedly. The loops are
// left to the compiler's vectorizer.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samplers/vector_loops.cpp"
#include "samplers/vector_loops.h"

#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quasimc {
namespace HWY_NAMESPACE {
namespace {

void scramble_block(std::uint32_t base, const std::uint32_t* lowest, ScrambleKey key, double* out) {
    for (int i = 0; i < kSobolBlock; ++i) {
        const std::uint32_t first = reverse_bits(scrambled(base ^ lowest[i], key));
        out[i] = unit_number(first, more_bits(first, key) >> 11);
    }
}

void fill_lattice(std::uint64_t position, std::uint64_t step, double* out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t x = position + i * step;
        out[i] =
            unit_number(static_cast<std::uint32_t>(x >> 32), static_cast<std::uint32_t>(x) >> 11);
    }
}

VectorLoops variant_of_loops() {
    return {&scramble_block, &fill_lattice};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace quasimc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quasimc {

HWY_EXPORT(variant_of_loops);

VectorLoops best_vector_loops() {
    return HWY_DYNAMIC_DISPATCH(variant_of_loops)();
}

}  // namespace quasimc
#endif
