// Leaves of plates, against the output that comes with the model and against plates put together
// one by one.

#include "optics/prospect.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

const double kCosine40 = std::cos(40 * std::numbers::pi / 180);

const LeafConstants& constants_at(double nm) {
    for (const LeafConstants& row : leaf_constants()) {
        if (row.nm == nm) {
            return row;
        }
    }
    throw std::out_of_range("no such wavelength");
}

TEST(Prospect, HasItsConstantsEveryFiveNanometres) {
    ASSERT_EQ(leaf_constants().size(), 421U);
    for (std::size_t i = 0; i < leaf_constants().size(); ++i) {
        EXPECT_EQ(leaf_constants()[i].nm, 400 + 5 * static_cast<double>(i));
    }
}

struct PublishedLeaf {
    double nm, reflectance, transmittance;
};

/// leaf_spectrum.txt of the program that its first author distributes (prospect_PRO, 7 January
/// 2020), for leaf_parameter.txt: N 1.5, 40 and 10 ug cm-2 of chlorophyll and carotenoids, 0.5 of
/// anthocyanins, 0.015 cm of water; and 0.001 and 0.009 g cm-2 of proteins and other dry matter,
/// whose coefficients below 1150 nm are 0 and 127.930 / 109.7 of what dry matter has in PROSPECT-D.
constexpr PublishedLeaf kPublished[] = {
    {400, 0.043095, 0.00017732}, {405, 0.043096, 0.00018405}, {410, 0.042658, 0.00023913},
    {425, 0.041832, 0.00038754}, {450, 0.041135, 0.00089666}, {475, 0.041465, 0.0038188},
    {500, 0.046883, 0.016665},   {525, 0.10855, 0.099886},    {550, 0.13893, 0.13687},
    {575, 0.10227, 0.098416},    {600, 0.077862, 0.070712},   {625, 0.060101, 0.047889},
    {650, 0.045408, 0.025044},   {675, 0.035872, 0.004723},   {700, 0.12662, 0.13423},
    {725, 0.33652, 0.36162},     {750, 0.41666, 0.44667},     {775, 0.43519, 0.46741},
    {800, 0.43624, 0.46819},     {850, 0.43578, 0.46758},     {900, 0.43491, 0.46742},
    {950, 0.42834, 0.46207},     {970, 0.42347, 0.4578},      {1000, 0.42468, 0.46057},
    {1050, 0.42936, 0.46886},    {1100, 0.42701, 0.47071},    {1150, 0.4064, 0.45364}};

/// Half a unit of the fifth digit, by the magnitude of a number.
double rounding(double x) {
    return 0.5 * std::pow(10, std::floor(std::log10(x)) - 4);
}

TEST(Prospect, GivesWhatItsAuthorsProgramGives) {
    const LeafConstituents leaf{
        .structure = 1.5,
        .chlorophyll = 40,
        .carotenoids = 10,
        .anthocyanins = 0.5,
        .water = 0.015,
        .dry_matter = 0.009 * 127.930 / 109.7};
    for (const PublishedLeaf& published : kPublished) {
        const LeafOptics optics = prospect(constants_at(published.nm), leaf);
        EXPECT_NEAR(
            optics.reflectance, published.reflectance, 1.01 * rounding(published.reflectance))
            << published.nm;
        EXPECT_NEAR(
            optics.transmittance, published.transmittance, 1.01 * rounding(published.transmittance))
            << published.nm;
    }
}

TEST(Prospect, LosesNothingWithoutConstituents) {
    for (const LeafConstants& row : leaf_constants()) {
        for (const double structure : {1.0, 1.3, 4.0}) {
            const LeafOptics optics = prospect(row, {.structure = structure});
            EXPECT_NEAR(optics.reflectance + optics.transmittance, 1, 1e-12);
        }
    }
}

