#pragma once

#include <cstdint>
#include <vector>

#include "quasimc/run.h"
#include "scene/scene.h"

namespace quasimc::bench {

/// The paper's canopy: equilateral triangles, uniformly distributed and oriented in a cube of side
/// 10; their total area is 2.5 times that of a side of the cube.
struct Canopy {
    std::uint32_t leaves = 500;
    std::vector<double> albedos{0.2};  ///< per band, half reflected and half transmitted
    std::uint64_t seed = 1;
    std::uint32_t measured = 0;  ///< number of measured leaves, from the first; 0: all
    std::uint32_t sensors = 0;   ///< tiny horizontal ones among the leaves; only they are measured
    double phong_exponent = 0;   ///< of all reflection; 0: Lambertian; infinite: a mirror
    bool is_repeated = false;    ///< periodic along both horizontal axes
};

[[nodiscard]] Scene make_canopy(const Canopy& canopy);

enum class Light { sun, sky, overcast };

/// A vertical sun, a uniform sky, or the CIE's overcast one, irradiance 1 in every band.
[[nodiscard]] Sources make_light(Light light, std::size_t bands);

/// Mean over the organs of the variance between replicates of their absorbed flux density in the
/// first band.
[[nodiscard]] double mean_variance(const Result& result);

/// CPU seconds of the calling thread.
[[nodiscard]] double thread_seconds();

/// The median of an odd number of values.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace quasimc::bench
