// Integrals of a sky by adaptive cubature in azimuth and elevation: the piece of the hemisphere
// with the largest error is halved, across the direction in which it is less smooth, until the
// errors of all pieces are small. A cusp at the sun or a gradient at the horizon is refined
// locally: some hundreds of pieces suffice, where a grid would need millions.
//
// Rule and error estimate: Genz and Malik (1980), "Remarks on algorithm 006: an adaptive algorithm
// for numerical integration over an n-dimensional rectangular region", J. Comput. Appl. Math. 6,
// 295-302: 17 points, of degree 7, with an embedded rule of degree 5.

#include "light/models/sky_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "light/models/hemisphere.h"

namespace quasimc {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
/// Tolerance of the sum of the pieces' estimated errors. These belong to the rule of degree 5: true
/// errors are fifty times smaller.
constexpr double kTolerance = 2e-6;
constexpr std::size_t kMaxPieces = 20000;

double sum_of(const Vec3& a) {
    return std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
}

/// The middle of a range and half of its width.
struct Interval {
    double middle = 0, half = 0;

    [[nodiscard]] Interval lower() const { return {middle - 0.5 * half, 0.5 * half}; }
    [[nodiscard]] Interval upper() const { return {middle + 0.5 * half, 0.5 * half}; }
};

/// The seven abscissas of the rule along a range: 0, then three pairs. Cosines and sines there.
struct Abscissas {
    std::array<double, 7> cosine{}, sine{};

    explicit Abscissas(const Interval& range) {
        static const std::array<double, 3> kAbscissas{
            std::sqrt(9.0 / 70), std::sqrt(9.0 / 10), std::sqrt(9.0 / 19)};
        cosine[0] = std::cos(range.middle);
        sine[0] = std::sin(range.middle);
        for (std::size_t i = 0; i < kAbscissas.size(); ++i) {
            const double c = std::cos(range.half * kAbscissas[i]);
            const double s = std::sin(range.half * kAbscissas[i]);
            cosine[2 * i + 1] = cosine[0] * c + sine[0] * s;
            sine[2 * i + 1] = sine[0] * c - cosine[0] * s;
            cosine[2 * i + 2] = cosine[0] * c - sine[0] * s;
            sine[2 * i + 2] = sine[0] * c + cosine[0] * s;
        }
    }
};

/// A piece of the hemisphere and its integral.
struct Piece {
    Interval azimuth, elevation;
    Vec3 integral;
    double error = 0;
    bool halve_azimuth = false;  ///< else the elevation
};

Piece integrate(const Radiance& radiance, const Interval& azimuth, const Interval& elevation) {
    const Abscissas across(azimuth);
    const Abscissas up(elevation);
    const auto at = [&](std::size_t i, std::size_t j) {
        const Vec3 d{up.cosine[j] * across.cosine[i], up.cosine[j] * across.sine[i], up.sine[j]};
        const double light = radiance(d) * up.cosine[j];  // solid angle: cos(elevation)
        return Vec3{light * std::abs(d.x), light * std::abs(d.y), light * d.z};
    };
    const Vec3 middle = at(0, 0);
    const Vec3 near_across = at(1, 0) + at(2, 0);
    const Vec3 near_up = at(0, 1) + at(0, 2);
    const Vec3 far_across = at(3, 0) + at(4, 0);
    const Vec3 far_up = at(0, 3) + at(0, 4);
    const Vec3 corners = at(3, 3) + at(3, 4) + at(4, 3) + at(4, 4);
    const Vec3 inner = at(5, 5) + at(5, 6) + at(6, 5) + at(6, 6);
    const Vec3 near = near_across + near_up;
    const Vec3 far = far_across + far_up;
    const Vec3 degree_seven = (-3816.0 / 19683) * middle + (980.0 / 6561) * near +
                              (1020.0 / 19683) * far + (200.0 / 19683) * corners +
                              (6859.0 / 78732) * inner;
    const Vec3 degree_five = (-971.0 / 729) * middle + (245.0 / 486) * near + (65.0 / 1458) * far +
                             (25.0 / 729) * corners;
    const double area = 4 * azimuth.half * elevation.half;
    // Fourth differences show which direction is less smooth.
    const auto roughness = [&](const Vec3& close, const Vec3& distant) {
        return sum_of(close - 2 * middle - (distant - 2 * middle) / 7);
    };
    return {
        azimuth, elevation, area * degree_seven, area * sum_of(degree_seven - degree_five),
        roughness(near_across, far_across) >= roughness(near_up, far_up)};
}

/// The initial pieces: between the borders of a shape, and between directions where a coordinate
/// changes its sign.
std::vector<Piece> first_pieces(const SkyShape& shape) {
    std::vector<double> azimuths{0, kQuarter, 2 * kQuarter, 3 * kQuarter, 4 * kQuarter};
    for (const double azimuth : shape.azimuths) {
        azimuths.push_back(azimuth - 4 * kQuarter * std::floor(azimuth / (4 * kQuarter)));
    }
    std::vector<double> elevations{0, kQuarter};
    for (const double sine : shape.sines) {
        elevations.push_back(std::asin(sine));
    }
    std::sort(azimuths.begin(), azimuths.end());
    std::sort(elevations.begin(), elevations.end());
    const auto between = [](const std::vector<double>& borders, std::size_t i) {
        return Interval{0.5 * (borders[i] + borders[i + 1]), 0.5 * (borders[i + 1] - borders[i])};
    };
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i + 1 < azimuths.size(); ++i) {
        for (std::size_t j = 0; j + 1 < elevations.size(); ++j) {
            pieces.push_back(
                integrate(shape.radiance, between(azimuths, i), between(elevations, j)));
        }
    }
    return pieces;
}

