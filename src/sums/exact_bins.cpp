#include "sums/exact_bins.h"

#include <atomic>
#include <stdexcept>

#include "base/checks.h"
#include "base/free_memory.h"
#include "sums/fixed_point.h"

namespace quasimc {
namespace {

/// Takes whole carries out of a number; the remainder is within (-kCarry, kCarry).
std::int64_t take_carries(std::int64_t& quanta) {
    const std::int64_t carries = quanta / ExactBins::kCarry;
    quanta -= carries * ExactBins::kCarry;
    return carries;
}

}  // namespace

ExactBins::Quanta ExactBins::quanta_with_carries(std::size_t bin) const {
    Quanta quanta{carries_[bin], low_[bin]};
    if (quanta.carries > 0 && quanta.low < 0) {
        quanta = {quanta.carries - 1, quanta.low + kCarry};
    } else if (quanta.carries < 0 && quanta.low > 0) {
        quanta = {quanta.carries + 1, quanta.low - kCarry};
    }
    return quanta;
}

double ExactBins::value_with_carries(std::size_t bin) const {
    const Quanta sum = quanta_with_carries(bin);
    return from_fixed(sum.low) + static_cast<double>(sum.carries) * from_fixed(kCarry);
}

void ExactBins::carry(std::size_t bin, std::int64_t carries) {
    if (carries == 0) {
        return;
    }
    carries_.resize(low_.size());
    if (__builtin_add_overflow(carries_[bin], carries, &carries_[bin])) {
        throw std::overflow_error("a sum of light exceeds 2^125 quanta");
    }
}

void ExactBins::add_with_carry(std::size_t bin, std::int64_t quanta) {
    carry(bin, take_carries(quanta));
    std::int64_t sum = low_[bin] + quanta;  // of two numbers within (-2^62, 2^62)
    carry(bin, take_carries(sum));
    low_[bin] = sum;
}

void ExactBins::add(std::size_t bin, Quanta quanta) {
    add(bin, quanta.low);
    carry(bin, quanta.carries);
}

ExactBins& ExactBins::operator+=(const ExactBins& other) {
    EXPECT(size() == other.size());
    for (std::size_t i = 0; i < size(); ++i) {
        add(i, other.quanta(i));
    }
    return *this;
}

void ExactBins::settle() {
    for (std::size_t i = 0; i < low_.size(); ++i) {
        const std::atomic_ref low(low_[i]);
        std::int64_t rest = low.load(std::memory_order_relaxed);
        const std::int64_t carries = take_carries(rest);
        if (carries != 0) {
            low.fetch_sub(carries * kCarry, std::memory_order_relaxed);
            carry(i, carries);
        }
    }
}

void ExactBins::clear(std::size_t first, std::size_t last) {
    EXPECT(first <= last && last <= size());
    clear_pages(std::span(low_).subspan(first, last - first));
    if (!carries_.empty()) {
        clear_pages(std::span(carries_).subspan(first, last - first));
    }
}

bool operator==(const ExactBins& a, const ExactBins& b) {
    if (a.size() != b.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a.quanta(i) != b.quanta(i)) {
            return false;
        }
    }
    return true;
}

}  // namespace quasimc
