#pragma once

#include <functional>
#include <string>
#include <vector>

#include "quasimc/run.h"
#include "scene/scene.h"
#include "statistical/scenes.h"

// A small scene in which there is some of everything, to be turned, moved and taken to pieces.

namespace quasimc::test {

inline constexpr std::size_t kPlotBands = 3;
inline constexpr std::size_t kPlotLeaves = 24;

/// What the plot is like, and what is done to it.
struct PlotSpec {
    /// Which of the three bands there are, and in which order.
    std::vector<std::size_t> bands{0, 1, 2};
    bool periodic = false;
    /// Where a point of the plot stands: p -> scale * p + shift.
    double scale = 1;
    Vec3 shift = {};
    /// Turned about the vertical, together with the sun.
    double turn_deg = 0;
    UpAxis up = UpAxis::z;
};

/// Leaves with lobes of all models, two sensors and a ground; organ i is leaf i, the ground last.
[[nodiscard]] Scene make_plot(const PlotSpec& spec);
/// The leaves as they are in the plot of the default PlotSpec.
[[nodiscard]] std::vector<Triangle> plot_leaves();
/// A shiny leaf, a matt one and the soil, in the given bands: "leaf", "matt", "soil".
[[nodiscard]] std::vector<MaterialSpec> plot_materials(const std::vector<std::size_t>& bands);

/// A sun, another one and a sky.
[[nodiscard]] Sources plot_sources(const PlotSpec& spec);

/// Whether all estimates are the same, bit by bit (NaN is the same as NaN).
[[nodiscard]] ::testing::AssertionResult have_the_same_bits(const Result& a, const Result& b);

/// Whether two runs of the same paths give nearly the same: the sum over the organs of the
/// differences of what falls on them is at most `relative` times that of the amounts.
[[nodiscard]] ::testing::AssertionResult are_nearly_identical(
    const Result& a,
    const Result& b,
    double relative,
    const std::vector<Quantity>& compared = {Quantity::incident_upper, Quantity::incident_lower});

/// The same result with bands[i] as its band i.
[[nodiscard]] Result with_bands(const Result& result, const std::vector<std::size_t>& bands);

}  // namespace quasimc::test
