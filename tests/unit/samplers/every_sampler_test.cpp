// What the interface promises, for every sampler of the catalogue.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sampler_testing.h"
#include "samplers/hash.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

constexpr std::array<std::uint32_t, 8> kSomeDimensions{0, 1, 2, 5, 13, 63, 64, 200};

INSTANTIATE_TEST_SUITE_P(
    Catalogue, EverySampler, ::testing::ValuesIn(sampler_names()), [](const auto& param) {
        return param.param;
    });

TEST(Catalogue, KnowsItsSamplersByName) {
    for (const SamplerEntry& entry : sampler_catalogue())
        EXPECT_NE(make_sampler(entry.name), nullptr) << entry.name;
    EXPECT_EQ(make_sampler("no such sampler"), nullptr);
    EXPECT_EQ(make_sampler(""), nullptr);
}

TEST_P(EverySampler, GivesTheSameBitsInAnyOrder) {
    struct Draw {
        std::uint64_t point;
        std::uint32_t dimension;
        std::uint32_t replicate;
        double number;
    };
    std::vector<Draw> draws;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const std::uint64_t random = mix64(i);
        draws.push_back(
            {.point = random % 1024,
             .dimension = static_cast<std::uint32_t>(random >> 32) % 100,
             .replicate = static_cast<std::uint32_t>(random >> 60),
             .number = 0});
    }
    const auto coordinate = [&](const Sampler& sampler, const Draw& draw) {
        const Stream stream{.seed = 3, .sequence = 9, .replicate = draw.replicate, .count = 1024};
        return sampler.coordinate(stream, draw.point, draw.dimension);
    };
    for (Draw& draw : draws)
        draw.number = coordinate(sampler(), draw);
    std::sort(draws.begin(), draws.end(), [](const Draw& a, const Draw& b) {
        return a.number < b.number;
    });
    const auto another = make_sampler(GetParam());
    for (const Draw& draw : draws)
        ASSERT_EQ(coordinate(*another, draw), draw.number);
}

/// Expects numbers() to repeat number(), from `first` on.
void expect_same_bits(
    const Sampler& sampler,
    const Stream& stream,
    std::uint64_t first,
    std::uint32_t dimension,
    std::size_t length) {
    // A canary behind the end shows if too much is written.
    std::vector<double> many(length + 1, -1.0);
    sampler.coordinates(stream, first, dimension, std::span(many).first(length));
    for (std::size_t i = 0; i < length; ++i)
        ASSERT_EQ(many[i], sampler.coordinate(stream, first + i, dimension))
            << "point " << first << " + " << i << ", dimension " << dimension;
    ASSERT_EQ(many[length], -1.0);
}

TEST_P(EverySampler, FillsManyNumbersWithTheBitsOfOne) {
    const Stream stream{.seed = 8, .sequence = 2, .replicate = 1, .first = 4096, .count = 4096};
    for (const std::uint32_t dimension : kSomeDimensions)
        for (const std::uint64_t start : {0, 1, 5, 16, 31, 333})
            for (const std::size_t length : {0U, 1U, 2U, 7U, 15U, 16U, 17U, 33U, 100U, 1000U})
                expect_same_bits(sampler(), stream, stream.first + start, dimension, length);
}

TEST_P(EverySampler, FillsManyNumbersAcrossTheEndOfItsPeriod) {
    // Powers of 2, 3, 5 and the period of Faure's sequence among them. A lattice has no period,
    // but large rounds.
    for (const std::uint64_t end :
         {std::uint64_t{1} << 30, std::uint64_t{1} << 32, std::uint64_t{3486784401},
          std::uint64_t{244140625}, std::uint64_t{2357947691}, std::uint64_t{7} << 33})
        for (const std::uint32_t dimension : kSomeDimensions)
            expect_same_bits(sampler(), {.count = std::uint64_t{1} << 40}, end - 21, dimension, 50);
}

TEST_P(EverySampler, StaysInTheUnitInterval) {
    const Stream stream{.seed = 5, .count = 1U << 16};
    for (const std::uint32_t dimension : kSomeDimensions) {
        const auto x = coordinates(sampler(), stream, dimension);
        const auto [least, greatest] = std::minmax_element(x.begin(), x.end());
        EXPECT_GE(*least, 0);
        EXPECT_LT(*greatest, 1);
        EXPECT_LT(*least, 1e-3);
        EXPECT_GT(*greatest, 1 - 1e-3);
    }
}

