#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/scene.h"
#include "stress/nodes.h"
#include "stress/random.h"

// The reference: light tracing that tests all triangles one by one, in double precision, with
// random numbers. It shares with the program the reader of shapes and orientations and the cutting
// of coplanar overlaps, but not rays, sources, lobes or sums.

namespace quasimc::stress {

/// A source of paths: a flux per band, and a ray for every path.
struct Emitter {
    enum class Kind {
        beam,
        cone,
        uniform_sky,
        overcast_sky,
        point,
        spot,
        rectangle,
        disk,
        line,
        sphere
    };
    Kind kind = Kind::beam;
    std::vector<double> amount;  ///< given irradiance, or flux of a lamp; per band
    Vec3 direction;              ///< direction of travel; for a cone that of its axis
    double angle = 0;            ///< half angle of a cone, radians
    double exponent = 0;         ///< exponent of a spot
    Vec3 position;               ///< position of a lamp
    Frame axes;                  ///< axes of a lamp, which aims along n
    double length = 0, width = 0, radius = 0;
};

/// One side of a material: Lambertian, mirror, or transmission without scattering.
struct PlainSide {
    std::vector<double> rho, tau;  ///< per band
    bool reflects_as_mirror = false, passes_straight = false;
};

struct PlainTriangle {
    Vec3 corner, edge_a, edge_b, normal;
    std::uint32_t organ = 0;
};

/// A scene for the reference.
struct PlainScene {
    std::size_t bands = 1;
    std::vector<PlainTriangle> triangles;
    std::vector<std::array<PlainSide, 2>> materials;  ///< per organ: upper, lower side
    std::vector<double> least_cosine;                 ///< per organ
    std::vector<Emitter> emitters;
    Cell cell;
    Bounds bounds;
    bool ignores_direct = false;
    std::uint32_t max_depth = 0;
};

/// The scene of a run file, if the reference supports it: Lambertian, mirroring and clear surfaces;
/// suns, uniform and overcast skies, lamps; open, or periodic along both axes.
[[nodiscard]] std::optional<PlainScene> plain_scene(const Node& document, const Scene& scene);

/// Emitters of a document; empty if the reference does not support one of them.
[[nodiscard]] std::optional<std::vector<Emitter>> emitters_of(
    const Node& document, const Scene& scene);

struct StartedRay {
    Vec3 origin, direction;
    double weight = 1;  ///< weight of this path in the emitter's flux, per unit of its amount
};
/// The start of a path.
[[nodiscard]] StartedRay start_ray(const Emitter& emitter, const PlainScene& scene, Random& random);

/// Sums of one replicate, flux: [(organ * 2 + side) * bands + band].
struct PlainSums {
    std::vector<double> direct, scattered;
    std::vector<double> absorbed;        ///< [organ * bands + band]
    std::vector<double> brightest_path;  ///< per band: largest contribution of one path
};

/// Follows `paths` paths from every source.
[[nodiscard]] PlainSums trace_plainly(
    const PlainScene& scene, std::uint64_t paths, std::uint64_t seed);

}  // namespace quasimc::stress