/// A hair of absorption must be near none, not an overflow of what it is divided by.
TEST(Prospect, IsSteadyFromNoAbsorptionToAll) {
    for (const LeafConstants& row : leaf_constants()) {
        const LeafOptics none = prospect(row, {.structure = 2});
        const LeafOptics hair = prospect(row, {.structure = 2, .dry_matter = 1e-12});
        EXPECT_NEAR(hair.transmittance, none.transmittance, 1e-6) << row.nm;
        const LeafOptics black = prospect(row, {.structure = 9, .water = 1, .dry_matter = 500});
        EXPECT_NEAR(black.transmittance, 0, 1e-12) << row.nm;
        EXPECT_NEAR(
            black.reflectance, 1 - surface_transmissivity(row.refractive_index, kCosine40), 1e-12);
    }
}

TEST(Prospect, EachConstituentAbsorbs) {
    const LeafConstituents leaf{
        .structure = 1.5, .chlorophyll = 30, .carotenoids = 8, .water = 0.01, .dry_matter = 0.005};
    const auto absorbed = [](double nm, const LeafConstituents& what) {
        const LeafOptics optics = prospect(constants_at(nm), what);
        return 1 - optics.reflectance - optics.transmittance;
    };
    const auto more = [&](double nm, double LeafConstituents::*of) {
        LeafConstituents richer = leaf;
        richer.*of += 0.3 * (richer.*of) + 0.001;
        return absorbed(nm, richer) - absorbed(nm, leaf);
    };
    EXPECT_GT(more(700, &LeafConstituents::chlorophyll), 0.01);
    EXPECT_GT(more(515, &LeafConstituents::carotenoids), 0.001);
    EXPECT_GT(more(550, &LeafConstituents::anthocyanins), 1e-6);
    EXPECT_GT(more(800, &LeafConstituents::brown_pigments), 1e-6);
    EXPECT_GT(more(1450, &LeafConstituents::water), 0.01);
    EXPECT_GT(more(2300, &LeafConstituents::dry_matter), 0.001);
    EXPECT_EQ(more(900, &LeafConstituents::chlorophyll), 0);
}

/// Plates stacked one by one, by the sum over all reflections between them.
TEST(Prospect, WholeNumbersOfPlatesAreThatManyPlates) {
    const LeafConstants& row = constants_at(550);
    constexpr double kAbsorption = 0.1;
    const double n = row.refractive_index, inside = plate_transmissivity(kAbsorption);
    const double in = surface_transmissivity(n, 0), back = 1 - in / (n * n);
    const auto plate_of = [&](double enters) {
        double reflectance = 1 - enters, transmittance = 0, light = enters * inside;
        for (int i = 0; i < 200; ++i) {
            transmittance += light * (1 - back);
            light *= back * inside;
            reflectance += light * (1 - back);
            light *= back * inside;
        }
        return std::pair{reflectance, transmittance};
    };
    const auto [first_r, first_t] = plate_of(surface_transmissivity(n, kCosine40));
    const auto [r, t] = plate_of(in);
    double others_r = 0, others_t = 1;  // of the plates below the first
    for (int plates = 1; plates <= 4; ++plates) {
        const double between = 1 - r * others_r;
        const LeafOptics optics = prospect(
            row, {.structure = static_cast<double>(plates),
                  .dry_matter = plates * kAbsorption / row.dry_matter});
        EXPECT_NEAR(optics.reflectance, first_r + first_t * others_r * t / between, 1e-12);
        EXPECT_NEAR(optics.transmittance, first_t * others_t / between, 1e-12);
        others_r = r + t * t * others_r / between;
        others_t = t * others_t / between;
    }
}

/// Of light along the normal a surface reflects ((n - 1) / (n + 1))^2, of diffuse light more; and
/// as much light leaves as enters (n^2 times as much comes from within).
TEST(SurfaceTransmissivity, HasItsLimits) {
    for (const double n : {1.27, 1.4, 1.51}) {
        const double along = 1 - std::pow((n - 1) / (n + 1), 2);
        EXPECT_NEAR(surface_transmissivity(n, 1 - 1e-9), along, 1e-8);
        EXPECT_LT(surface_transmissivity(n, 0), surface_transmissivity(n, kCosine40));
        EXPECT_LT(surface_transmissivity(n, kCosine40), along);
    }
    // Duntley's closed form of the diffuse reflectance at n = 1.5 is 0.0918.
    EXPECT_NEAR(1 - surface_transmissivity(1.5, 0), 0.0918, 5e-5);
}

}  // namespace
}  // namespace quasimc::test
