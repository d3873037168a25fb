// Light absorbed by surfaces whose albedo depends on the angle of incidence: it is summed, and not
// derived from the incident light.

#include <cmath>

#include <gtest/gtest.h>

#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr double kCoatReflectance = .04;

/// A leaf under a coat, the same on both sides.
MaterialSpec coated(std::string name, double rho, double tau, std::size_t bands = 1) {
    MaterialSpec spec = diffuse(std::move(name), rho, tau, bands);
    for (auto* side : {&spec.upper, &spec.lower}) {
        for (SideOptics& optics : *side) {
            optics.reflection_model = optics.transmission_model = "coated_lambertian";
            optics.reflection_parameters["coat"] = kCoatReflectance;
            optics.transmission_parameters["coat"] = kCoatReflectance;
        }
    }
    return spec;
}

/// A plate of reflectance 0.6 and transmittance 0.3 under its coat.
Scene coated_plate() {
    SceneBuilder builder = make_builder();
    builder.add_material(coated("waxy", .6, .3));
    builder.add_organ(organ("plate", "waxy", floor_of(0, 1, 0, 1, .5)));
    return std::move(builder).build();
}

class AbsorbedLight : public BothWays {};

TEST_P(AbsorbedLight, OfAPlateUnderTheSunIsWhatItsAngleLeaves) {
    for (const double zenith_deg : {0.0, 60.0, 80.0}) {
        const double cosine = std::cos(zenith_deg * std::numbers::pi / 180);
        const double albedo = .9 * (1 - kCoatReflectance) * (1 - std::pow(1 - cosine, 5));
        const Result result =
            run(coated_plate(), {sun(zenith_deg, {2})}, spec_of(GetParam(), 1 << 12));
        const Estimate& absorbed = result.at(0, Quantity::absorbed_flux, 0);
        EXPECT_TRUE(holds({"under the sun", 2 * cosine * (1 - albedo), 1e-3, 3}, absorbed))
            << zenith_deg;
    }
}

/// Under a uniform sky the mean of (1 - cos)^5 over the cosine law is 2 (1/6 - 1/7) = 1/21.
TEST_P(AbsorbedLight, OfAPlateUnderASkyIsTheMeanOverItsAngles) {
    const double albedo = .9 * (1 - kCoatReflectance) * (1 - 1 / 21.0);
    const Result result = run(coated_plate(), {sky({1})}, spec_of(GetParam(), 1 << 13));
    EXPECT_TRUE(agrees(
        measured(result.at(0, Quantity::absorbed_flux, 0), kReplicates), 1 - albedo,
        resolution(.01, .04)));
}

TEST_P(AbsorbedLight, OfAStandIsTheSameFromEveryWayAndItsEnergyCloses) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(coated("waxy", .4, .3, 2));
    builder.add_material(diffuse("lambertian", .2, .5, 2));
    const std::vector<Triangle> leaves = random_leaves(24, .5, 1, 3);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        builder.add_organ(organ("", i % 2 == 0 ? "waxy" : "lambertian", {leaves[i]}));
    }
    const Scene scene = std::move(builder).build();
    const Sources sources{sun(40, {2, 1}), sky({1, 1})};
    const Result result = run(scene, sources, spec_of(GetParam(), 1 << 13));
    const Result plain = run(scene, sources, spec_of(Method::light_tracing, 1 << 14));
    for (std::size_t b = 0; b < 2; ++b) {
        const Estimate& here = result.budget[b].absorbed_by_organs;
        const Estimate& there = plain.budget[b].absorbed_by_organs;
        EXPECT_TRUE(agrees(
            measured(here, kReplicates), measured(there, kReplicates), .02 * there.mean,
            sidak_level(kLevel, 2)));
        EXPECT_LT(result.budget[b].closure_error, 1e-6);
        if (GetParam() != Method::from_organs) {
            EXPECT_TRUE(agrees(
                measured(result.budget[b].imbalance, kReplicates), 0,
                .02 * result.budget[b].emitted.mean, sidak_level(kLevel, 2)));
        }
    }
}

/// Negative control: the value derived from the incident light differs.
TEST_P(AbsorbedLight, DoesNotFollowFromIncidentLight) {
    const Result result = run(coated_plate(), {sun(80, {1})}, spec_of(GetParam(), 1 << 10));
    const double incident = result.at(0, Quantity::incident_upper, 0).mean;
    EXPECT_GT(result.at(0, Quantity::absorbed_flux, 0).mean, 3 * .1 * incident);
}

INSTANTIATE_TEST_SUITE_P(
    Ways,
    AbsorbedLight,
    ::testing::Values(Method::light_tracing, Method::first_hits, Method::from_organs),
    name_of);

}  // namespace
}  // namespace quasimc::test
