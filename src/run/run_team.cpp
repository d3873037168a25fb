#include "run/run_team.h"

#include <algorithm>
#include <utility>

#include "sums/sum_data.h"

namespace quasimc {
namespace {

__extension__ using Wide = __int128;

/// Splits a bin into two halves, so that sums over 2^31 processes do not overflow.
constexpr unsigned kHalf = 32;
constexpr std::int64_t kLowHalf = (std::int64_t{1} << kHalf) - 1;
/// Number of bins per message.
constexpr std::size_t kBinsAtOnce = std::size_t{1} << 18U;

void put_steps(const ExactBins& bins, std::size_t first, std::vector<std::int64_t>& numbers) {
    for (std::size_t i = 0; 3 * i < numbers.size(); ++i) {
        const ExactBins::Quanta quanta = bins.quanta(first + i);
        numbers[3 * i] = quanta.carries;
        numbers[3 * i + 1] = quanta.low >> kHalf;
        numbers[3 * i + 2] = quanta.low & kLowHalf;
    }
}

void take_steps(const std::vector<std::int64_t>& numbers, std::size_t first, ExactBins& bins) {
    for (std::size_t i = 0; 3 * i < numbers.size(); ++i) {
        const Wide low = (Wide{numbers[3 * i + 1]} << kHalf) + numbers[3 * i + 2];
        bins.add(
            first + i, ExactBins::Quanta{
                           numbers[3 * i] + static_cast<std::int64_t>(low / ExactBins::kCarry),
                           static_cast<std::int64_t>(low % ExactBins::kCarry)});
    }
}

}  // namespace

void add_up(RunTeam& team, Sums& sums) {
    for (ExactBins& bins : sums->replicates) {
        ExactBins total(bins.size());
        for (std::size_t first = 0; first < bins.size(); first += kBinsAtOnce) {
            std::vector<std::int64_t> numbers(3 * std::min(kBinsAtOnce, bins.size() - first));
            put_steps(bins, first, numbers);
            team.add_up(numbers);
            if (team.is_first()) {
                take_steps(numbers, first, total);
            }
        }
        bins = std::as_const(total);  // in place: workers may refer to the bins
    }
}

}  // namespace quasimc
