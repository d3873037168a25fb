#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/angles.h"
#include "sums/statistics.h"
#include "survey/gap_counts.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The rings of the LAI-2000: their bounds, and the weights sin(angle) d(angle) and path lengths
/// 1 / cos(angle) that the instrument takes (Welles and Norman 1991).
constexpr std::array kInstrumentRings{0.0, 13.0, 28.0, 43.0, 58.0, 74.0};
constexpr std::array kInstrumentWeights{0.034, 0.104, 0.160, 0.218, 0.494};
constexpr std::array kInstrumentPaths{1.008, 1.087, 1.270, 1.662, 2.670};

double cosine(double degrees) {
    return std::cos(degrees * kRadians);
}

/// Numbers that follow from the gaps of some positions.
struct Numbers {
    std::vector<double> clumping;  // by ring
    double sky_transmittance = 0;
    double effective = 0, corrected = 0, clumping_index = 0, instrument = 0;
};

/// The number of rays for which a sector without a gap counts, and the range of its uncertainty.
constexpr double kClosed = 0.5, kMinClosed = 0.25, kMaxClosed = 1;

/// The gap fractions of the bins of some positions, without one replicate.
class Gaps {
  public:
    /// @param omitted  a replicate, or that of none: counts.replicates
    /// @param closed  see kClosed
    Gaps(
        const GapCounts& counts,
        std::size_t first,
        std::size_t count,
        std::size_t omitted,
        double closed = kClosed)
        : counts_(counts), positions_(count), closed_(closed), open_(count * counts.bins()) {
        const std::size_t replicates = counts.replicates - (omitted < counts.replicates ? 1 : 0);
        rays_ = static_cast<double>(replicates) * counts.rays;
        for (std::size_t r = 0; r < counts.replicates; ++r) {
            for (std::size_t i = 0; i < open_.size() && r != omitted; ++i) {
                open_[i] += counts.at(r, first + i / counts.bins(), i % counts.bins());
            }
        }
    }

    /// The mean gap fraction of a ring.
    [[nodiscard]] double mean(std::size_t ring) const {
        return mean_over(0, positions_, ring, [](double open) { return open; }) / rays_;
    }
    /// ln of the mean gap fraction of a ring; of a closed one, that of a closed sector.
    [[nodiscard]] double log_of_mean(std::size_t ring) const {
        return std::log(not_closed(mean(ring) * rays_) / rays_);
    }
    /// The same with closed sectors as in mean_log(), which is at most this.
    [[nodiscard]] double log_of_closed_mean(std::size_t ring) const {
        return std::log(
            mean_over(0, positions_, ring, [this](double open) { return not_closed(open); }) /
            rays_);
    }
    /// The mean of ln over positions.
    [[nodiscard]] double mean_log_of_positions(std::size_t ring) const {
        double sum = 0;
        for (std::size_t position = 0; position < positions_; ++position) {
            const double open = mean_over(position, 1, ring, [](double of_bin) { return of_bin; });
            sum += std::log(not_closed(open) / rays_);
        }
        return sum / static_cast<double>(positions_);
    }
    /// The mean of ln over sectors and positions.
    [[nodiscard]] double mean_log(std::size_t ring) const {
        return mean_over(0, positions_, ring, [this](double open) {
            return std::log(not_closed(open) / rays_);
        });
    }
    [[nodiscard]] std::size_t closed_bins() const {
        return static_cast<std::size_t>(std::count(open_.begin(), open_.end(), 0.0));
    }

  private:
    [[nodiscard]] double not_closed(double open) const { return open > 0 ? open : closed_; }
    /// The mean of a function of the rays that leave, over the sectors of a ring and positions.
    template <typename Function>
    [[nodiscard]] double mean_over(
        std::size_t first, std::size_t count, std::size_t ring, const Function& function) const {
        double sum = 0;
        for (std::size_t i = 0; i < count * counts_.sectors; ++i) {
            const std::size_t position = first + i / counts_.sectors;
            const std::size_t bin = ring * counts_.sectors + i % counts_.sectors;
            sum += function(open_[position * counts_.bins() + bin]);
        }
        return sum / static_cast<double>(count * counts_.sectors);
    }

    const GapCounts& counts_;
    std::size_t positions_;
    double closed_;
    double rays_ = 0;           // of each bin
    std::vector<double> open_;  // rays that leave, by bin
};

Numbers numbers_of(const GapFractionSpec& spec, const Gaps& gaps) {
    Numbers numbers;
    double sky = 0, random = 0;
    for (std::size_t ring = 0; ring < spec.rings(); ++ring) {
        const bool is_last = ring + 1 == spec.rings();
        const double high = cosine(spec.rings_deg[ring]), low = cosine(spec.rings_deg[ring + 1]);
        const double end = is_last ? 0 : low;
        const double inner = high * high - end * end;
        numbers.sky_transmittance += gaps.mean(ring) * inner;
        sky += inner;
        const double of_mean = -gaps.log_of_mean(ring), of_sectors = -gaps.mean_log(ring);
        const double weight = (high + low) * (high - end);
        numbers.effective += of_mean * weight;
        numbers.corrected += of_sectors * weight;
        const double of_closed_mean = -gaps.log_of_closed_mean(ring);
        random += of_closed_mean * weight;
        // A ring without any gap shows nothing of how leaves are spread.
        const bool is_known = of_sectors > 0 && gaps.mean(ring) > 0;
        numbers.clumping.push_back(is_known ? of_closed_mean / of_sectors : kNan);
        if (ring < kInstrumentWeights.size()) {
            numbers.instrument += -2 * gaps.mean_log_of_positions(ring) * kInstrumentWeights[ring] /
                                  kInstrumentPaths[ring];
        }
    }
    numbers.sky_transmittance /= sky;
    const bool is_known = numbers.corrected > 0 && numbers.sky_transmittance > 0;
    numbers.clumping_index = is_known ? random / numbers.corrected : kNan;
    return numbers;
}

