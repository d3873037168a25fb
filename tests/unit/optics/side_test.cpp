#include "optics/side.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

constexpr double kBelowOne = 1 - 0x1p-53;

Lobe lobe(const char* model, Hemisphere hemisphere, double exponent, std::vector<double> albedo) {
    return {find_bsdf(model)->make(hemisphere, std::array{exponent}), std::move(albedo)};
}

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The probability of survival that is promised: the mean albedo.
double mean_albedo(const Side& side, std::span<const double> weights) {
    return std::inner_product(weights.begin(), weights.end(), side.albedo().begin(), 0.0) /
           sum(weights);
}

TEST(Side, AddsUpAlbedoAndAbsorptance) {
    const Side side(
        {lobe("lambertian", Hemisphere::reflected, 0, {0.25, 0.5}),
         lobe("phong", Hemisphere::transmitted, 10, {0.5, 0})},
        2);
    EXPECT_EQ(side.albedo()[0], 0.75);
    EXPECT_EQ(side.albedo()[1], 0.5);
    EXPECT_EQ(side.absorptance()[0], 0.25);
    EXPECT_EQ(side.absorptance()[1], 0.5);
    EXPECT_FALSE(side.has_delta());
}

TEST(Side, MergesMirrorsOfOneHemisphereAndDropsBlackLobes) {
    const Side side(
        {lobe("mirror", Hemisphere::reflected, 0, {0.25, 0}),
         lobe("mirror", Hemisphere::transmitted, 0, {0.1, 0.1}),
         lobe("mirror", Hemisphere::reflected, 0, {0, 0.5}),
         lobe("phong", Hemisphere::reflected, 7, {0, 0})},
        2);
    ASSERT_EQ(side.lobes().size(), 2U);
    EXPECT_EQ(side.lobes()[0].albedo, (std::vector<double>{0.25, 0.5}));
    EXPECT_TRUE(side.has_delta());
}

TEST(Side, OfNoLobesIsBlack) {
    const Side side({}, 3);
    std::vector<double> weights(3, 1.0);
    EXPECT_FALSE(side.scatter({0, 0, 1}, {0, 0, -1}, {0, 0.5}, weights));
    EXPECT_EQ(side.absorptance()[2], 1);
}

TEST(Side, EndsLightWithoutWeight) {
    const Material leaf = make_material(varied_leaf(3, 3), 3);
    for (const double u0 : {0.0, 0.5, kBelowOne}) {
        std::vector<double> weights(3, 0.0);
        EXPECT_FALSE(
            leaf.side(SurfaceSide::upper).scatter({0, 0, 1}, {0, 0, -1}, {u0, 0.5}, weights));
    }
    std::vector<double> none(1, 0.0);
    const Side white({lobe("lambertian", Hemisphere::reflected, 0, {1.0})}, 1);
    EXPECT_FALSE(white.scatter({0, 0, 1}, {0, 0, -1}, {0.5, 0.5}, none));
}

TEST(Side, ThatAbsorbsNothingNeverEndsThePath) {
    const Side side(
        {lobe("lambertian", Hemisphere::reflected, 0, {0.25, 0.5}),
         lobe("mirror", Hemisphere::transmitted, 0, {0.75, 0.5})},
        2);
    for (const double u0 : {0.0, 0.25, 0.375, kBelowOne}) {
        std::vector<double> weights{1.0, 1.0};
        EXPECT_TRUE(side.scatter({0, 0, 1}, {0, 0, -1}, {u0, 0.5}, weights)) << u0;
    }
}

TEST(Side, KeepsTheWeightOfASingleBand) {
    const Side side(
        {lobe("lambertian", Hemisphere::reflected, 0, {0.3}),
         lobe("phong", Hemisphere::reflected, 9, {0.2}),
         lobe("phong", Hemisphere::transmitted, 10, {0.1})},
        1);
    for (const double u0 : {0.0, 0.31, 0.55}) {
        std::vector<double> weights{0.7};
        ASSERT_TRUE(side.scatter({0, 0, 1}, {0, 0, -1}, {u0, 0.5}, weights));
        EXPECT_EQ(weights[0], 0.7);
    }
    std::vector<double> weights{0.7};
    EXPECT_FALSE(side.scatter({0, 0, 1}, {0, 0, -1}, {0.601, 0.5}, weights));
}

