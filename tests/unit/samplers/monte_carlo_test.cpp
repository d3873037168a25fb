#include "samplers/monte_carlo.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "sampler_testing.h"

namespace quasimc::test {
namespace {

using Words = std::array<std::uint64_t, 2>;

TEST(Philox, GivesTheKnownAnswersOfItsAuthors) {
    // The lines "philox2x64 10" of the file kat_vectors of Random123, by Salmon et al.
    constexpr std::uint64_t kAllOnes = ~std::uint64_t{0};
    EXPECT_EQ(philox2x64({0, 0}, 0), (Words{0xca00a0459843d731U, 0x66c24222c9a845b5U}));
    EXPECT_EQ(
        philox2x64({kAllOnes, kAllOnes}, kAllOnes),
        (Words{0x65b021d60cd8310fU, 0x4d02f3222f86df20U}));
    EXPECT_EQ(
        philox2x64({0x243f6a8885a308d3U, 0x13198a2e03707344U}, 0xa4093822299f31d0U),
        (Words{0x0a5e742c2997341cU, 0xb0f883d38000de5dU}));
}

TEST(MonteCarlo, TakesPointsBeyond32Bits) {
    const auto sampler = make_monte_carlo();
    const Stream stream{.count = ~std::uint64_t{0}};
    const std::uint64_t far = std::uint64_t{1} << 40;
    EXPECT_NE(sampler->coordinate(stream, far, 0), sampler->coordinate(stream, 0, 0));
    EXPECT_NE(sampler->coordinate(stream, far, 0), sampler->coordinate(stream, far << 10, 0));
}

TEST(MonteCarlo, IsNotStratified) {
    // The negative control of the tests of elementary intervals.
    const auto x = coordinates(*make_monte_carlo(), {.count = 1024}, 0);
    EXPECT_FALSE(all_one(counts(x, 1024)));
}

}  // namespace
}  // namespace quasimc::test
