#include "unit/light/hemisphere_testing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/skies.h"
#include "unit/samplers/sampler_testing.h"

namespace quasimc::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr std::array kNodes{
    -0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
constexpr std::array kWeights{
    0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
    0.2369268850561891};

/// Adds borders around `border`, each half as far from it as the one before.
void grade(std::vector<double>& borders, double border, double low, double high) {
    borders.push_back(border);
    for (double step = .5; step > 3e-4; step /= 3) {
        for (const double x : {border - step, border + step}) {
            if (x > low && x < high) {
                borders.push_back(x);
            }
        }
    }
}

double gauss(
    const std::function<double(const Vec3&)>& f, double a0, double a1, double s0, double s1) {
    double sum = 0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        for (std::size_t j = 0; j < kNodes.size(); ++j) {
            sum += kWeights[i] * kWeights[j] *
                   f(upward(
                       .5 * (a0 + a1 + (a1 - a0) * kNodes[i]),
                       .5 * (s0 + s1 + (s1 - s0) * kNodes[j])));
        }
    }
    return sum * .25 * (a1 - a0) * (s1 - s0);
}

}  // namespace

Vec3 upward(double azimuth, double sine) {
    const double flat = std::sqrt(1 - sine * sine);
    return {flat * std::cos(azimuth), flat * std::sin(azimuth), sine};
}

GradedMesh::GradedMesh(
    std::span<const double> extra_azimuths, std::span<const double> extra_sines) {
    azimuths = {0, kTurn};
    sines = {0, 1};
    grade(azimuths, std::atan2(sun_at(0).y, sun_at(0).x), 0, kTurn);
    grade(sines, 0, 0, 1);
    grade(sines, 1, 0, 1);
    for (const double elevation : {8.0, 65.0}) {
        grade(sines, sun_at(elevation).z, 0, 1);
    }
    for (int i = 1; i < 12; ++i) {
        azimuths.push_back(kTurn * i / 12);
    }
    for (int i = 1; i < 8; ++i) {
        sines.push_back(i / 8.0);
    }
    for (const double azimuth : extra_azimuths) {
        azimuths.push_back(azimuth - kTurn * std::floor(azimuth / kTurn));
    }
    sines.insert(sines.end(), extra_sines.begin(), extra_sines.end());
    std::sort(azimuths.begin(), azimuths.end());
    std::sort(sines.begin(), sines.end());
}

double GradedMesh::integral(const std::function<double(const Vec3&)>& f) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < azimuths.size(); ++i) {
        for (std::size_t j = 0; j + 1 < sines.size(); ++j) {
            sum += gauss(f, azimuths[i], azimuths[i + 1], sines[j], sines[j + 1]);
        }
    }
    return sum;
}

::testing::AssertionResult follow(
    std::span<const WeightedDirection> draws,
    const std::function<double(const Vec3&)>& density,
    const GradedMesh& mesh,
    double level) {
    constexpr std::size_t kColumns = 12;
    constexpr std::size_t kRows = 8;
    constexpr std::size_t kCells = kColumns * kRows;
    const auto cell_of = [](double azimuth, double sine) {
        const double turned = azimuth / kTurn - std::floor(azimuth / kTurn);
        const auto column = std::min(kColumns - 1, static_cast<std::size_t>(turned * kColumns));
        const auto row = std::min(kRows - 1, static_cast<std::size_t>(sine * kRows));
        return row * kColumns + column;
    };
    std::array<double, kCells> expected{};
    for (std::size_t i = 0; i + 1 < mesh.azimuths.size(); ++i) {
        for (std::size_t j = 0; j + 1 < mesh.sines.size(); ++j) {
            const double a0 = mesh.azimuths[i], a1 = mesh.azimuths[i + 1];
            const double s0 = mesh.sines[j], s1 = mesh.sines[j + 1];
            expected[cell_of(.5 * (a0 + a1), .5 * (s0 + s1))] += gauss(density, a0, a1, s0, s1);
        }
    }
    std::array<double, kCells> sums{};
    std::array<double, kCells> squares{};
    for (const WeightedDirection& draw : draws) {
        const std::size_t cell =
            cell_of(std::atan2(draw.direction.y, draw.direction.x), draw.direction.z);
        sums[cell] += draw.weight;
        squares[cell] += draw.weight * draw.weight;
    }
    const auto n = static_cast<double>(draws.size());
    double chi_square = 0;
    double cells = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
        const double mean = sums[i] / n;
        const double error = std::sqrt((squares[i] / n - mean * mean) / n);
        if (error > 0) {
            chi_square += std::pow((mean - expected[i]) / error, 2);
            cells += 1;
        } else if (expected[i] > 0) {
            return ::testing::AssertionFailure() << "nothing was drawn in cell " << i;
        }
    }
    // Wilson and Hilferty (1931).
    const double z =
        (std::cbrt(chi_square / cells) - (1 - 2 / (9 * cells))) / std::sqrt(2 / (9 * cells));
    return (z <= normal_upper_quantile(level) ? ::testing::AssertionSuccess()
                                              : ::testing::AssertionFailure())
           << "chi-square " << chi_square << " of " << cells << " cells";
}

}  // namespace quasimc::test
