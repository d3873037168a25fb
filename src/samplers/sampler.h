#pragma once

#include <cstdint>
#include <span>

namespace quasimc {

/// The point set of a number: everything but the point and the dimension.
struct Stream {
    std::uint64_t seed = 1;  ///< the run's seed
    std::uint64_t sequence =
        0;  ///< index of the point set in the run: 0 for light tracing, else e.g. organ index + 1
    std::uint32_t replicate = 0;  ///< independent randomization
    std::uint64_t first = 0;      ///< points [first, first + count) make up the current round
    std::uint64_t count = 0;      ///< number of points in the round; a power of two for lattices
};

/// A randomized point set in the unit cube of any number of dimensions.
///
/// A number is a pure function of (stream, point, dimension): the same bits in any order and from
/// any thread. Over the replicates each point is uniform in [0, 1)^s. Dimensions are meant to be
/// used from 0 upwards in order of importance.
class Sampler {
  public:
    virtual ~Sampler() = default;
    Sampler() = default;
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;

    /// Coordinate `dimension` of `point`, in [0, 1).
    /// @param point  index in [stream.first, stream.first + stream.count)
    [[nodiscard]] virtual double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const = 0;

    /// Coordinate `dimension` of the consecutive points point, point + 1, ..., one for each element
    /// of `out`. The same bits as `coordinate`, computed faster.
    virtual void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const;

    /// Whether rounds must be powers of two (rank-1 lattices, whose points are the whole set).
    [[nodiscard]] virtual bool needs_power_of_two() const { return false; }
};

}  // namespace quasimc
