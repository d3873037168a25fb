#include "statistical/bundle_checks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "quasimc/source.h"
#include "statistical/scenes.h"

namespace quasimc::test {

RunSpec bundles(std::uint64_t paths) {
    return spec_of(Method::ray_bundles, paths);
}

void expect_same(const Scene& scene, const Result& own, const Result& plain, double resolution) {
    const Audit audit = compare_results(scene, own, plain);
    EXPECT_GE(audit.p_value, kLevel);
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

namespace {

/// Number of intervals that contain the truth, and of all.
struct Held {
    int held = 0, all = 0;

    /// @param limit  of the discretization error, which intervals do not contain
    void add(const Estimate& reported, const Estimate& truth, double limit = 0) {
        // The truth has an error of its own, a small part of that of the interval.
        constexpr double kNormal = 1.96;
        const double off = truth.mean - reported.mean;
        const double half =
            off < 0 ? reported.mean - reported.ci95_low : reported.ci95_high - reported.mean;
        held += std::abs(off) <= std::hypot(half, kNormal * truth.standard_error) + limit ? 1 : 0;
        ++all;
    }
    [[nodiscard]] double part() const { return static_cast<double>(held) / all; }
};

}  // namespace

void expect_intervals_hold(const Scene& scene, std::uint64_t paths) {
    const Sources sources{sun(35, {1, 1}), sky({1, 1})};
    RunSpec truth_spec = spec_of(Method::first_hits, 1 << 19);
    truth_spec.seed = 12345;
    const bool has_plants =
        std::any_of(scene.organs().begin(), scene.organs().end(), [](const Organ& organ) {
            const Labels& labels = organ.labels;
            return !labels.empty();
        });
    if (has_plants) {
        truth_spec.groups = {"plant"};
    }
    const Result truth = run(scene, sources, truth_spec);
    RunSpec pilot = bundles(paths);
    pilot.replicates = 8;
    pilot.groups = truth_spec.groups;
    constexpr std::uint64_t kSeeds = 100;
    constexpr double kLimitOfTotals = 5e-4;  // docs/theory/ray-bundles.md, Limits
    for (std::size_t band = 0; band < 2; ++band) {
        Held organs, groups, totals;
        for (pilot.seed = 1; pilot.seed <= kSeeds; ++pilot.seed) {
            const Result result = run(scene, sources, pilot);
            for (std::size_t i = 0; i < result.organs(); ++i) {
                organs.add(
                    result.at(i, Quantity::absorbed_flux, band),
                    truth.at(i, Quantity::absorbed_flux, band));
            }
            for (std::size_t g = 1; g < result.groups.groups.size(); ++g) {
                groups.add(
                    result.groups.at(g, Quantity::absorbed_flux, band),
                    truth.groups.at(g, Quantity::absorbed_flux, band));
            }
            totals.add(
                result.budget[band].absorbed_by_organs, truth.budget[band].absorbed_by_organs,
                kLimitOfTotals * truth.budget[band].absorbed_by_organs.mean);
        }
        EXPECT_GT(organs.part(), .93) << "band " << band;
        constexpr int kTellTale = 1000;  // of fewer, all may hold
        EXPECT_TRUE(organs.all < kTellTale || organs.part() < .999) << "band " << band;
        EXPECT_TRUE(groups.all == 0 || groups.part() > .9) << "band " << band;
        EXPECT_GE(totals.held, 87) << "band " << band;
        ::testing::Test::RecordProperty(
            "band " + std::to_string(band),
            fmt::format(
                "organs {:.4f}, groups {:.4f} of {}, totals {:.2f}", organs.part(),
                groups.all > 0 ? groups.part() : 0, groups.all, totals.part()));
    }
}

}  // namespace quasimc::test
