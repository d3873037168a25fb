#pragma once

#include <cstdint>
#include <span>

namespace quasimc {

/// Length of the shortest nonzero integer vector h with h_1 z_1 + ... + h_s z_s = 0 mod n: the
/// points i z / n mod 1 of a rank-1 lattice lie on hyperplanes that are the inverse of this length
/// apart. One of the z must be odd, n a power of two up to 2^40, and s at most 8.
///
/// Basis reduction by Lenstra, Lenstra and Lovasz (1982), then enumeration after Fincke and Pohst
/// (1985).
[[nodiscard]] double shortest_dual_vector(std::uint64_t n, std::span<const std::uint64_t> z);

/// shortest_dual_vector divided by the greatest length that any lattice of n points in s dimensions
/// could have (Hermite's constants): 0 is worst, 1 best.
[[nodiscard]] double spectral_merit(std::uint64_t n, std::span<const std::uint64_t> z);

/// spectral_merit of coordinates (0, lag) of the Korobov lattice of n points with multiplier a.
[[nodiscard]] double korobov_pair_merit(std::uint64_t n, std::uint64_t a, std::uint32_t lag);

/// spectral_merit of coordinates 0 ... s - 1, s = 2 ... 8.
[[nodiscard]] double korobov_serial_merit(std::uint64_t n, std::uint64_t a, std::uint32_t s);

/// The minimum merit of a Korobov lattice over its projections on
///   - coordinates (0, i), i < 16, (0, i, j), i < j < 12, (0, i, j, k), i < j < k < 8, and
///   - coordinates 0 ... s - 1, s = 5 ... 8,
/// as far as all of them are below `dimensions`. Lemieux and L'Ecuyer call it M with t = (8, 16,
/// 12, 8). As the powers of a are invertible, coordinates (l, l + i, ...) have the merit of (0, i,
/// ...). Stops when the merit falls below `floor`.
[[nodiscard]] double korobov_merit(
    std::uint64_t n, std::uint64_t a, std::uint32_t dimensions, double floor = 0.0);

/// The number of good leading coordinates of a Korobov lattice: the first lag whose pair merit is
/// below 0.2 or that makes two coordinates equal or opposite; at most 128.
[[nodiscard]] std::uint32_t korobov_dimensions(std::uint64_t n, std::uint64_t a);

}  // namespace quasimc
