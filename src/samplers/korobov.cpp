#include "samplers/korobov.h"

#include <array>
#include <bit>

#include "base/checks.h"
#include "samplers/hash.h"
#include "samplers/korobov_table.h"
#include "samplers/monte_carlo.h"
#include "samplers/vector_loops.h"

namespace quasimc {
namespace {

constexpr std::uint32_t kMaxDimensions = 128;

/// Powers of the multiplier mod 2^64, of which 2^m lattices use the lower m bits.
using Powers = std::array<std::uint64_t, kMaxDimensions>;

constexpr std::array<Powers, kMaxKorobovLog2 + 1> make_powers() {
    std::array<Powers, kMaxKorobovLog2 + 1> table{};
    for (int m = 0; m <= kMaxKorobovLog2; ++m) {
        std::uint64_t power = 1;
        for (std::uint64_t& entry : table[m]) {
            entry = power;
            power *= kKorobovLattices[m].multiplier;
        }
    }
    return table;
}

constexpr std::array<Powers, kMaxKorobovLog2 + 1> kPowers = make_powers();

/// One coordinate of all points of a round, in units of 2^-64: the i-th is i * step + shift.
struct Coordinate {
    std::uint64_t step, shift;
};

/// The size of the lattice: log2(stream.count).
int log2_count(const Stream& stream) {
    EXPECT(std::has_single_bit(stream.count));
    return 63 - std::countl_zero(stream.count | 1U);
}

/// Whether this coordinate is one of a lattice at all.
bool in_lattice(int m, std::uint32_t dimension) {
    return m <= kMaxKorobovLog2 && dimension < kKorobovLattices[m].dimensions;
}

Coordinate lattice_coordinate(const Stream& stream, int m, std::uint32_t dimension) {
    const std::uint64_t step = m == 0 ? 0 : kPowers[m][dimension] << (64 - m);
    return {step, stream_key(stream, stream.first, dimension)};
}

class Korobov final : public Sampler {
  public:
    double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        EXPECT(point - stream.first < stream.count);
        const int m = log2_count(stream);
        if (!in_lattice(m, dimension)) {
            return random_number(stream, point, dimension);
        }
        const Coordinate x = lattice_coordinate(stream, m, dimension);
        return unit_number((point - stream.first) * x.step + x.shift);
    }

    void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const override {
        EXPECT(point - stream.first + out.size() <= stream.count);
        const int m = log2_count(stream);
        if (!in_lattice(m, dimension)) {
            return random_numbers(stream, point, dimension, out);
        }
        const Coordinate x = lattice_coordinate(stream, m, dimension);
        loops_.fill_lattice(
            (point - stream.first) * x.step + x.shift, x.step, out.data(), out.size());
    }

    bool needs_power_of_two() const override { return true; }

  private:
    VectorLoops loops_ = best_vector_loops();
};

}  // namespace

std::unique_ptr<Sampler> make_korobov() {
    return std::make_unique<Korobov>();
}

}  // namespace quasimc
