#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "optics/bsdf.h"
#include "optics/material.h"
#include "support/statistics.h"

namespace quasimc::test {

/// Random numbers in [0, 1), the same on every machine.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  private:
    std::mt19937_64 engine_;
};

/// Mean and standard error of numbers that come one by one (Welford 1962).
class RunningMean {
  public:
    void add(double x) {
        ++count_;
        const double before = x - mean_;
        mean_ += before / count_;
        squares_ += before * (x - mean_);
    }
    [[nodiscard]] Measured measured() const {
        return {mean_, std::sqrt(squares_ / (count_ - 1.0) / count_), count_};
    }

  private:
    unsigned count_ = 0;
    double mean_ = 0, squares_ = 0;
};

/// A part of the hemisphere about a normal: |cosine| to the normal in [z0, z1), azimuth in turns in
/// [t0, t1). Its solid angle is 2 pi (z1 - z0) (t1 - t0).
struct Patch {
    double z0 = 0, z1 = 1, t0 = 0, t1 = 1;
};

/// The direction at (z, t) of the hemisphere about `n`.
[[nodiscard]] Vec3 direction_at(const Vec3& n, double z, double t);

/// The (z, t) of a direction on the side of `n`.
struct HemispherePoint {
    double z, t;
};
[[nodiscard]] HemispherePoint point_of(const Vec3& n, const Vec3& d);

using DirectionFunction = std::function<double(const Vec3&)>;

/// The integral over solid angle of f over a part of the hemisphere about `n`, within about
/// `tolerance`: Gauss's rule of 3 x 3 points, cells halved both ways until it converges. Steps
/// and narrow peaks (1 degree) are found.
[[nodiscard]] double integral(
    const DirectionFunction& f, const Vec3& n, const Patch& patch, double tolerance);

/// The integral over both hemispheres.
[[nodiscard]] double sphere_integral(const DirectionFunction& f, const Vec3& n, double tolerance);

/// The chance that a chi-square variable exceeds `x`.
[[nodiscard]] double chi_square_tail(double x, unsigned degrees_of_freedom);

/// The tail probability of Pearson's test of a sampler of directions on the side of `n` against a
/// density; the hemisphere is cut into patches of comparable probability, as fine as the density
/// is.
[[nodiscard]] double chi_square_test(
    const DirectionFunction& pdf,
    const std::function<Vec3(double, double)>& sample,
    const Vec3& n,
    unsigned samples);

/// Expects the density at samples to follow from u0: pdf = largest (1 - u0)^power. So it is for a
/// lobe of cos^n as long as it keeps away from the surface.
void expect_density_at_samples(const Bsdf& bsdf, double largest, double power);

/// The unit normal from which light at an angle arrives, and that light.
struct Incidence {
    Vec3 n, wi;
};
[[nodiscard]] Incidence incidence_at(double theta_deg);

/// A smooth function of direction that is not symmetric in any way.
[[nodiscard]] double smooth(int which, const Vec3& d);
inline constexpr int kSmoothFunctions = 3;

/// A leaf of `bands` bands whose reflectance, transmittance and exponents all vary with the band,
/// with at most `exponents` different ones, and whose sides differ. All models occur.
[[nodiscard]] MaterialSpec varied_leaf(std::size_t bands, std::size_t exponents);

/// Weights that differ between the bands.
[[nodiscard]] std::vector<double> varied_weights(std::size_t bands);

}  // namespace quasimc::test
