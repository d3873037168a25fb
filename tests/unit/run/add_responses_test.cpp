#include "series/basis/add_responses.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/vector_units.h"

namespace quasimc::test {
namespace {

/// A direct implementation of the contract.
void add_plainly(
    const std::vector<std::vector<float>>& from,
    const std::vector<double>& factors,
    std::vector<std::vector<double>>& to) {
    for (std::size_t s = 0; s < to.size(); ++s) {
        for (std::size_t i = 0; i < to[s].size(); ++i) {
            for (std::size_t k = 0; k < from.size(); k += 4) {
                const auto times = [&](std::size_t j) {
                    return factors[(k + j) * to.size() + s] * static_cast<double>(from[k + j][i]);
                };
                to[s][i] += (times(0) + times(1)) + (times(2) + times(3));
            }
        }
    }
}

/// One more value beyond `count`, which must not change.
void expect_the_same(std::size_t responses, std::size_t sums, std::size_t count) {
    std::mt19937_64 random(count);
    std::uniform_real_distribution<double> uniform;
    std::vector<std::vector<float>> from(responses, std::vector<float>(count));
    std::vector<const float*> from_data;
    for (std::vector<float>& response : from) {
        for (float& x : response) {
            x = static_cast<float>(uniform(random));
        }
        from_data.push_back(response.data());
    }
    std::vector<double> factors(responses * sums);
    for (double& x : factors) {
        x = uniform(random);
    }
    std::vector<std::vector<double>> expected(sums, std::vector<double>(count, .1));
    std::vector<std::vector<double>> to(sums, std::vector<double>(count + 1, .1));
    std::vector<double*> to_data;
    for (std::vector<double>& sum : to) {
        to_data.push_back(sum.data());
    }
    add_plainly(from, factors, expected);
    best_add_responses()(from_data.data(), factors.data(), responses, count, sums, to_data.data());
    for (std::size_t s = 0; s < sums; ++s) {
        expected[s].push_back(.1);
        EXPECT_EQ(to[s], expected[s]) << count << " numbers";
    }
}

TEST(AddResponses, AddsTheSameBitsWithEveryVectorUnit) {
    for_each_vector_unit([] {
        for (const std::size_t count : {1, 7, 8, 9, 250}) {
            expect_the_same(4, 4, count);
            expect_the_same(12, 8, count);
        }
    });
}

}  // namespace
}  // namespace quasimc::test
