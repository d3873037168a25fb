#include "sums/tally.h"

#include <algorithm>

#include "base/checks.h"
#include "base/parallel.h"
#include "base/text.h"
#include "quasimc/error.h"

namespace quasimc {

void refuse_amount(double amount) {
    throw InputError(
        {{"sources",
          "light too strong to be summed: " + shortest(amount) + " times the share of one path",
          "a source is too close to a surface, or much stronger than all others",
          "move it away, or use method = \"light_tracing\""}});
}

Tally::Tally(const SumLayout& layout, std::size_t shared_regions, std::span<std::int64_t> shared)
    : blocks_(layout),
      bins_(layout.bins()),
      shared_bins_(shared_regions * layout.stride()),
      shared_(shared) {
    resize_apart(own_, layout.bins() - shared_bins_);
    EXPECT(shared_regions == 0 || shared.size() == layout.bins());
    EXPECT(shared_regions <= layout.regions());
}

void Tally::add_signed(std::size_t bin, std::int64_t amount) {
    const bool is_own = bin >= shared_bins_;
    std::int64_t sum =
        is_own ? own_[bin - shared_bins_]
               : std::atomic_ref(shared_[bin]).fetch_add(amount, std::memory_order_relaxed);
    if (__builtin_add_overflow(sum, amount, &sum)) {
        written_ = -1;
    }
    if (is_own) {
        own_[bin - shared_bins_] = sum;
    }
    const bool is_large = sum >= ExactBins::kCarry || sum <= -ExactBins::kCarry;
    written_ |= is_large ? ExactBins::kCarry : 0;
}

void Tally::move_into(ExactBins& total) {
    EXPECT(total.size() == bins_);
    if (written_ < 0) {
        throw InputError(
            {{"sources", "light too strong to be summed",
              "single paths carry thousands of times their share, as with a sun at grazing "
              "incidence on a cell",
              "use light_tracing or first_hits"}});
    }
    for (std::size_t i = 0; i < own_.size(); ++i) {
        total.add(shared_bins_ + i, own_[i]);
    }
    std::fill(own_.begin(), own_.end(), 0);
    written_ = 0;
}

}  // namespace quasimc
