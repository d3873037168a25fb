#include "light/models/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/checks.h"

namespace quasimc {
namespace {

constexpr int kColumns = 64;
constexpr int kElevationRows = 32;

/// Sorted values without those closer than `least` to their predecessor (the first and last stay).
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

}  // namespace

Vec3 hemisphere_direction(double azimuth, double sine) {
    const double radius = std::sqrt(std::max(0.0, (1 - sine) * (1 + sine)));
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), sine};
}

Vec3 upward_cosine_direction(double u0, double u1) {
    const double radius = std::sqrt(u0);
    const double around = kFullTurn * u1;
    return {radius * std::cos(around), radius * std::sin(around), std::sqrt(std::max(0.0, 1 - u0))};
}

Vec3 cosine_direction_about(const Vec3& axis, double u0, double u1) {
    const Frame frame = frame_about(axis);
    const Vec3 d = upward_cosine_direction(u0, u1);
    return d.x * frame.s + d.y * frame.t + d.z * axis;
}

Vec3 HemisphereGrid::middle(std::size_t row, std::size_t column) const {
    return hemisphere_direction(
        0.5 * (azimuths[column] + azimuths[column + 1]), 0.5 * (sines[row] + sines[row + 1]));
}

HemisphereGrid make_hemisphere_grid(
    std::span<const double> azimuths, std::span<const double> sines) {
    constexpr double kLeast = 1e-9;
    std::vector<double> columns{0, kFullTurn};
    for (const double azimuth : azimuths) {
        columns.push_back(azimuth - kFullTurn * std::floor(azimuth / kFullTurn));
    }
    const bool is_coarse = azimuths.size() < kColumns;
    const int steps = is_coarse ? kColumns : 4;
    for (int i = 1; i < steps; ++i) {
        columns.push_back(kFullTurn * i / steps);
    }
    std::vector<double> rows{0, 1};
    rows.insert(rows.end(), sines.begin(), sines.end());
    // Equal steps of elevation.
    for (int i = 1; sines.size() < kElevationRows && i < kElevationRows; ++i) {
        rows.push_back(std::sin(std::numbers::pi / 2 * i / kElevationRows));
    }
    return {distinct(std::move(columns), kLeast), distinct(std::move(rows), kLeast)};
}

std::vector<double> radiance_of_cells(const HemisphereGrid& grid, const HemisphereFunction& f) {
    struct Turned {
        double cosine, sine;
    };
    std::vector<Turned> turns;
    for (std::size_t column = 0; column < grid.columns(); ++column) {
        const double azimuth = 0.5 * (grid.azimuths[column] + grid.azimuths[column + 1]);
        turns.push_back({std::cos(azimuth), std::sin(azimuth)});
    }
    std::vector<double> values;
    values.reserve(grid.cells());
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        const double sine = 0.5 * (grid.sines[row] + grid.sines[row + 1]);
        const double radius = std::sqrt((1 - sine) * (1 + sine));
        for (const Turned& turn : turns) {
            values.push_back(f({radius * turn.cosine, radius * turn.sine, sine}));
        }
    }
    return values;
}

ProjectedCells::ProjectedCells(const HemisphereGrid& grid) {
    const auto flat = [](double s) {
        return 0.5 * (s * std::sqrt((1 - s) * (1 + s)) + std::asin(s));
    };
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        const double low = grid.sines[row];
        const double high = grid.sines[row + 1];
        rows_.push_back({flat(high) - flat(low), 0.5 * (high - low) * (high + low)});
    }
    for (std::size_t column = 0; column < grid.columns(); ++column) {
        const double from = grid.azimuths[column];
        const double until = grid.azimuths[column + 1];
        columns_.push_back(
            {std::abs(std::sin(until) - std::sin(from)), std::abs(std::cos(until) - std::cos(from)),
             until - from});
    }
}

HemisphereSampler::HemisphereSampler(HemisphereGrid grid, std::span<const double> shares)
    : grid_(std::move(grid)), cells_(shares, grid_.columns()) {
    EXPECT(shares.size() == grid_.cells());
}

HemisphereSampler::Sample HemisphereSampler::sample(double u0, double u1) const {
    const auto [row, column] = cells_.pick(u0, u1);
    const double sine0 = grid_.sines[row.index];
    const double sine1 = grid_.sines[row.index + 1];
    const double azimuth0 = grid_.azimuths[column.index];
    const double azimuth1 = grid_.azimuths[column.index + 1];
    const double sine = sine0 + row.part * (sine1 - sine0);
    const double azimuth = azimuth0 + column.part * (azimuth1 - azimuth0);
    const double solid_angle = (sine1 - sine0) * (azimuth1 - azimuth0);
    return {hemisphere_direction(azimuth, sine), row.width * column.width / solid_angle};
}

double HemisphereSampler::pdf(const Vec3& direction) const {
    if (direction.z < 0) {
        return 0;
    }
    const double around = std::atan2(direction.y, direction.x);
    const std::size_t row = interval_between(grid_.sines, direction.z);
    const std::size_t column =
        interval_between(grid_.azimuths, around < 0 ? around + kFullTurn : around);
    return cells_.probability(row, column) / grid_.solid_angle(row, column);
}

}  // namespace quasimc
