// Korobov's lattice rule under a random shift.
//
// Method   The n = 2^m points of a round are i (1, a, a^2, a^3, ...) / n mod 1, i = 0 ... n - 1,
//          plus a random vector mod 1. The coordinates are computed in 64-bit fixed point, exactly:
//          one multiplication, one addition. The sampler of the first QuasiMC (Cieslak et al.
//          2008).
// Papers   Korobov (1959), Dokl. Akad. Nauk SSSR 124, 1207-1210. Cranley and Patterson (1976),
//          "Randomization of number theoretic methods for multiple integration", SIAM J. Numer.
//          Anal. 13, 904-914. L'Ecuyer and Lemieux (2000), "Variance reduction via lattice rules",
//          Management Science 46, 1214-1235. Cieslak, Lemieux, Hanan and Prusinkiewicz (2008),
//          "Quasi-Monte Carlo simulation of the light environment of plants", Functional Plant
//          Biology 35, 837-849.
// Points   Rounds of 2^m points, m = 0 ... 40, with one multiplier for each m (korobov_table.h). A
//          round is a whole lattice and must not be cut; it has a shift of its own, made from
//          stream.first, and its points count from there. Larger rounds are random numbers.
// Dims     The powers of a repeat after n / 4, and before that pairs of dimensions begin to fall on
//          few lines. The table says how many dimensions of each lattice are good; beyond these the
//          numbers are those of monte_carlo.
// Cost     Consecutive points less than 1 ns a number, random access some 6 ns (bench/samplers).
#pragma once

#include <memory>

#include "samplers/sampler.h"

namespace quasimc {

/// The sampler `korobov` of the catalogue.
[[nodiscard]] std::unique_ptr<Sampler> make_korobov();

}  // namespace quasimc
