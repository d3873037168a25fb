#include "light/models/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/checks.h"
#include "base/distribution.h"

namespace quasimc {
namespace {

using std::numbers::pi;

constexpr double kLongestStep = pi / 90;

/// Five-point Gauss-Legendre nodes and weights on [-1, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 5> kNodes{
    -0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, 5> kWeights{
    0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
    0.2369268850561891};

/// The integral of the intensity over theta in [t0, t1], phi in [p0, p1].
double integral_over(
    const Pattern::Intensity& intensity, double t0, double t1, double p0, double p1) {
    double sum = 0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
        const double theta = 0.5 * (t0 + t1) + 0.5 * (t1 - t0) * kNodes[i];
        for (std::size_t j = 0; j < kNodes.size(); ++j) {
            const double phi = 0.5 * (p0 + p1) + 0.5 * (p1 - p0) * kNodes[j];
            sum += kWeights[i] * kWeights[j] * std::sin(theta) * intensity(theta, phi);
        }
    }
    return 0.25 * (t1 - t0) * (p1 - p0) * sum;
}

/// (1 - cos theta) / 2: uniform in solid angle, exact near the axis.
double versine(double theta) {
    const double half = std::sin(0.5 * theta);
    return half * half;
}

}  // namespace

/// A pattern and the table for sampling directions.
struct Pattern::Cells {
    Intensity intensity;
    std::vector<double> rows;  // (1 - cos theta) / 2 at the borders of the rows of cells
    std::vector<double> phis;
    std::vector<double> mass;  // [row][column] share of the light in the cell
    PiecewiseConstant2D table;
    double low = 0, high = 0;  // theta at the ends

    [[nodiscard]] std::size_t columns() const { return phis.size() - 1; }
};

Pattern::Pattern(
    Intensity intensity, const std::vector<double>& thetas, const std::vector<double>& phis) {
    EXPECT(thetas.size() >= 2 && phis.size() >= 2);
    Cells cells{std::move(intensity), {}, phis, {}, {}, thetas.front(), thetas.back()};
    for (const double theta : thetas) {
        cells.rows.push_back(versine(theta));
    }
    for (std::size_t i = 0; i + 1 < thetas.size(); ++i) {
        for (std::size_t j = 0; j + 1 < phis.size(); ++j) {
            cells.mass.push_back(
                integral_over(cells.intensity, thetas[i], thetas[i + 1], phis[j], phis[j + 1]));
        }
    }
    cells.table = PiecewiseConstant2D(cells.mass, cells.columns());
    EXPECT(cells.table.total() > 0);
    for (double& share : cells.mass) {
        share /= cells.table.total();
    }
    cells_ = std::make_shared<const Cells>(std::move(cells));
}

double Pattern::total() const {
    return cells_->table.total();
}

double Pattern::intensity(const Vec3& direction) const {
    const double theta = std::atan2(std::hypot(direction.x, direction.y), direction.z);
    if (theta < cells_->low || theta > cells_->high) {
        return 0;
    }
    const double phi = std::atan2(direction.y, direction.x);
    return cells_->intensity(theta, phi < 0 ? phi + 2 * pi : phi) / total();
}

std::vector<double> Pattern::parameters() const {
    std::vector<double> values{total(), cells_->low, cells_->high};
    for (const std::vector<double>* part : {&cells_->rows, &cells_->phis, &cells_->mass}) {
        values.insert(values.end(), part->begin(), part->end());
    }
    return values;
}

Pattern::Drawn Pattern::draw(double u0, double u1) const {
    const Cells& cells = *cells_;
    const auto [row, column] = cells.table.pick(u0, u1);
    const double height = cells.rows[row.index + 1] - cells.rows[row.index];
    const double width = cells.phis[column.index + 1] - cells.phis[column.index];
    const double t = cells.rows[row.index] + row.part * height;
    const double phi = cells.phis[column.index] + column.part * width;
    const double sine = 2 * std::sqrt(std::max(0.0, t * (1 - t)));
    const double theta = 2 * std::asin(std::sqrt(std::min(1.0, t)));
    const double solid_angle = 2 * height * width;
    return {
        {sine * std::cos(phi), sine * std::sin(phi), 1 - 2 * t},
        cells.intensity(theta, phi) / total() * solid_angle /
            cells.mass[row.index * cells.columns() + column.index]};
}

std::vector<double> refined(const std::vector<double>& borders, double longest, int least) {
    std::vector<double> fine;
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        const double width = borders[i + 1] - borders[i];
        const int pieces = std::max(least, static_cast<int>(std::ceil(width / longest)));
        for (int k = 0; width > 0 && k < pieces; ++k) {
            fine.push_back(borders[i] + width * k / pieces);
        }
    }
    fine.push_back(borders.back());
    return fine;
}

Pattern isotropic_pattern() {
    return {[](double, double) { return 1.0; }, refined({0, pi}, kLongestStep, 1), {0, 2 * pi}};
}

Pattern cosine_pattern() {
    return power_cosine_pattern(1);
}

Pattern power_cosine_pattern(double exponent) {
    // Rows of equal light: equal steps of 1 - cos^(n+1) theta.
    constexpr int kRows = 64;
    std::vector<double> thetas;
    for (int k = 0; k < kRows; ++k) {
        const double rest = 1 - static_cast<double>(k) / kRows;
        const double sine2 = -std::expm1(2 / (exponent + 1) * std::log(rest));
        thetas.push_back(std::asin(std::sqrt(sine2)));
    }
    thetas.push_back(pi / 2);
    return {
        [exponent](double theta, double) {
            return std::pow(std::max(0.0, std::cos(theta)), exponent);
        },
        refined(thetas, kLongestStep, 1),
        {0, 2 * pi}};
}

Pattern spot_pattern(double inner, double outer) {
    EXPECT(inner >= 0 && inner <= outer && outer > 0);
    constexpr int kLeast = 16;
    return {
        [inner, outer](double theta, double) {
            if (theta <= inner) {
                return 1.0;
            }
            const double x = (outer - theta) / (outer - inner);
            return x > 0 ? x * x * (3 - 2 * x) : 0.0;
        },
        refined({0, inner, outer}, kLongestStep, kLeast),
        {0, 2 * pi}};
}

Pattern tube_pattern() {
    return {
        [](double theta, double) { return std::sin(theta); },
        refined({0, pi}, kLongestStep, 1),
        {0, 2 * pi}};
}

}  // namespace quasimc
