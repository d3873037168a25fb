#include "solvers/direct/many_suns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

using Sun = ManySuns::Sun;

/// The direction of light at a part of the way from east to west over the south.
Vec3 on_arc(double part) {
    const double angle = std::numbers::pi * (.02 + .96 * part);
    return {-std::cos(angle), .5 * std::sin(angle), -std::sqrt(.75) * std::sin(angle)};
}

/// Suns of a day whose light takes as long as `paths` each.
std::vector<Sun> day_of(std::uint32_t count, double paths = 50) {
    std::vector<Sun> suns;
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double part = (i + .5) / count;
        suns.push_back({i, std::sin(std::numbers::pi * part), paths, on_arc(part)});
        sum += suns.back().probability;
    }
    for (Sun& sun : suns) {
        sun.probability *= .8 / sum;  // the remainder is that of a sky
    }
    return suns;
}

/// The light that each sun represents.
std::vector<double> represented(const ManySuns& suns, std::uint32_t count, double u) {
    std::vector<double> light(suns.suns().size());
    for (const auto& [index, probability] : suns.pick(count, u)) {
        light[index] += probability;
    }
    return light;
}

TEST(ManySuns, ArePickedAsManyAsTheirPathsPayFor) {
    const ManySuns suns(day_of(1000));
    EXPECT_EQ(suns.affordable(4096), 65);  // .8 * 4096 / 50
    EXPECT_EQ(suns.affordable(60), 0);
    EXPECT_EQ(suns.affordable(1e6), 1000);
    EXPECT_TRUE(ManySuns().empty());
}

TEST(ManySuns, RepresentAllLightInEveryReplicate) {
    const ManySuns suns(day_of(1000));
    for (const double u : {0., .3, .999999, 1 - 0x1p-53}) {
        const auto picks = suns.pick(64, u);
        EXPECT_EQ(picks.size(), 64);
        for (const ManySuns::Pick& pick : picks) {
            EXPECT_EQ(pick.probability, suns.light_of_each(64));
        }
        EXPECT_NEAR(suns.light_of_each(64), .8 / 64, 1e-15);
    }
}

TEST(ManySuns, AreExpectedToRepresentTheirOwnLight) {
    constexpr int kShifts = 4000;
    std::vector<Sun> all = day_of(40);
    all[7].probability *= 9;  // more than the light of a pick
    const ManySuns suns(all);
    std::vector<double> mean(all.size());
    for (int i = 0; i < kShifts; ++i) {
        const std::vector<double> light = represented(suns, 12, (i + .5) / kShifts);
        for (std::size_t sun = 0; sun < all.size(); ++sun) {
            mean[sun] += light[sun] / kShifts;
        }
    }
    for (std::size_t sun = 0; sun < all.size(); ++sun) {
        EXPECT_NEAR(mean[sun], all[sun].probability, suns.light_of_each(12) / kShifts) << sun;
    }
}

TEST(ManySuns, RepresentThemselvesIfAllAreTaken) {
    const std::vector<Sun> all = day_of(30);
    const std::vector<double> light = represented(ManySuns(all), 30, .7);
    for (std::size_t sun = 0; sun < all.size(); ++sun) {
        EXPECT_EQ(light[sun], all[sun].probability);
    }
}

/// Days one after the other: neighbours in the list are far apart in the sky.
TEST(ManySuns, AreTakenInTheOrderOfTheSkyIfTheListIsNot) {
    std::vector<Sun> year;
    constexpr std::uint32_t kDays = 40, kOfDay = 25;
    for (std::uint32_t i = 0; i < kDays * kOfDay; ++i) {
        const std::uint32_t day = i / kOfDay;
        const double height = static_cast<double>(day) / kDays;
        const Vec3 sun = on_arc((i % kOfDay + .5) / kOfDay);
        year.push_back({i, .001, 50, normalized(sun - Vec3{0, 0, height})});
    }
    const auto turns = [](const std::vector<Sun>& suns) {
        double sum = 0;
        for (std::size_t i = 1; i < suns.size(); ++i) {
            sum += length(suns[i].direction - suns[i - 1].direction);
        }
        return sum;
    };
    const std::vector<Sun> taken = ManySuns(year).suns();
    EXPECT_LT(turns(taken), .7 * turns(year));
    EXPECT_TRUE(std::ranges::is_permutation(taken, year, {}, &Sun::light, &Sun::light));
    const std::vector<Sun> day = day_of(500);
    EXPECT_TRUE(std::ranges::equal(ManySuns(day).suns(), day, {}, &Sun::light, &Sun::light));
}

}  // namespace
}  // namespace quasimc::test
