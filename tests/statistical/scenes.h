#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "optics/material.h"
#include "quasimc/mesh.h"
#include "quasimc/run.h"
#include "scene/scene.h"
#include "support/statistics.h"

// Common parts of tests of whole runs: short names for scenes, sources and runs.

namespace quasimc::test {

/// Independent randomizations of a run: Student's t at the level of one test (1e-6) is 6.0.
inline constexpr std::uint32_t kReplicates = 32;

/// Equal on both sides and in all bands.
[[nodiscard]] MaterialSpec diffuse(std::string name, double rho, double tau, std::size_t bands = 1);
/// Light passes straight, attenuated.
[[nodiscard]] MaterialSpec net(std::string name, const std::vector<double>& tau);
/// Light passes undisturbed, and is counted.
[[nodiscard]] MaterialSpec sensor(std::string name, std::size_t bands = 1);

/// An organ of one material.
[[nodiscard]] OrganSpec organ(
    std::string name, std::string material, std::vector<Triangle> triangles);

/// An organ with labels.
[[nodiscard]] OrganSpec labelled(OrganSpec organ, Labels labels);

/// Makes each triangle an organ without a name, of the material "leaf".
void add_leaves(SceneBuilder& builder, const std::vector<Triangle>& leaves);

/// A horizontal ground at height 0.
[[nodiscard]] GroundSpec ground(std::string material);

/// A builder of a scene with bands "b0", "b1", ...
[[nodiscard]] SceneBuilder make_builder(std::size_t bands = 1);

/// A leaf of 1 x 1 at the bottom of a black tube of that height.
[[nodiscard]] Scene black_tube(double height);

/// The view factor of two equal parallel squares of side 1 at distance `height` (Howell, Menguc and
/// Siegel, A Catalog of Radiation Heat Transfer Configuration Factors, C-11).
[[nodiscard]] double tube_view_factor(double height);

/// The horizontal rectangle [x0, x1] x [y0, y1] at height z, upper side up.
[[nodiscard]] std::vector<Triangle> floor_of(double x0, double x1, double y0, double y1, double z);
/// A leaf of 1 x 1 half a unit above a ground of 3 x 3 that reflects 0.3 of the light.
[[nodiscard]] Scene leaf_over_ground(double rho = .4, double tau = .2);

/// Reverses triangles, upper side down.
[[nodiscard]] std::vector<Triangle> turned_over(std::vector<Triangle> triangles);

/// A sun at a zenith angle, west of the scene: its light travels towards +x. Irradiance per band on
/// the plane facing it.
[[nodiscard]] std::shared_ptr<const Source> sun(
    double zenith_deg, const std::vector<double>& facing);
/// A uniform sky; irradiance per band on the horizontal.
[[nodiscard]] std::shared_ptr<const Source> sky(const std::vector<double>& horizontal);

/// A run in one thread with `paths` points in each of kReplicates replicates.
[[nodiscard]] RunSpec spec_of(Method from, std::uint64_t paths);

/// A claim of a test about one number.
struct Claim {
    std::string what;  ///< names the line in docs/theory/validation.md
    double expected = 0;
    double resolution = 0;  ///< the largest half-width of the interval at the test's level
    unsigned family = 1;    ///< claims that share the level of one test (Sidak)
};

/// Whether a measurement agrees with the claim (`agrees`); records both for the validation pages.
///
/// The standard error counts as at least 1e-6 of the expected value: triangles are traced in single
/// precision, and the start area of a beam is larger than the scene by 2^-20, so that a few paths
/// in a million miss their target.
[[nodiscard]] ::testing::AssertionResult holds(const Claim& claim, Measured m);
[[nodiscard]] ::testing::AssertionResult holds(const Claim& claim, const Estimate& estimate);

/// Tests that run in both directions of tracing, and with first hits.
class BothWays : public ::testing::TestWithParam<Method> {
  protected:
    [[nodiscard]] bool from_sources() const { return GetParam() != Method::from_organs; }
    /// The required resolution. First hits sample skies by pixels, along some hundred directions:
    /// good for many leaves, while every path hits a single plate.
    [[nodiscard]] double resolution(double usual, double by_pixels) const {
        return GetParam() == Method::first_hits ? by_pixels : usual;
    }
    [[nodiscard]] Result trace(
        const Scene& scene, const Sources& sources, std::uint64_t paths) const {
        return run(scene, sources, spec_of(GetParam(), paths));
    }
};

/// The name of a method in run files, for tests that are run with several.
[[nodiscard]] std::string name_of(const ::testing::TestParamInfo<Method>& info);

}  // namespace quasimc::test

/// Runs the tests of a suite of BothWays in both directions; long ones only in ./dev test --full.
#define QUASIMC_BOTH_WAYS(suite) QUASIMC_INSTANTIATE_WAYS(BothWays, suite)
#define QUASIMC_BOTH_WAYS_LONG(suite) QUASIMC_INSTANTIATE_WAYS(Long, suite)
#define QUASIMC_INSTANTIATE_WAYS(prefix, suite)                               \
    INSTANTIATE_TEST_SUITE_P(                                                 \
        prefix, suite,                                                        \
        ::testing::Values(                                                    \
            ::quasimc::Method::light_tracing, ::quasimc::Method::from_organs, \
            ::quasimc::Method::first_hits),                                   \
        ::quasimc::test::name_of)