Vec3 smooth_integral(const SkyShape& shape) {
    const auto smaller = [](const Piece& a, const Piece& b) { return a.error < b.error; };
    std::vector<Piece> heap = first_pieces(shape);
    std::make_heap(heap.begin(), heap.end(), smaller);
    double sum = 0;
    double error = 0;
    for (const Piece& piece : heap) {
        sum += piece.integral.z;
        error += piece.error;
    }
    const std::size_t most = std::max(kMaxPieces, 2 * heap.size());
    while (error > kTolerance * sum && heap.size() < most) {
        std::pop_heap(heap.begin(), heap.end(), smaller);
        const Piece whole = heap.back();
        heap.pop_back();
        const auto add_part = [&](const Interval& azimuth, const Interval& elevation) {
            heap.push_back(integrate(shape.radiance, azimuth, elevation));
            sum += heap.back().integral.z;
            error += heap.back().error;
            std::push_heap(heap.begin(), heap.end(), smaller);
        };
        const bool across = whole.halve_azimuth;
        add_part(
            across ? whole.azimuth.lower() : whole.azimuth,
            across ? whole.elevation : whole.elevation.lower());
        add_part(
            across ? whole.azimuth.upper() : whole.azimuth,
            across ? whole.elevation : whole.elevation.upper());
        sum -= whole.integral.z;
        error -= whole.error;
    }
    Vec3 integral;
    for (const Piece& piece : heap) {
        integral += piece.integral;
    }
    return integral;
}

/// Closed forms, cell by cell.
Vec3 stepped_integral(const SkyShape& shape) {
    const HemisphereGrid grid = make_hemisphere_grid(shape.azimuths, shape.sines);
    const std::vector<double> radiance = radiance_of_cells(grid, shape.radiance);
    const ProjectedCells projected(grid);
    Vec3 integral;
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            integral += radiance[row * grid.columns() + column] * projected.integral(row, column);
        }
    }
    return integral;
}

}  // namespace

Vec3 projected_radiance(const SkyShape& shape) {
    return shape.inside == InsideCells::constant ? stepped_integral(shape) : smooth_integral(shape);
}

}  // namespace quasimc