TEST(Side, LetsLightOfEnoughWeightGoOnSurelyAndLoseWeight) {
    const Side grey({lobe("lambertian", Hemisphere::reflected, 0, {0.5})}, 1);
    std::vector<double> weights{8.0};
    ASSERT_TRUE(grey.scatter({0, 0, 1}, {0, 0, -1}, {kBelowOne, 0.5, 1.0}, weights));
    EXPECT_DOUBLE_EQ(weights[0], 4);  // by its albedo
    weights = {1.5};
    ASSERT_TRUE(grey.scatter({0, 0, 1}, {0, 0, -1}, {0.74, 0.5, 1.0}, weights));
    EXPECT_DOUBLE_EQ(weights[0], 1);  // to what is enough, with probability 0.75
    weights = {1.5};
    EXPECT_FALSE(grey.scatter({0, 0, 1}, {0, 0, -1}, {0.76, 0.5, 1.0}, weights));
    weights = {0.9};
    ASSERT_TRUE(grey.scatter({0, 0, 1}, {0, 0, -1}, {0.49, 0.5, 1.0}, weights));
    EXPECT_DOUBLE_EQ(weights[0], 0.9);  // played for by its albedo
    EXPECT_FALSE(grey.scatter({0, 0, 1}, {0, 0, -1}, {0.51, 0.5, 1.0}, weights));
}

TEST(Side, WeighsLobesThatOverlapByTheBalanceHeuristic) {
    const Side side(
        {lobe("phong", Hemisphere::reflected, 3, {0.5, 0.1}),
         lobe("phong", Hemisphere::reflected, 30, {0.2, 0.7}),
         lobe("lambertian", Hemisphere::transmitted, 0, {0.1, 0.1})},
        2);
    const auto [n, wi] = incidence_at(40);
    const std::vector<double> before{2.0, 1.0};
    const std::array<double, 2> q{(2 * 0.5 + 0.1) / 3, (2 * 0.2 + 0.7) / 3};
    for (const double u0 : {0.1, 0.3, 0.4, 0.7}) {  // either lobe
        std::vector<double> weights = before;
        const auto scattered = side.scatter(n, wi, {u0, 0.3}, weights);
        ASSERT_TRUE(scattered);
        const double p0 = side.lobes()[0].shape->pdf(n, wi, scattered->wo);
        const double p1 = side.lobes()[1].shape->pdf(n, wi, scattered->wo);
        const double density = q[0] * p0 + q[1] * p1;
        EXPECT_NEAR(weights[0], 2 * (0.5 * p0 + 0.2 * p1) / density, 1e-12);
        EXPECT_NEAR(weights[1], 1 * (0.1 * p0 + 0.7 * p1) / density, 1e-12);
    }
}

TEST(Side, NeverEndsALightThatGoesOnSurelyByRounding) {
    Random random(15);
    for (int i = 0; i < 3000; ++i) {
        const std::size_t bands = 1 + static_cast<std::size_t>(i % 3);
        const auto fractions = [&] {
            std::vector<double> a(bands);
            std::generate(a.begin(), a.end(), [&] { return random() / 3; });
            return a;
        };
        const Side side(
            {lobe("lambertian", Hemisphere::reflected, 0, fractions()),
             lobe("phong", Hemisphere::reflected, 2, fractions()),
             lobe("lambertian", Hemisphere::transmitted, 0, fractions())},
            bands);
        std::vector<double> weights = fractions();
        const auto scattered = side.scatter({0, 0, 1}, {0, 0, -1}, {kBelowOne, 0.5, 0.0}, weights);
        ASSERT_TRUE(scattered);
        ASSERT_NEAR(length(scattered->wo), 1, 1e-14);
    }
}

/// Bands and number of different exponents.
struct BandCount {
    std::size_t bands, exponents;
};
class SideOfManyBands : public ::testing::TestWithParam<BandCount> {
  protected:
    std::size_t bands_ = GetParam().bands;
    Material leaf_ = make_material(varied_leaf(bands_, GetParam().exponents), bands_);
    const Side& side_ = leaf_.side(SurfaceSide::upper);
    std::vector<double> before_ = varied_weights(bands_);
    Incidence at_ = incidence_at(50);
};

TEST_P(SideOfManyBands, KeepsTheMeanWeightOnEverySurvivingPath) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> weights = before_;
        const double u0 = random();
        if (side_.scatter(at_.n, at_.wi, {u0, random()}, weights)) {
            ASSERT_NEAR(sum(weights), sum(before_), 1e-12 * sum(before_));
        } else {
            ASSERT_EQ(weights, before_);
        }
    }
}

