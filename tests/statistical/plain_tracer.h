#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "quasimc/mesh.h"
#include "support/statistics.h"

namespace quasimc::test {

/// A path tracer that shares no code with the program, to compare it with: every ray is tested
/// against every triangle in double precision, and light is followed from the sources with
/// pseudo-random numbers until a surface absorbs it or it leaves.

/// Lambertian surfaces; upper side first.
struct PlainTriangle {
    Triangle corners = {};
    std::size_t organ = 0;
    std::array<double, 2> reflectance = {}, transmittance = {};
};

/// A sensor that averages over a disk, within one cell.
struct PlainDisk {
    Vec3 center, normal;
    double radius = 0;
    double least_cosine = 0;
};

struct PlainScene {
    std::vector<PlainTriangle> triangles;
    std::vector<PlainDisk> disks;
    /// Size of a cell [0, size]^2 that repeats along x and y; no triangle crosses its borders.
    std::optional<double> cell = {};
};

using Random = std::mt19937_64;

struct PlainRay {
    Vec3 origin, direction;
};

struct PlainSource {
    double flux = 0;  ///< carried by all rays together
    std::function<PlainRay(Random&)> emit;
};

/// A sphere that holds a scene.
struct Ball {
    Vec3 center;
    double radius = 0;
};

/// Parallel light over the disk in which it meets a ball.
[[nodiscard]] PlainSource plain_sun(const Ball& ball, const Vec3& direction, double facing);
/// A uniform sky, by a disk for each direction.
[[nodiscard]] PlainSource plain_sky(const Ball& ball, double horizontal);
/// A point that radiates equally in all directions.
[[nodiscard]] PlainSource plain_lamp(const Vec3& position, double flux);
/// The same suns and skies over a cell, from a height above all surfaces.
[[nodiscard]] PlainSource plain_sun_over(
    double cell, double height, const Vec3& direction, double facing);
[[nodiscard]] PlainSource plain_sky_over(double cell, double height, double horizontal);

/// The light on an organ or a sensor, flux.
enum class Part { upper, lower, direct, scattered, absorbed };
inline constexpr std::size_t kParts = 5;
using PlainLight = std::array<double, kParts>;

/// One replicate: organs (one more than the largest PlainTriangle::organ), then disks.
[[nodiscard]] std::vector<PlainLight> trace_plainly(
    const PlainScene& scene, const PlainSource& source, std::size_t paths, Random& random);

}  // namespace quasimc::test
