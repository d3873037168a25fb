#include "optics_testing.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace quasimc::test {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

double gauss(const DirectionFunction& f, const Vec3& n, const Patch& p) {
    constexpr std::array<double, 3> kNode{0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr std::array<double, 3> kWeight{5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double z = p.z0 + (p.z1 - p.z0) * kNode[i];
            const double t = p.t0 + (p.t1 - p.t0) * kNode[j];
            sum += kWeight[i] * kWeight[j] * f(direction_at(n, z, t));
        }
    }
    return sum * kTwoPi * (p.z1 - p.z0) * (p.t1 - p.t0);
}

std::array<Patch, 4> quarters(const Patch& p) {
    const double z = (p.z0 + p.z1) / 2;
    const double t = (p.t0 + p.t1) / 2;
    return {
        Patch{p.z0, z, p.t0, t}, Patch{p.z0, z, t, p.t1}, Patch{z, p.z1, p.t0, t},
        Patch{z, p.z1, t, p.t1}};
}

/// @param coarse  Gauss's rule on the patch as a whole
double refined(
    const DirectionFunction& f,
    const Vec3& n,
    const Patch& patch,
    double coarse,
    double tolerance,
    int depth) {
    const auto cells = quarters(patch);
    std::array<double, 4> parts{};
    std::transform(
        cells.begin(), cells.end(), parts.begin(), [&](const Patch& c) { return gauss(f, n, c); });
    const double fine = (parts[0] + parts[1]) + (parts[2] + parts[3]);
    if (std::abs(fine - coarse) < tolerance || depth == 0) {
        return fine;
    }
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        sum += refined(f, n, cells[i], parts[i], tolerance / 2, depth - 1);
    }
    return sum;
}

/// Cuts a patch until its parts have a probability below `most`.
void cut(
    const DirectionFunction& pdf,
    const Vec3& n,
    const Patch& patch,
    double most,
    std::vector<std::pair<Patch, double>>& bins) {
    constexpr double kTolerance = 1e-4;  // a tenth of the scatter of the counts
    const double probability = integral(pdf, n, patch, kTolerance);
    if (probability < most) {
        bins.emplace_back(patch, probability);
        return;
    }
    for (const Patch& cell : quarters(patch)) {
        cut(pdf, n, cell, most, bins);
    }
}

bool is_inside(const Patch& p, const HemispherePoint& at) {
    return at.z >= p.z0 && at.z < p.z1 && at.t >= p.t0 && at.t < p.t1;
}

}  // namespace

Vec3 direction_at(const Vec3& n, double z, double t) {
    const Frame frame = frame_about(n);
    const double sine = std::sqrt((1 - z) * (1 + z));
    return sine * std::cos(kTwoPi * t) * frame.s + sine * std::sin(kTwoPi * t) * frame.t + z * n;
}

HemispherePoint point_of(const Vec3& n, const Vec3& d) {
    const Frame frame = frame_about(n);
    const double turn = std::atan2(dot(d, frame.t), dot(d, frame.s)) / kTwoPi;
    const double t = turn < 0 ? turn + 1 : turn;
    return {std::min(dot(d, n), 1 - 1e-16), t < 1 ? t : 0};
}

double integral(const DirectionFunction& f, const Vec3& n, const Patch& patch, double tolerance) {
    constexpr int kDepth = 12;
    const double size = std::max(patch.z1 - patch.z0, patch.t1 - patch.t0);
    const int cells = std::max(2, static_cast<int>(std::lround(16 * size)));
    double sum = 0;
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const double dz = (patch.z1 - patch.z0) / cells;
            const double dt = (patch.t1 - patch.t0) / cells;
            const Patch cell{
                patch.z0 + i * dz, patch.z0 + (i + 1) * dz, patch.t0 + j * dt,
                patch.t0 + (j + 1) * dt};
            sum += refined(f, n, cell, gauss(f, n, cell), tolerance / cells, kDepth);
        }
    }
    return sum;
}

double sphere_integral(const DirectionFunction& f, const Vec3& n, double tolerance) {
    return integral(f, n, {}, tolerance) + integral(f, -n, {}, tolerance);
}

double chi_square_tail(double x, unsigned degrees_of_freedom) {
    // The incomplete gamma function by its series (small x) or continued fraction (large x):
    // Abramowitz and Stegun 6.5.29, 6.5.31.
    const double a = degrees_of_freedom / 2.0;
    const double half = x / 2;
    if (half <= 0) {
        return 1;
    }
    const double front = std::exp(a * std::log(half) - half - std::lgamma(a));
    if (half < a + 1) {
        double term = 1 / a;
        double sum = term;
        for (int k = 1; k < 10000 && term > 1e-17 * sum; ++k) {
            term *= half / (a + k);
            sum += term;
        }
        return 1 - front * sum;
    }
    double fraction = 0;
    for (int k = 1000; k > 0; --k) {
        fraction = k * (k - a) / (half + 2 * k + 1 - a - fraction);
    }
    return front / (half + 1 - a - fraction);
}