TEST_P(SideOfManyBands, SurvivesWithTheMeanAlbedo) {
    constexpr int kTries = 100000;
    Random random(6);
    int survived = 0;
    for (int i = 0; i < kTries; ++i) {
        std::vector<double> weights = before_;
        const double u0 = random();
        survived += side_.scatter(at_.n, at_.wi, {u0, random()}, weights) ? 1 : 0;
    }
    const double expected = mean_albedo(side_, before_);
    EXPECT_TRUE(agrees(measured_fraction(survived, kTries, expected), expected, 0.01));
}

TEST_P(SideOfManyBands, BringsTheWeightsDownToWhatIsEnough) {
    const double all = sum(before_);
    const double kept = mean_albedo(side_, before_) * all;
    Random random(14);
    for (const double roulette_threshold : {0.0, 0.5 * kept, (kept + all) / 2, 2 * all}) {
        const double after = std::max(std::min(roulette_threshold, all), kept);
        for (int i = 0; i < 500; ++i) {
            std::vector<double> weights = before_;
            const double u0 = i == 0 ? kBelowOne : random();
            const bool goes_on =
                side_.scatter(at_.n, at_.wi, {u0, random(), roulette_threshold}, weights)
                    .has_value();
            ASSERT_TRUE(goes_on || after > kept) << "certain, but ended at u0 = " << u0;
            ASSERT_NEAR(sum(weights), goes_on ? after : all, 1e-12 * all);
        }
    }
}

TEST_P(SideOfManyBands, IsSoundAtEveryEdge) {
    std::vector<double> edges = {0.0, 0x1p-53, kBelowOne};
    double start = 0;
    for (const Lobe& l : side_.lobes()) {
        start += std::inner_product(before_.begin(), before_.end(), l.albedo.begin(), 0.0) /
                 sum(before_);
        edges.insert(edges.end(), {std::nextafter(start, 0.0), start, std::nextafter(start, 1.0)});
    }
    const auto expect_sound = [this](double theta_deg, double u0, double u1) {
        const auto [n, wi] = incidence_at(theta_deg);
        std::vector<double> weights = before_;
        const auto scattered = side_.scatter(n, wi, {u0, u1}, weights);
        EXPECT_NEAR(scattered ? length(scattered->wo) : 1, 1, 1e-14);
        const auto is_sound = [](double w) { return std::isfinite(w) && w >= 0; };
        EXPECT_TRUE(std::all_of(weights.begin(), weights.end(), is_sound)) << u0;
    };
    for (const double theta_deg : {0.0, 85.0, 89.9999999}) {
        for (const double u0 : edges) {
            expect_sound(theta_deg, u0, 0);
            expect_sound(theta_deg, u0, 0.3);
            expect_sound(theta_deg, u0, kBelowOne);
        }
    }
}

TEST_P(SideOfManyBands, ScattersTheSameInTwoSteps) {
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        const double u0 = random();
        const double u1 = random();
        std::vector<double> weights = before_;
        std::vector<double> weights_in_steps = before_;
        const auto at_once = side_.scatter(at_.n, at_.wi, {u0, u1}, weights);
        const LobeTable::Choice choice = side_.choose({u0, 0}, weights_in_steps);
        ASSERT_EQ(at_once.has_value(), choice.row != nullptr);
        if (at_once) {
            const auto in_steps = side_.scatter_by(choice, at_.n, at_.wi, u1, weights_in_steps);
            EXPECT_EQ(at_once->wo, in_steps.wo);
            EXPECT_EQ(at_once->delta, choice.row->delta);
            EXPECT_EQ(weights, weights_in_steps);
        }
    }
}

std::string band_count_name(const ::testing::TestParamInfo<BandCount>& info) {
    return std::to_string(info.param.bands) + "_bands_" + std::to_string(info.param.exponents) +
           "_exponents";
}

INSTANTIATE_TEST_SUITE_P(
    Spectra,
    SideOfManyBands,
    ::testing::Values(
        BandCount{1, 1},
        BandCount{2, 2},
        BandCount{3, 3},
        BandCount{3, 1},
        BandCount{20, 8},
        BandCount{200, 6},
        BandCount{300, 300}),
    band_count_name);

}  // namespace
}  // namespace quasimc::test
