// Bounds of the irradiance of sources on a side, against its measured mean.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "light/models/source.h"

namespace quasimc::test {
namespace {

/// Irradiance of a side: midpoints of the unit square.
double irradiance_of(const Source& source, const Vec3& normal) {
    constexpr int kSteps = 200;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const Illumination seen =
                model_of(source).illuminate({}, (i + .5) / kSteps, (j + .5) / kSteps);
            sum += seen.weight * std::max(0.0, dot(seen.to_light, normal));
        }
    }
    return sum / (kSteps * kSteps);
}

const std::vector<Vec3>& sides() {
    static const std::vector<Vec3> all{{0, 0, 1},       {0, 0, -1},         {1, 0, 0},
                                       {0, -1, 0},      {.6, 0, .8},        {-.6, .48, .64},
                                       {.6, .64, -.48}, {.999, .001, .0447}};
    return all;
}

SkyShape lopsided_sky() {
    SkyShape shape;
    shape.radiance = [](const Vec3& d) { return d.x > 0 ? std::exp(3 * d.x) : .1; };
    shape.azimuths = {-1.5707963267948966, 1.5707963267948966};
    return shape;
}

TEST(MostIrradiance, IsAtLeastWhatASideGetsAndNotMuchMore) {
    const Vec3 low = normalized(Vec3{1, .2, .002});
    const std::vector<std::shared_ptr<const Source>> sources{
        make_directional_source("beam", -low, {1}), make_uniform_sky("uniform", {1}),
        make_sun_disk("disk", low, .3, {1}), make_sky("lopsided", lopsided_sky(), {1}),
        make_dimmed(make_uniform_sky("dimmed", {1}), .5)};
    for (const auto& source : sources) {
        for (const Vec3& n : sides()) {
            const Vec3 normal = normalized(n);
            const double seen = irradiance_of(*source, normal);
            const double most = model_of(*source).most_irradiance(normal);
            EXPECT_GE(most, seen * (1 - 1e-3)) << source->name() << " " << n.x << " " << n.z;
            // Of a sky that is bright to one side the other's bound is wide.
            if (seen > .1 && source->name() != "lopsided") {
                EXPECT_LE(most, 1.8 * seen) << source->name() << " " << n.x << " " << n.z;
            }
        }
        EXPECT_NEAR(
            model_of(*source).most_irradiance({0, 0, 1}), source->horizontal_irradiance(), .01)
            << source->name();
    }
}

TEST(MostIrradiance, NextToALampHasNoBound) {
    LampSpec spec;
    spec.name = "lamp";
    spec.flux = {1};
    EXPECT_EQ(
        model_of(*make_lamp(std::move(spec))).most_irradiance({0, 0, 1}),
        std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace quasimc::test