double chi_square_test(
    const DirectionFunction& pdf,
    const std::function<Vec3(double, double)>& sample,
    const Vec3& n,
    unsigned samples) {
    constexpr double kLargestBin = 1.0 / 30;
    constexpr double kSmallestCount = 10;
    std::vector<std::pair<Patch, double>> bins;
    cut(pdf, n, {}, kLargestBin, bins);

    std::vector<unsigned> counts(bins.size() + 1);
    Random random(12345);
    for (unsigned i = 0; i < samples; ++i) {
        const double u0 = random();
        const HemispherePoint at = point_of(n, sample(u0, random()));
        const auto bin = std::find_if(
            bins.begin(), bins.end(), [&](const auto& b) { return is_inside(b.first, at); });
        ++counts[static_cast<std::size_t>(bin - bins.begin())];
    }

    // Bins in which little is expected are thrown together with what fell outside all.
    double chi_square = 0;
    double rest = 1;
    double rest_count = samples;
    unsigned used = 0;
    for (std::size_t b = 0; b < bins.size(); ++b) {
        const double expected = bins[b].second * samples;
        if (expected >= kSmallestCount) {
            chi_square += (counts[b] - expected) * (counts[b] - expected) / expected;
            rest -= bins[b].second;
            rest_count -= counts[b];
            ++used;
        }
    }
    const double expected = std::max(rest * samples, 1.0);
    chi_square += (rest_count - expected) * (rest_count - expected) / expected;
    return chi_square_tail(chi_square, used);
}

void expect_density_at_samples(const Bsdf& bsdf, double largest, double power) {
    const auto [n, wi] = incidence_at(30);
    for (const double u0 : {0.0, 1e-9, 0.1, 0.5, 0.9, 0.999}) {
        const Vec3 wo = bsdf.sample(n, wi, u0, 0.3);
        EXPECT_NEAR(bsdf.pdf(n, wi, wo) / largest, std::pow(1 - u0, power), 1e-8) << "u0 " << u0;
    }
}

Incidence incidence_at(double theta_deg) {
    const double theta = theta_deg * std::numbers::pi / 180;
    const Vec3 n = normalized({0.3, -0.5, 0.8});
    const Frame frame = frame_about(n);
    const Vec3 tangent = std::cos(0.7) * frame.s + std::sin(0.7) * frame.t;
    return {n, std::sin(theta) * tangent - std::cos(theta) * n};
}

double smooth(int which, const Vec3& d) {
    const Vec3 off = d - normalized({0.5, 0.7, -0.2});
    switch (which) {
        case 0:
            return 1;
        case 1:
            return 1 + 0.5 * d.x - 0.3 * d.y + 0.2 * d.z;
        default:
            return std::exp(-dot(off, off));
    }
}

MaterialSpec varied_leaf(std::size_t bands, std::size_t exponents) {
    const std::array<std::string, 4> models = {"phong", "lambertian", "blinn_phong", "mirror"};
    MaterialSpec spec{"leaf", {}, {}};
    for (std::size_t b = 0; b < bands; ++b) {
        const auto x = static_cast<double>(b);
        const auto kind = static_cast<double>(b % exponents);
        spec.upper.push_back(
            {.reflectance = 0.3 + 0.2 * std::sin(x),
             .transmittance = 0.3 + 0.2 * std::cos(2 * x),
             .reflection_model = models[b % exponents % 4],
             .reflection_parameters = {{"exponent", 3 + 4 * kind}},
             .transmission_model = models[(b % exponents + 2) % 4],
             .transmission_parameters = {{"exponent", 20 / (1 + kind)}}});
        spec.lower.push_back(
            {.reflectance = 0.25 + 0.2 * std::cos(x),
             .transmittance = 0.4 + 0.1 * std::sin(3 * x),
             .reflection_model = models[(b + 1) % exponents % 4],
             .reflection_parameters = {{"exponent", 5 + 2 * kind}},
             .transmission_model = models[(b % exponents + 1) % 4],
             .transmission_parameters = {{"exponent", 1 + kind}}});
    }
    return spec;
}

std::vector<double> varied_weights(std::size_t bands) {
    std::vector<double> weights;
    for (std::size_t b = 0; b < bands; ++b) {
        weights.push_back(1 + 0.8 * std::sin(1 + 5 * static_cast<double>(b)));
    }
    return weights;
}

}  // namespace quasimc::test
