#include "samplers/faure.h"

#include <algorithm>
#include <array>

#include "base/checks.h"
#include "samplers/digit_scramble.h"
#include "samplers/hash.h"

namespace quasimc {
namespace {

constexpr std::uint32_t kBase = kFaureBase;  // p in the comments
constexpr int kFaureDigits = 9;
constexpr int kFieldBits =
    7;  // of a packed vector of digit sums, each at most kFaureDigits * (p - 1)
constexpr std::uint32_t kFieldSize = 1U << kFieldBits;

static_assert(kFaureDigits * (kBase - 1) < kFieldSize && kFaureDigits * kFieldBits <= 64);

/// Packed products of each column of a generator matrix and each digit: [column][digit].
using Columns = std::array<std::array<std::uint64_t, kBase>, kFaureDigits>;

/// Binomial coefficients mod p: [l][k].
using Pascal = std::array<std::array<std::uint32_t, kFaureDigits>, kFaureDigits>;

constexpr Pascal pascal_matrix() {
    Pascal binomial{};
    for (int l = 0; l < kFaureDigits; ++l) {
        binomial[l][0] = 1;
        for (int k = 1; k <= l; ++k) {
            binomial[l][k] = (binomial[l - 1][k - 1] + (k < l ? binomial[l - 1][k] : 0)) % kBase;
        }
    }
    return binomial;
}

/// Column l of the j-th power of Pascal's matrix times a digit; its row k is binomial(l, k) j^(l -
/// k).
constexpr std::uint64_t packed_product(
    const Pascal& binomial, std::uint32_t j, int l, std::uint32_t digit) {
    std::uint64_t packed = 0;
    std::uint32_t power = 1;
    for (int k = l; k >= 0; --k) {
        packed |= std::uint64_t{binomial[l][k] * power * digit % kBase} << (kFieldBits * k);
        power = power * j % kBase;
    }
    return packed;
}

constexpr std::array<Columns, kFaureDimensions> make_columns() {
    const Pascal binomial = pascal_matrix();
    std::array<Columns, kFaureDimensions> columns{};
    for (std::uint32_t j = 0; j < kFaureDimensions; ++j) {
        for (int l = 0; l < kFaureDigits; ++l) {
            for (std::uint32_t digit = 0; digit < kBase; ++digit) {
                columns[j][l][digit] = packed_product(binomial, j, l, digit);
            }
        }
    }
    return columns;
}

/// Each sum mod p.
constexpr std::array<std::uint8_t, kFieldSize> make_remainders() {
    std::array<std::uint8_t, kFieldSize> remainders{};
    for (std::uint32_t sum = 0; sum < kFieldSize; ++sum) {
        remainders[sum] = static_cast<std::uint8_t>(sum % kBase);
    }
    return remainders;
}

constexpr std::array<Columns, kFaureDimensions> kColumns = make_columns();
constexpr auto kRemainders = make_remainders();

class Faure final : public Sampler {
  public:
    Faure() : scramble_(kBase) {
        ENSURE(scramble_.digits() == kFaureDigits && scramble_.period() == kFaurePeriod);
    }

    double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        const std::uint64_t period = point / kFaurePeriod;
        return coordinate(
            static_cast<std::uint32_t>(point % kFaurePeriod), dimension,
            keys(stream, period, dimension));
    }

    void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const override {
        while (!out.empty()) {
            const std::uint64_t period = point / kFaurePeriod;
            const auto first = static_cast<std::uint32_t>(point % kFaurePeriod);
            const std::size_t count = std::min<std::size_t>(kFaurePeriod - first, out.size());
            const Keys both = keys(stream, period, dimension);
            for (std::uint32_t i = 0; i < count; ++i) {
                out[i] = coordinate(first + i, dimension, both);
            }
            point += count;
            out = out.subspan(count);
        }
    }

  private:
    struct Keys {
        std::uint64_t order;  ///< key of the order of points in a block of dimensions
        DigitScramble::Key digits;
    };

    Keys keys(const Stream& stream, std::uint64_t period, std::uint32_t dimension) const {
        return {
            .order = dimension < kFaureDimensions
                         ? 0
                         : stream_key(stream, ~period, dimension / kFaureDimensions),
            .digits = scramble_.key(stream_key(stream, period, dimension))};
    }

    double coordinate(std::uint32_t index, std::uint32_t dimension, const Keys& both) const {
        if (dimension >= kFaureDimensions) {
            index = shuffled(index, both.order);
        }
        return scramble_.coordinate(
            product(kColumns[dimension % kFaureDimensions], index), both.digits);
    }

    /// A permutation of the points that maps aligned blocks of p^k points to such blocks: each
    /// digit d of the index becomes a d + b mod p, with a and b drawn by a hash of all more
    /// significant digits.
    static std::uint32_t shuffled(std::uint32_t index, std::uint64_t key) {
        std::array<std::uint32_t, kFaureDigits> digits{};
        for (std::uint32_t& digit : digits) {
            digit = index % kBase;
            index /= kBase;
        }
        std::uint32_t above = 0;
        std::uint32_t result = 0;
        for (int k = kFaureDigits - 1; k >= 0; --k) {
            const std::uint64_t node =
                std::uint64_t{above} * kFaureDigits + static_cast<unsigned>(k);
            const std::uint64_t choice =
                multiply_high(mix64(key + node), std::uint64_t{kBase} * (kBase - 1));
            const auto a = static_cast<std::uint32_t>(choice / kBase) + 1;
            const auto b = static_cast<std::uint32_t>(choice % kBase);
            result = result * kBase + (a * digits[k] + b) % kBase;
            above = above * kBase + digits[k];
        }
        return result;
    }

    /// The matrix product: the digits of a coordinate as an integer, first digit least significant.
    static std::uint32_t product(const Columns& columns, std::uint32_t index) {
        std::uint64_t sums = 0;
        for (int l = 0; l < kFaureDigits; ++l) {
            sums += columns[l][index % kBase];
            index /= kBase;
        }
        std::uint32_t digits = 0;
        for (int k = kFaureDigits - 1; k >= 0; --k) {
            digits = digits * kBase + kRemainders[sums >> (kFieldBits * k) & (kFieldSize - 1)];
        }
        return digits;
    }

    DigitScramble scramble_;
};

}  // namespace

std::unique_ptr<Sampler> make_faure() {
    return std::make_unique<Faure>();
}

}  // namespace quasimc