/// The estimate of a function of the gaps: its value for all replicates, with the standard error
/// of the jackknife, and that of what closed sectors count as.
/// @param without  its values without one replicate each
/// @param closed  half the difference by that count
Estimate jackknife(double value, std::span<const double> without, double closed) {
    const double mean = mean_of(without);
    double squares = 0;
    for (const double x : without) {
        squares += (x - mean) * (x - mean);
    }
    const auto n = static_cast<double>(without.size());
    const double error = n > 1 ? std::hypot(std::sqrt(squares * (n - 1) / n), closed) : kNan;
    const double half =
        n > 1 ? error * interval_quantile(static_cast<unsigned>(without.size()) - 1) : kNan;
    return not_negative({value, error, value - half, value + half});
}

/// The estimate of a gap fraction. If all rays or none left the scene, the interval is that of the
/// rule of three. @param ray  what one ray more of a replicate adds
Estimate gap_of(const std::vector<double>& values, double ray) {
    if (std::any_of(values.begin(), values.end(), [](double x) { return x < 1; })) {
        return not_above(estimate_seen_or_bound(values, ray), 1);
    }
    const Estimate closed = estimate_unseen(static_cast<double>(values.size()), ray);
    return {1, closed.standard_error, 1 - closed.ci95_high, 1};
}

Estimate mean_gap(const GapCounts& counts, std::size_t first, std::size_t count, std::size_t ring) {
    std::vector<double> values(counts.replicates);
    const auto rays = static_cast<double>(count * counts.sectors) * counts.rays;
    for (std::size_t r = 0; r < counts.replicates; ++r) {
        for (std::size_t i = 0; i < count * counts.sectors; ++i) {
            const std::size_t bin = ring * counts.sectors + i % counts.sectors;
            values[r] += counts.at(r, first + i / counts.sectors, bin) / rays;
        }
    }
    return gap_of(values, 1 / rays);
}

}  // namespace

std::vector<Estimate> gaps_of(const GapCounts& counts) {
    std::vector<Estimate> gaps;
    std::vector<double> values(counts.replicates);
    for (std::size_t i = 0; i < counts.positions * counts.bins(); ++i) {
        for (std::size_t r = 0; r < counts.replicates; ++r) {
            values[r] = static_cast<double>(counts.at(r, i / counts.bins(), i % counts.bins())) /
                        counts.rays;
        }
        gaps.push_back(gap_of(values, 1.0 / counts.rays));
    }
    return gaps;
}

GapIndices gap_indices(
    const GapFractionSpec& spec, const GapCounts& counts, std::size_t first, std::size_t count) {
    const Gaps gaps(counts, first, count, counts.replicates);
    const Numbers whole = numbers_of(spec, gaps);
    const auto with_closed = [&](double closed) {
        return numbers_of(spec, Gaps(counts, first, count, counts.replicates, closed));
    };
    const Numbers least = with_closed(kMinClosed), most = with_closed(kMaxClosed);
    std::vector<Numbers> without;
    for (std::size_t r = 0; r < counts.replicates && counts.replicates > 1; ++r) {
        without.push_back(numbers_of(spec, Gaps(counts, first, count, r)));
    }
    const auto estimate = [&](auto number) {
        std::vector<double> values(without.size());
        std::transform(without.begin(), without.end(), values.begin(), number);
        const double closed = std::abs(number(least) - number(most)) / 2;
        return jackknife(number(whole), values, closed);
    };
    GapIndices indices;
    for (std::size_t ring = 0; ring < spec.rings(); ++ring) {
        indices.gap.push_back(mean_gap(counts, first, count, ring));
        indices.clumping.push_back(estimate([ring](const Numbers& n) { return n.clumping[ring]; }));
    }
    indices.sky_transmittance =
        not_above(estimate([](const Numbers& n) { return n.sky_transmittance; }), 1);
    indices.effective_plant_area_index = estimate([](const Numbers& n) { return n.effective; });
    indices.plant_area_index = estimate([](const Numbers& n) { return n.corrected; });
    indices.clumping_index = estimate([](const Numbers& n) { return n.clumping_index; });
    if (std::equal(
            spec.rings_deg.begin(), spec.rings_deg.end(), kInstrumentRings.begin(),
            kInstrumentRings.end())) {
        indices.lai_2000 = estimate([](const Numbers& n) { return n.instrument; });
    }
    indices.closed_bins = gaps.closed_bins();
    return indices;
}

}  // namespace quasimc
