#include "quasimc/sources/hemisphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "quasimc/base/checks.h"

namespace quasimc {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kColumns = 64;
constexpr int kRows = 32;

/// Sorted, those nearer to the one before than `least` left out (never the first nor the last).
std::vector<double> distinct(std::vector<double> values, double least) {
    std::sort(values.begin(), values.end());
    std::vector<double> kept{values.front()};
    for (const double x : values) {
        if (x - kept.back() > least) {
            kept.push_back(x);
        }
    }
    kept.back() = values.back();
    return kept;
}

/// Part of a cell.
struct Patch {
    double azimuth0, azimuth1, sine0, sine1;
};

/// Nodes and weights of Gauss and Legendre on [-1, 1].
template <std::size_t N>
struct GaussRule {
    std::array<double, N> nodes, weights;
};
constexpr GaussRule<3> kThree{
    {-0.77459666924148337704, 0, 0.77459666924148337704}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
constexpr GaussRule<4> kFour{
    {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
     0.86113631159405257522},
    {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
     0.34785484513745385737}};

/// The integral over a patch by N x N points.
template <std::size_t N>
double gauss(const GaussRule<N>& rule, const HemisphereFunction& f, const Patch& p) {
    const double azimuth = 0.5 * (p.azimuth0 + p.azimuth1);
    const double sine = 0.5 * (p.sine0 + p.sine1);
    const double half_azimuth = 0.5 * (p.azimuth1 - p.azimuth0);
    const double half_sine = 0.5 * (p.sine1 - p.sine0);
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < N; ++j) {
            sum += rule.weights[i] * rule.weights[j] *
                   f(hemisphere_direction(
                       azimuth + half_azimuth * rule.nodes[j], sine + half_sine * rule.nodes[i]));
        }
    }
    return sum * half_azimuth * half_sine;
}

/// Quarters a patch until 3 x 3 and 4 x 4 points agree within `tolerance`.
double integrate(const HemisphereFunction& f, const Patch& p, double tolerance, int depth) {
    const double value = gauss(kFour, f, p);
    constexpr int kDeepest = 8;
    if (depth == kDeepest || std::abs(value - gauss(kThree, f, p)) <= tolerance) {
        return value;
    }
    const double azimuth = 0.5 * (p.azimuth0 + p.azimuth1);
    const double sine = 0.5 * (p.sine0 + p.sine1);
    const std::array<Patch, 4> parts{
        {{p.azimuth0, azimuth, p.sine0, sine},
         {azimuth, p.azimuth1, p.sine0, sine},
         {p.azimuth0, azimuth, sine, p.sine1},
         {azimuth, p.azimuth1, sine, p.sine1}}};
    double sum = 0;
    for (const Patch& part : parts) {
        sum += integrate(f, part, 0.5 * tolerance, depth + 1);
    }
    return sum;
}

/// The first place whose running sum exceeds u, and how far u is into it.
struct Pick {
    std::size_t index;
    double rest;   ///< 0 to below 1
    double share;  ///< of the place
};
Pick pick(std::span<const double> ends, double u) {
    const auto found = std::upper_bound(ends.begin(), ends.end() - 1, u);
    const auto index = static_cast<std::size_t>(found - ends.begin());
    const double before = index == 0 ? 0 : ends[index - 1];
    const double share = ends[index] - before;
    return {index, std::clamp((u - before) / share, 0.0, 0x1.fffffffffffffp-1), share};
}

/// Running sums, scaled so that the last is 1; all the same if nothing is to be shared.
void accumulate(std::span<const double> shares, std::span<double> ends) {
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        sum += shares[i];
        ends[i] = sum;
    }
    for (double& end : ends) {
        end = sum > 0 ? end / sum : 1;
    }
}

}  // namespace

Vec3 hemisphere_direction(double azimuth, double sine) {
    const double radius = std::sqrt(std::max(0.0, (1 - sine) * (1 + sine)));
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), sine};
}

HemisphereGrid make_hemisphere_grid(
    std::span<const double> azimuths, std::span<const double> sines) {
    constexpr double kLeast = 1e-9;
    std::vector<double> columns{0, kTurn};
    for (const double azimuth : azimuths) {
        columns.push_back(azimuth - kTurn * std::floor(azimuth / kTurn));
    }
    const bool is_coarse = azimuths.size() < kColumns;
    const int steps = is_coarse ? kColumns : 4;
    for (int i = 1; i < steps; ++i) {
        columns.push_back(kTurn * i / steps);
    }
    std::vector<double> rows{0, 1};
    rows.insert(rows.end(), sines.begin(), sines.end());
    // Equal steps of elevation.
    for (int i = 1; sines.size() < kRows && i < kRows; ++i) {
        rows.push_back(std::sin(std::numbers::pi / 2 * i / kRows));
    }
    return {distinct(std::move(columns), kLeast), distinct(std::move(rows), kLeast)};
}

std::vector<double> cell_integrals(const HemisphereGrid& grid, const HemisphereFunction& f) {
    std::vector<Patch> patches;
    patches.reserve(grid.cells());
    double sum = 0;
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            patches.push_back(
                {grid.azimuths[column], grid.azimuths[column + 1], grid.sines[row],
                 grid.sines[row + 1]});
            sum += std::abs(gauss(kThree, f, patches.back()));
        }
    }
    constexpr double kAccuracy = 1e-7;
    const double tolerance = kAccuracy * sum / static_cast<double>(grid.cells());
    std::vector<double> integrals;
    integrals.reserve(grid.cells());
    for (const Patch& patch : patches) {
        integrals.push_back(integrate(f, patch, tolerance, 0));
    }
    return integrals;
}

HemisphereSampler::HemisphereSampler(HemisphereGrid grid, std::span<const double> shares)
    : grid_(std::move(grid)), row_ends_(grid_.rows()), column_ends_(grid_.cells()) {
    EXPECT(shares.size() == grid_.cells());
    std::vector<double> rows(grid_.rows());
    for (std::size_t row = 0; row < grid_.rows(); ++row) {
        const auto own = shares.subspan(row * grid_.columns(), grid_.columns());
        for (const double share : own) {
            rows[row] += share;
        }
        accumulate(own, std::span(column_ends_).subspan(row * grid_.columns(), grid_.columns()));
    }
    accumulate(rows, row_ends_);
}

HemisphereSampler::Sample HemisphereSampler::sample(double u0, double u1) const {
    const Pick row = pick(row_ends_, u0);
    const Pick column = pick({&column_ends_[row.index * grid_.columns()], grid_.columns()}, u1);
    const double sine0 = grid_.sines[row.index];
    const double sine1 = grid_.sines[row.index + 1];
    const double azimuth0 = grid_.azimuths[column.index];
    const double azimuth1 = grid_.azimuths[column.index + 1];
    const double sine = sine0 + row.rest * (sine1 - sine0);
    const double azimuth = azimuth0 + column.rest * (azimuth1 - azimuth0);
    const double solid_angle = (sine1 - sine0) * (azimuth1 - azimuth0);
    return {hemisphere_direction(azimuth, sine), row.share * column.share / solid_angle};
}

}  // namespace quasimc
