// What the interface promises, for every row of the catalogue.

#include <array>
#include <cmath>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "detectors/catalogue.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kBands = 3;
constexpr std::array<std::int64_t, kBands> kAmounts{7, 11, 13};

/// Directions all over the sphere, those along the axes among them.
std::vector<Vec3> directions() {
    std::vector<Vec3> all{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    constexpr int kMany = 1000;
    for (int i = 0; i < kMany; ++i) {
        const double z = 1 - (2 * i + 1.0) / kMany;
        const double r = std::sqrt(1 - z * z);
        all.push_back({r * std::cos(2.4 * i), r * std::sin(2.4 * i), z});
    }
    return all;
}

/// With the usual values, or else the lowest.
DetectorSpec usual(const DetectorEntry& type) {
    DetectorSpec spec{.type = std::string(type.name)};
    for (const DetectorParameter& parameter : type.parameters) {
        spec.parameters.emplace(parameter.name, parameter.usual.value_or(parameter.low));
    }
    return spec;
}

class EveryDetector : public ::testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] const DetectorEntry& type() const { return *find_detector(GetParam()); }

    /// The bins that light of a direction is added to; the first is the detector's own first.
    [[nodiscard]] ExactBins bins_of(const Vec3& direction) const {
        const SumLayout layout(
            0,
            {detector_block("before", kBefore, 1), detector_block("it", axis_.bins.size(), kBands),
             detector_block("after", kBefore, 1)});
        Tally tally(layout);
        const std::size_t first = tally.blocks().detector(1);
        detector_->on_escape(direction, kAmounts, first, tally);
        ExactBins bins(layout.bins());
        tally.move_into(bins);
        first_ = first;
        return bins;
    }

    static constexpr std::size_t kBefore = 5;
    std::unique_ptr<Detector> detector_ = make_detector(usual(type()));
    DetectorAxis axis_ = detector_->axis();
    mutable std::size_t first_ = 0;
};

INSTANTIATE_TEST_SUITE_P(
    Catalogue,
    EveryDetector,
    ::testing::ValuesIn([] {
        std::vector<std::string> names;
        for (const DetectorEntry& type : detector_catalogue()) {
            names.emplace_back(type.name);
        }
        return names;
    }()),
    [](const auto& param) { return param.param; });

TEST_P(EveryDetector, HasARowThatTellsAllOfIt) {
    EXPECT_FALSE(type().summary.empty());
    EXPECT_FALSE(axis_.quantity.empty());
    Faults faults;
    EXPECT_EQ(check_detectors({usual(type())}, faults).size(), 1U);
    EXPECT_TRUE(faults.empty());
    for (const DetectorParameter& parameter : type().parameters) {
        EXPECT_LE(parameter.low, parameter.high) << parameter.name;
        EXPECT_FALSE(parameter.summary.empty()) << parameter.name;
    }
}

TEST_P(EveryDetector, HasBinsOfDifferentNames) {
    EXPECT_FALSE(axis_.bins.empty());
    EXPECT_EQ(
        (std::set<std::string>(axis_.bins.begin(), axis_.bins.end()).size()), axis_.bins.size());
}

TEST_P(EveryDetector, AddsAllBandsToOneOfItsOwnBinsOrNothing) {
    for (const Vec3& direction : directions()) {
        const ExactBins bins = bins_of(direction);
        std::size_t found = 0;
        for (std::size_t i = 0; i < bins.size(); ++i) {
            const std::int64_t low = bins.quanta(i).low;
            const bool is_own = i >= first_ && i < first_ + axis_.bins.size() * kBands;
            ASSERT_TRUE(low == 0 || (is_own && low == kAmounts[(i - first_) % kBands]));
            found += low != 0 ? 1 : 0;
        }
        ASSERT_TRUE(found == 0 || found == kBands);
        EXPECT_EQ(bins, bins_of(direction));
    }
}

}  // namespace
}  // namespace quasimc::test