TEST_P(EverySampler, ContinuesItsSequenceUnlessItNeedsWholeRounds) {
    const Stream whole{.seed = 4, .count = 2048};
    const Stream second{.seed = 4, .first = 1024, .count = 1024};
    int same = 0;
    for (std::uint64_t point = 1024; point < 2048; ++point)
        same +=
            sampler().coordinate(whole, point, 1) == sampler().coordinate(second, point, 1) ? 1 : 0;
    EXPECT_EQ(same, sampler().needs_power_of_two() ? 0 : 1024);
}

/// Number of (point, dimension) over many replicates.
std::vector<double> over_replicates(
    const Sampler& sampler,
    Stream stream,
    std::uint64_t point,
    std::uint32_t dimension,
    int count) {
    std::vector<double> x;
    for (int replicate = 0; replicate < count; ++replicate) {
        stream.replicate = static_cast<std::uint32_t>(replicate);
        x.push_back(sampler.coordinate(stream, point, dimension));
    }
    return x;
}

TEST_P(EverySampler, IsUniformOverReplicates) {
    constexpr int kReplicates = 1 << 14;
    constexpr std::array<std::uint64_t, 4> kPoints{0, 1, 77, 255};
    const double level = sidak_level(kLevel, 4 * kPoints.size() * kSomeDimensions.size());
    for (const std::uint32_t dimension : kSomeDimensions)
        for (const std::uint64_t point : kPoints) {
            SCOPED_TRACE(testing::Message() << "point " << point << ", dimension " << dimension);
            const Stream stream{.seed = 6, .sequence = 1, .count = 256};
            auto x = over_replicates(sampler(), stream, point, dimension, kReplicates);
            EXPECT_TRUE(equally_likely(counts(x, 128), level));
            EXPECT_TRUE(agrees(measured(x), 0.5, 0.016, level));
            // The bits that a 32-bit generator would lack.
            for (double& value : x)
                value = std::fmod(value * 0x1p33, 1.0);
            EXPECT_TRUE(equally_likely(counts(x, 64), level));
            for (double& value : x)
                value *= value;
            EXPECT_TRUE(agrees(measured(x), 1.0 / 3, 0.016, level));
        }
}

/// Whether pairs of numbers fill the square evenly.
::testing::AssertionResult independent(
    std::span<const double> x, std::span<const double> y, double level) {
    return equally_likely(counts(x, y, 12, 12), level);
}

TEST_P(EverySampler, ReplicatesSequencesSeedsAndDimensionsAreIndependent) {
    constexpr int kReplicates = 1 << 14;
    const double level = sidak_level(kLevel, 5 * kSomeDimensions.size());
    const Stream base{.seed = 1, .sequence = 0, .first = 0, .count = 256};
    Stream other_seed = base;
    other_seed.seed = 2;
    Stream other_sequence = base;
    other_sequence.sequence = 1;
    Stream other_round = base;
    other_round.first = 256;
    for (const std::uint32_t dimension : kSomeDimensions) {
        SCOPED_TRACE(testing::Message() << "dimension " << dimension);
        const auto draw = [&](const Stream& stream, std::uint64_t point, std::uint32_t at) {
            return over_replicates(sampler(), stream, point, at, kReplicates);
        };
        const auto x = draw(base, 9, dimension);
        EXPECT_TRUE(independent(std::span(x).first(x.size() - 1), std::span(x).subspan(1), level));
        EXPECT_TRUE(independent(x, draw(other_seed, 9, dimension), level));
        EXPECT_TRUE(independent(x, draw(other_sequence, 9, dimension), level));
        EXPECT_TRUE(independent(x, draw(base, 9, dimension + 1), level));
        if (sampler().needs_power_of_two()) {
            EXPECT_TRUE(independent(x, draw(other_round, 256 + 9, dimension), level));
        }
        // Negative control.
        EXPECT_FALSE(independent(x, draw(base, 9, dimension), level));
    }
}

TEST_P(EverySampler, DimensionsNeverCollide) {
    for (const std::uint64_t count : {1U << 7, 1U << 10, 1U << 16})
        EXPECT_TRUE(dimensions_differ(sampler(), {.seed = 11, .count = count}, 64, kLevel / 3));
}

TEST_P(EverySampler, LateDimensionsDifferFromEarlyOnes) {
    // Beyond their own tables samplers repeat earlier dimensions in another order or draw random
    // numbers.
    const Stream stream{.seed = 12, .count = 4096};
    const double level = sidak_level(kLevel, 8 * 64);
    for (std::uint32_t late = 64; late < 128; ++late) {
        const auto y = coordinates(sampler(), stream, late);
        for (std::uint32_t early = 0; early < 8; ++early)
            EXPECT_TRUE(independent(coordinates(sampler(), stream, early), y, level))
                << early << " and " << late;
    }
}

}  // namespace
}  // namespace quasimc::test
