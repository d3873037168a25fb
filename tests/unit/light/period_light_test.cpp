#include "light/daylight/period_light.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "light/models/source.h"

namespace quasimc::test {
namespace {

using Spectrum = std::vector<double>;
using Sources = std::vector<std::shared_ptr<const Source>>;

const Vec3 kMorning = normalized({1, 0, .5});
const Vec3 kEvening = normalized({-1, 0, .5});

double on_the_horizontal(const Sources& sources, std::size_t band) {
    double sum = 0;
    for (const auto& source : sources) {
        sum += source->spectrum()[band] * source->horizontal_irradiance();
    }
    return sum;
}

double radiance(const Sources& sources, const Vec3& towards, std::size_t band) {
    double sum = 0;
    for (const auto& source : sources) {
        sum += source->spectrum()[band] * model_of(*source).radiance(towards);
    }
    return sum;
}

std::size_t suns(const Sources& sources) {
    return static_cast<std::size_t>(std::count_if(
        sources.begin(), sources.end(), [](const auto& source) { return source->is_sun(); }));
}

/// A sky with the sun in the east, one in the west and a dim one with the spectrum of both.
Sources sources_of(const std::vector<Spectrum>& spectra) {
    PeriodLight light(spectra[0].size(), 48, 24);
    light.add_sky(cie_clear_shape(kMorning), spectra[0]);
    light.add_sky(cie_clear_shape(kEvening), spectra[1]);
    light.add_sky(cie_overcast_shape(), spectra[2]);
    return light.sources("day");
}

/// The light of all sources together is that of the time steps.
void expect_sum(const Sources& sources, const std::vector<Spectrum>& spectra) {
    for (std::size_t b = 0; b < spectra[0].size(); ++b) {
        const double sum = spectra[0][b] + spectra[1][b] + spectra[2][b];
        EXPECT_NEAR(on_the_horizontal(sources, b), sum, 1e-9 * sum);
        // Each band has its own shares of morning, evening and overcast sky.
        for (const Vec3& towards : {normalized({1, .1, .5}), normalized({-1, .1, .5})}) {
            const std::array<SkyShape, 3> shapes{
                cie_clear_shape(kMorning), cie_clear_shape(kEvening), cie_overcast_shape()};
            double expected = 0;
            for (std::size_t i = 0; i < shapes.size(); ++i) {
                const auto sky = make_sky("one", shapes[i], Spectrum(spectra[0].size(), 1));
                expected += spectra[i][b] * model_of(*sky).radiance(towards);
            }
            // The table's cells are 7.5 degrees wide.
            EXPECT_NEAR(radiance(sources, towards, b), expected, .12 * expected) << b;
        }
    }
}

TEST(PeriodLight, IsOneSkyIfSpectraAreAlike) {
    const std::vector<Spectrum> spectra{{10, 5}, {20, 10}, {4, 2}};
    const Sources sources = sources_of(spectra);
    EXPECT_EQ(sources.size(), 1U);
    expect_sum(sources, spectra);
}

TEST(PeriodLight, IsTwoSkiesIfSpectraAreMixturesOfTwo) {
    const std::vector<Spectrum> spectra{{10, 5, 1}, {1, 4, 8}, {10.5, 7, 5}};  // the sum of 1, 1/2
    const Sources sources = sources_of(spectra);
    EXPECT_EQ(sources.size(), 2U);
    expect_sum(sources, spectra);
    // In any order.
    const std::vector<Spectrum> turned{spectra[2], spectra[0], spectra[1]};
    EXPECT_EQ(sources_of(turned).size(), 2U);
    expect_sum(sources_of(turned), turned);
}

TEST(PeriodLight, IsASkyForEachBandIfSpectraAreNoMixtures) {
    const std::vector<Spectrum> spectra{{10, 5, 1}, {1, 4, 8}, {1, 10, 1}};
    const Sources sources = sources_of(spectra);
    EXPECT_EQ(sources.size(), 3U);
    expect_sum(sources, spectra);
}

TEST(PeriodLight, KeepsEverySun) {
    PeriodLight light(2);
    light.add_sun(kMorning, Spectrum{100, 50});
    light.add_sun(kEvening, Spectrum{200, 100});
    light.add_sun({0, .6, -.8}, Spectrum{1, 1});  // below the horizon
    light.add_sun(kEvening, Spectrum{0, 0});
    EXPECT_EQ(light.suns(), 2U);
    const Sources sources = light.sources("day", .5);
    EXPECT_EQ(suns(sources), 2U);
    EXPECT_NEAR(on_the_horizontal(sources, 0), 150 * kMorning.z, 1e-9);
    EXPECT_NEAR(on_the_horizontal(sources, 1), 75 * kMorning.z, 1e-9);
    EXPECT_NEAR(dot(model_of(*sources[0]).illuminate({}, 0, 0).to_light, kMorning), 1, 1e-14);
}

TEST(PeriodLight, OfTheNightIsNothing) {
    PeriodLight light(1);
    light.add_sky(cie_overcast_shape(), Spectrum{0});
    EXPECT_TRUE(light.sources("night").empty());
}

}  // namespace
}  // namespace quasimc::test
