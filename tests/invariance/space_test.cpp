// The light does not depend on the unit of length, on where the scene lies, or on how its axes are
// named.

#include <cmath>

#include "invariance/plot.h"
#include "statistical/comparison.h"

namespace quasimc::test {
namespace {

class Space : public BothWays {
  protected:
    [[nodiscard]] Result trace_plot(
        const PlotSpec& plot, std::uint64_t paths, std::uint64_t seed = 1) const {
        RunSpec spec = spec_of(GetParam(), paths);
        spec.seed = seed;
        return run(make_plot(plot), plot_sources(plot), spec);
    }
};

/// Densities of the same bits, fluxes larger by the square of the scale.
::testing::AssertionResult differ_by_the_unit(const Result& a, Result b, double scale) {
    const auto rescale = [&](Estimate& e) {
        for (double* x : {&e.mean, &e.standard_error, &e.ci95_low, &e.ci95_high}) {
            *x /= scale * scale;
        }
    };
    for (std::size_t organ = 0; organ < b.organs(); ++organ) {
        for (std::size_t band = 0; band < b.bands; ++band) {
            rescale(b.values[organ * kQuantities * b.bands + band]);  // absorbed_flux
        }
    }
    for (BandBudget& budget : b.budget) {
        budget.emitted = scaled(budget.emitted, 1 / (scale * scale));
        for (Estimate* e :
             {&budget.absorbed_by_organs, &budget.absorbed_by_ground, &budget.escaped,
              &budget.cut_off, &budget.imbalance}) {
            rescale(*e);
        }
    }
    return have_the_same_bits(a, b);
}

TEST_P(Space, APowerOfTwoInTheUnitOfLengthChangesNoBit) {
    for (const bool periodic : {false, true}) {
        const Result metres = trace_plot({.periodic = periodic}, 1 << 10);
        for (const double scale : {0x1p-10, 0x1p10, 0x1p40}) {
            const Result other = trace_plot({.periodic = periodic, .scale = scale}, 1 << 10);
            EXPECT_TRUE(differ_by_the_unit(metres, other, scale)) << scale;
        }
    }
}

/// The same paths, but for those that pass an edge within rounding; and in whatever the paths
/// agree, so do the errors. Of first hits the same direct light: a pixel that turns out otherwise
/// moves all path vertices behind it on, to other numbers.
TEST_P(Space, MillimetresAndKilometresGiveTheSameLight) {
    std::vector<Quantity> compared{Quantity::incident_direct};
    if (GetParam() != Method::first_hits) {
        compared.push_back(Quantity::incident_scattered);
    }
    for (const bool periodic : {false, true}) {
        const Result metres = trace_plot({.periodic = periodic}, 1 << 12);
        for (const double scale : {1e-3, 1e3}) {
            const Result other = trace_plot({.periodic = periodic, .scale = scale}, 1 << 12);
            EXPECT_TRUE(are_nearly_identical(metres, other, 2e-3, compared)) << scale;
            Comparison comparison(1);
            EXPECT_TRUE(comparison.organs_agree(metres, other)) << scale;
        }
    }
}

TEST_P(Space, ASceneInMapCoordinatesReceivesTheSameLight) {
    for (const bool periodic : {false, true}) {
        const Result here = trace_plot({.periodic = periodic}, 1 << 12);
        const Result there =
            trace_plot({.periodic = periodic, .shift = {5e5, 5.4e6, 300}}, 1 << 12);
        EXPECT_TRUE(are_nearly_identical(here, there, 2e-3));
        Comparison comparison(2);
        EXPECT_TRUE(comparison.totals_agree(here, there));
        EXPECT_TRUE(comparison.organs_agree(here, there));
    }
}

TEST_P(Space, TurningSceneAndSunAboutTheVerticalChangesNothing) {
    const Result plain = trace_plot({}, 1 << 14);
    const Result turned = trace_plot({.turn_deg = 37}, 1 << 14, 2);
    Comparison comparison(1);
    EXPECT_TRUE(comparison.totals_agree(plain, turned));
    EXPECT_TRUE(comparison.organs_agree(plain, turned));
    EXPECT_TRUE(comparison.are_sharp(.05, .5));
}

TEST_P(Space, NamingTheUpAxisYChangesNoBit) {
    EXPECT_TRUE(
        have_the_same_bits(trace_plot({}, 1 << 10), trace_plot({.up = UpAxis::y}, 1 << 10)));
}

/// A control: other paths through the same scene are not nearly identical.
TEST_P(Space, APlotTurnedUnderTheSkyIsNotIdentical) {
    const Result plain = trace_plot({}, 1 << 12);
    EXPECT_FALSE(are_nearly_identical(plain, trace_plot({.turn_deg = 5}, 1 << 12), 2e-3));
}

QUASIMC_BOTH_WAYS(Space);

}  // namespace
}  // namespace quasimc::test
