#include "statistical/bundle_checks.h"

#include <cmath>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "quasimc/source.h"
#include "statistical/scenes.h"

namespace quasimc::test {

RunSpec bundles(std::uint64_t paths) {
    return spec_of(Method::ray_bundles, paths);
}

void expect_same(const Scene& scene, const Result& own, const Result& plain, double resolution) {
    const Audit audit = compare_results(scene, own, plain);
    EXPECT_GE(audit.chance, kLevel);
    for (std::size_t band = 0; band < own.bands; ++band) {
        EXPECT_LT(audit.bands[band].standard_error, .01 * own.budget[band].emitted.mean);
        double mean = 0, square = 0;
        for (std::size_t organ = 0; organ < own.organs(); ++organ) {
            const Estimate& e = own.at(organ, Quantity::absorbed_flux, band);
            mean += e.mean / static_cast<double>(own.organs());
            square += e.standard_error * e.standard_error / static_cast<double>(own.organs());
        }
        EXPECT_LT(std::sqrt(square), resolution * mean);
    }
}

void expect_intervals_hold(const Scene& scene, std::uint64_t paths) {
    const Sources sources{sun(35, {1, 1}), sky({1, 1})};
    RunSpec truth_spec = spec_of(Method::first_hits, 1 << 18);
    truth_spec.seed = 12345;
    const Result truth = run(scene, sources, truth_spec);
    RunSpec trial = bundles(paths);
    trial.replicates = 8;
    constexpr std::uint64_t kSeeds = 100;
    for (std::size_t band = 0; band < 2; ++band) {
        int right = 0, all_right = 0;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
            trial.seed = seed;
            const Result result = run(scene, sources, trial);
            const auto holds = [](const Estimate& e, const Estimate& true_one) {
                return e.low <= true_one.mean && true_one.mean <= e.high ? 1 : 0;
            };
            for (std::size_t organ = 0; organ < result.organs(); ++organ) {
                right += holds(
                    result.at(organ, Quantity::absorbed_flux, band),
                    truth.at(organ, Quantity::absorbed_flux, band));
            }
            all_right += holds(
                result.budget[band].absorbed_by_organs, truth.budget[band].absorbed_by_organs);
        }
        const double organs = static_cast<double>(kSeeds * truth.organs());
        EXPECT_GT(right, .93 * organs) << "band " << band;
        constexpr double kTellTale = 1000;  // of fewer, all may hold
        EXPECT_TRUE(organs < kTellTale || right < .999 * organs) << "band " << band;
        EXPECT_GE(all_right, 87) << "band " << band;
        ::testing::Test::RecordProperty(
            "band " + std::to_string(band), std::to_string(right / organs));
    }
}

}  // namespace quasimc::test
