#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/scene.h"
#include "stress/nodes.h"
#include "stress/random.h"

// The yardstick: light followed from its sources through all triangles, one by one, in double
// precision, with plain random numbers. It shares with the program the reader of shapes and
// orientations, and what it cuts where surfaces coincide; not its rays, sources, lobes or sums.

namespace quasimc::stress {

/// A source as light that starts: a flux per band, and a ray for every path.
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
    std::vector<double> amount;  ///< irradiance as stated, or flux of a lamp; per band
    Vec3 direction;              ///< of travel; of a cone that of its axis
    double angle = 0;            ///< of a cone, radians
    double exponent = 0;         ///< of a spot
    Vec3 position;               ///< of a lamp
    Frame axes;                  ///< of a lamp; it aims along n
    double length = 0, width = 0, radius = 0;
};

/// What one side of a material does, by the cosine law or straight on.
struct PlainSide {
    std::vector<double> rho, tau;  ///< per band
    bool reflects_as_mirror = false, passes_straight = false;
};

struct PlainTriangle {
    Vec3 corner, edge_a, edge_b, normal;
    std::uint32_t organ = 0;
};

/// A scene that the reference can follow light through.
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

/// The scene of a run file, if it is one that the reference can do: matt, mirroring and clear
/// surfaces; suns, even and overcast skies, lamps; open, or periodic along both axes.
[[nodiscard]] std::optional<PlainScene> plain_scene(const Node& document, const Scene& scene);

/// Emitters of a document; none at all if one is of a kind that the reference can't do.
[[nodiscard]] std::optional<std::vector<Emitter>> emitters_of(
    const Node& document, const Scene& scene);

struct StartedRay {
    Vec3 origin, direction;
    double weight = 1;  ///< of the emitter's share of this path, per unit of its amount
};
/// A path's start.
[[nodiscard]] StartedRay start_ray(const Emitter& emitter, const PlainScene& scene, Random& random);

/// What one replicate found, flux: [(organ * 2 + side) * bands + band].
struct PlainSums {
    std::vector<double> direct, scattered;
    std::vector<double> absorbed;        ///< [organ * bands + band]
    std::vector<double> brightest_path;  ///< per band: the most that one brought
};

/// Follows `paths` paths from every source.
[[nodiscard]] PlainSums trace_plainly(
    const PlainScene& scene, std::uint64_t paths, std::uint64_t seed);

}  // namespace quasimc::stress
