#include "samplers/digit_scramble.h"

#include <numeric>
#include <utility>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kLargestGroup = 2048;
constexpr int kMaxGroups = 7;
constexpr int kFillBits = 20;

/// p^e, or 0 if it does not fit 32 bits.
constexpr std::uint32_t power32(std::uint32_t base, int exponent) {
    std::uint64_t power = 1;
    for (int i = 0; i < exponent; ++i) {
        power *= base;
        if (power >> 32 != 0) {
            return 0;
        }
    }
    return static_cast<std::uint32_t>(power);
}

/// A fixed permutation of 0 ... size - 1 by the shuffle of Fisher and Yates; each call makes
/// another.
std::vector<std::uint32_t> permutation(std::uint32_t size, std::uint64_t& counter) {
    std::vector<std::uint32_t> order(size);
    std::iota(order.begin(), order.end(), 0U);
    for (std::uint32_t i = size; i > 1; --i) {
        std::swap(order[i - 1], order[multiply_high(mix64(++counter), i)]);
    }
    return order;
}

/// For every value of a group of digits, first digit least significant: the value of the permuted
/// digits, first digit most significant. The permutation of a digit is made anew for every value of
/// those before it.
std::vector<std::uint16_t> permuted_group(std::uint32_t base, std::uint32_t group_size) {
    std::vector<std::uint16_t> table{0};
    std::uint64_t counter = std::uint64_t{base} << 32;
    while (table.size() < group_size) {
        const std::size_t prefixes = table.size();
        std::vector<std::uint16_t> longer(prefixes * base);
        for (std::size_t prefix = 0; prefix < prefixes; ++prefix) {
            const auto order = permutation(base, counter);
            for (std::uint32_t digit = 0; digit < base; ++digit) {
                longer[digit * prefixes + prefix] =
                    static_cast<std::uint16_t>(table[prefix] * base + order[digit]);
            }
        }
        table = std::move(longer);
    }
    return table;
}

}  // namespace

DigitScramble::DigitScramble(std::uint32_t base) : base_(base) {
    EXPECT(base >= 2 && base <= kLargestGroup);
    for (int length = 1; power32(base, length) != 0 && power32(base, length) <= kLargestGroup;
         ++length) {
        for (int groups = 1; groups <= kMaxGroups; ++groups) {
            const std::uint32_t period = power32(base, length * groups);
            if (period < period_ || (period == period_ && groups >= groups_)) {
                continue;
            }
            period_ = period;
            groups_ = groups;
            digits_ = length * groups;
            group_size_ = power32(base, length);
        }
    }
    reciprocal_ = ~std::uint64_t{0} / group_size_ + 1;
    scale_ = 1.0 / period_;
    permuted_ = permuted_group(base, group_size_);
}

DigitScramble::Key DigitScramble::key(std::uint64_t random_bits) const {
    const std::uint64_t units = std::uint64_t{period_} / base_ * (base_ - 1);
    const std::uint64_t unit = multiply_high(mix64(random_bits + 0x9e3779b97f4a7c15U), units);
    const std::uint64_t filling = mix64(random_bits + 0x3c6ef372fe94f82aU);
    return {
        .factor = unit / (base_ - 1) * base_ + unit % (base_ - 1) + 1,
        .summand = multiply_high(random_bits, period_),
        .filling = filling};
}

double DigitScramble::coordinate(std::uint32_t x, const Key& key) const {
    auto left = static_cast<std::uint32_t>((x * key.factor + key.summand) % period_);
    std::uint32_t digits = 0;
    for (int group = 0; group < groups_; ++group) {
        // Exact for 32-bit numbers: Lemire, Kaser and Kurz (2019), "Faster remainder by direct
        // computation".
        const auto quotient = static_cast<std::uint32_t>(multiply_high(reciprocal_, left));
        digits = digits * group_size_ + permuted_[left - quotient * group_size_];
        left = quotient;
    }
    const std::uint64_t fill = mix64(key.filling + digits) >> (64 - kFillBits);
    return (digits + static_cast<double>(fill) * (1.0 / (1 << kFillBits))) * scale_;
}

}  // namespace quasimc
