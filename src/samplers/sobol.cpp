#include "samplers/sobol.h"

#include <algorithm>
#include <array>

#include "samplers/hash.h"
#include "samplers/sobol_directions.h"
#include "samplers/vector_loops.h"

namespace quasimc {
namespace {

constexpr int kDigits = 32;
constexpr int kNibbles = kDigits / 4;
constexpr int kBlock = kSobolBlock;

/// Digits contributed by each value of each nibble of the index.
using NibbleTable = std::array<std::array<std::uint32_t, 16>, kNibbles>;

/// The recurrence for the next direction number of a row, m[k] (Bratley & Fox 1988, eq. 3).
constexpr std::uint32_t next_direction(
    const SobolDirection& row, const std::array<std::uint32_t, kDigits>& m, int k) {
    std::uint32_t next = m[k - row.degree] ^ (m[k - row.degree] << row.degree);
    for (int j = 1; j < row.degree; ++j) {
        if ((row.polynomial >> (row.degree - 1 - j) & 1U) != 0) {
            next ^= m[k - j] << j;
        }
    }
    return next;
}

/// The columns of a generator matrix, first digit in bit 0.
constexpr std::array<std::uint32_t, kDigits> generator_columns(std::uint32_t dimension) {
    std::array<std::uint32_t, kDigits> columns{};
    if (dimension == 0) {
        for (int k = 0; k < kDigits; ++k) {
            columns[k] = 1U << k;
        }
        return columns;
    }
    const SobolDirection& row = kSobolDirections[dimension - 1];
    std::array<std::uint32_t, kDigits> m{};
    for (int k = 0; k < kDigits; ++k) {
        m[k] = k < row.degree ? row.first[k] : next_direction(row, m, k);
        columns[k] = reverse_bits(m[k] << (kDigits - 1 - k));
    }
    return columns;
}

constexpr std::array<NibbleTable, kSobolDimensions> make_tables() {
    std::array<NibbleTable, kSobolDimensions> tables{};
    for (std::uint32_t dimension = 0; dimension < kSobolDimensions; ++dimension) {
        const auto columns = generator_columns(dimension);
        for (int nibble = 0; nibble < kNibbles; ++nibble) {
            for (std::uint32_t value = 1; value < 16; ++value) {
                const int lowest = std::countr_zero(value);
                tables[dimension][nibble][value] =
                    tables[dimension][nibble][value & (value - 1)] ^ columns[4 * nibble + lowest];
            }
        }
    }
    return tables;
}

constexpr std::array<NibbleTable, kSobolDimensions> kTables = make_tables();

/// The matrix product, one table entry per nibble; few runs have more than 2^16 points.
inline std::uint32_t digits_of(const NibbleTable& table, std::uint32_t index) {
    std::uint32_t digits = 0;
    for (int nibble = 0; nibble < kNibbles / 2; ++nibble) {
        digits ^= table[nibble][index >> (4 * nibble) & 15U];
    }
    if (index >> 16 != 0) {
        for (int nibble = kNibbles / 2; nibble < kNibbles; ++nibble) {
            digits ^= table[nibble][index >> (4 * nibble) & 15U];
        }
    }
    return digits;
}

/// Data shared by the points of one dimension and one period of 2^32 points.
struct Dimension {
    ScrambleKey key;
    const NibbleTable& table;
    bool shuffled;
    ScrambleKey order;  ///< key of the shuffle of the index, for the dimensions beyond the table

    Dimension(const Stream& stream, std::uint64_t period, std::uint32_t dimension)
        : key(stream_key(stream, period, dimension)),
          table(kTables[dimension % kSobolDimensions]),
          shuffled(dimension >= kSobolDimensions),
          order(shuffled ? stream_key(stream, ~period, dimension / kSobolDimensions) : 0) {}

    std::uint32_t index(std::uint32_t point) const {
        if (!shuffled) {
            return point;
        }
        return reverse_bits(scrambled(reverse_bits(point), order));
    }

    double coordinate(std::uint32_t point) const {
        const std::uint32_t digits = digits_of(table, index(point));
        const std::uint32_t first = reverse_bits(scrambled(digits, key));
        return unit_number(std::uint64_t{first} << 32 | more_bits(first, key));
    }

    /// The numbers of the block of kBlock points that begins at `point`, a multiple of kBlock.
    void block(const VectorLoops& loops, std::uint32_t point, double* out) const {
        if (!shuffled) {
            return loops.scramble_block(digits_of(table, point), table[0].data(), key, out);
        }
        std::array<std::uint32_t, kBlock> digits;
        for (std::uint32_t i = 0; i < kBlock; ++i) {
            digits[i] = digits_of(table, index(point + i));
        }
        loops.scramble_block(0, digits.data(), key, out);
    }
};

class Sobol final : public Sampler {
  public:
    double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        return Dimension(stream, point >> kDigits, dimension)
            .coordinate(static_cast<std::uint32_t>(point));
    }

    void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const override {
        while (!out.empty()) {
            const std::uint64_t left =
                (std::uint64_t{1} << kDigits) - static_cast<std::uint32_t>(point);
            const std::size_t count = std::min<std::uint64_t>(left, out.size());
            numbers_of_period(
                Dimension(stream, point >> kDigits, dimension), static_cast<std::uint32_t>(point),
                out.first(count));
            point += count;
            out = out.subspan(count);
        }
    }

  private:
    void numbers_of_period(
        const Dimension& dimension, std::uint32_t point, std::span<double> out) const {
        std::size_t done = 0;
        while (done < out.size()) {
            const std::uint32_t at = point + static_cast<std::uint32_t>(done);
            const std::uint32_t skipped = at % kBlock;
            if (skipped == 0 && out.size() - done >= kBlock) {
                dimension.block(loops_, at, out.data() + done);
                done += kBlock;
                continue;
            }
            std::array<double, kBlock> block;
            dimension.block(loops_, at - skipped, block.data());
            const std::size_t taken = std::min<std::size_t>(kBlock - skipped, out.size() - done);
            std::copy_n(block.data() + skipped, taken, out.data() + done);
            done += taken;
        }
    }

    VectorLoops loops_ = best_vector_loops();
};

}  // namespace

std::uint32_t sobol_digits(std::uint32_t index, std::uint32_t dimension) {
    return digits_of(kTables[dimension], index);
}

std::uint32_t owen_scramble(std::uint32_t digits, std::uint64_t key) {
    return scrambled(digits, ScrambleKey(key));
}

std::unique_ptr<Sampler> make_sobol() {
    return std::make_unique<Sobol>();
}

}  // namespace quasimc
