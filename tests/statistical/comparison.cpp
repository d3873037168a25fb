#include "statistical/comparison.h"

#include <algorithm>
#include <cmath>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// One number that two runs have estimated.
struct Pair {
    Estimate a, b;
    double missed = 0;  ///< upper bound of light that a run without contributions may have missed

    [[nodiscard]] double difference() const { return a.mean - b.mean; }
    [[nodiscard]] double standard_error() const {
        return std::hypot(a.standard_error, b.standard_error);
    }
};

/// An estimate for comparison: one without contributions counts as 0, with the other run's error
/// alone.
Estimate seen(const Estimate& estimate) {
    return estimate.mean == 0 ? Estimate{} : estimate;
}

/// Size of one contribution to a side in a run that has none, per area of the organ; NaN where it
/// is unknown.
/// @param other  a run with contributions
double contribution_of(
    const Result& result, const Result& other, std::size_t organ, Quantity side, std::size_t band) {
    if (result.escaped_by_difference) {  // from organs: the standard errors include it
        return result.at(organ, side, band).standard_error;
    }
    const double area = other.at(organ, Quantity::absorbed_flux, band).mean /
                        other.at(organ, Quantity::absorbed_flux_density, band).mean;
    const double paths = static_cast<double>(result.paths) * result.replicates;
    return result.budget[band].emitted.mean / (paths * area);
}

/// The light on all sides of all organs in one band, except sides without contributions in both
/// runs.
std::vector<Pair> sides_of(const Result& a, const Result& b, std::size_t band) {
    std::vector<Pair> pairs;
    for (std::size_t organ = 0; organ < a.organs(); ++organ) {
        for (const Quantity q : {Quantity::incident_upper, Quantity::incident_lower}) {
            Pair pair{seen(a.at(organ, q, band)), seen(b.at(organ, q, band))};
            if (pair.a.mean != 0 || pair.b.mean != 0) {
                pair.missed = pair.a.mean == 0   ? contribution_of(a, b, organ, q, band)
                              : pair.b.mean == 0 ? contribution_of(b, a, organ, q, band)
                                                 : 0;
                pairs.push_back(pair);
            }
        }
    }
    return pairs;
}

double mean_of(const std::vector<Pair>& pairs) {
    double sum = 0;
    for (const Pair& pair : pairs) {
        sum += .5 * (pair.a.mean + pair.b.mean);
    }
    return sum / static_cast<double>(pairs.size());
}

/// Student's t at the level of each of `family` comparisons.
double limit_of(unsigned family) {
    return student_t_quantile(1 - sidak_level(kLevel, family) / 2, kReplicates - 1);
}

::testing::AssertionResult describe(const Pair& pair, std::size_t band, double limit) {
    const double most = limit * pair.standard_error() + pair.missed;
    const bool agree = std::abs(pair.difference()) <= most;
    return (agree ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
           << "band " << band << ": " << pair.a.mean << " +- " << pair.a.standard_error << " and "
           << pair.b.mean << " +- " << pair.b.standard_error << ", "
           << pair.difference() / pair.standard_error() << " standard errors, at most " << limit;
}

/// Size of one contribution to a total without any: its upper end is that of three.
double contribution_to_total(const Estimate& total) {
    return std::isnan(total.standard_error) && total.mean == 0 ? total.ci95_high / 3 : 0;
}

/// The 90 % quantile of `values`.
double nine_in_ten(std::vector<double> values) {
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

}  // namespace

::testing::AssertionResult Comparison::totals_agree(const Result& a, const Result& b) {
    const unsigned family = pairs_ * 2 * static_cast<unsigned>(a.bands);
    const double limit = limit_of(family);
    const double contributions = -std::log(sidak_level(kLevel, family));
    auto verdict = ::testing::AssertionSuccess();
    for (std::size_t band = 0; band < a.bands; ++band) {
        for (const auto part : {&BandBudget::absorbed_by_organs, &BandBudget::absorbed_by_ground}) {
            Pair pair{a.budget[band].*part, b.budget[band].*part};
            if (unseen_ == Unseen::few_contributions) {
                pair.missed =
                    contributions * (contribution_to_total(pair.a) + contribution_to_total(pair.b));
                pair = {seen(pair.a), seen(pair.b), pair.missed};
            }
            total_widths_.push_back(
                (limit * pair.standard_error() + pair.missed) / a.budget[band].emitted.mean);
            const auto result = describe(pair, band, limit);
            if (!result) {
                verdict = result;
            }
        }
    }
    return verdict;
}

::testing::AssertionResult Comparison::organs_agree(const Result& a, const Result& b) {
    auto verdict = ::testing::AssertionSuccess();
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t band = 0; band < a.bands; ++band) {
        std::vector<Pair> pairs = sides_of(a, b, band);
        const auto family = pairs_ * static_cast<unsigned>(pairs.size() * a.bands);
        const double limit = limit_of(family);
        // The rule of three, at this level.
        const double contributions = -std::log(sidak_level(kLevel, family));
        for (Pair& pair : pairs) {
            pair.missed = unseen_ == Unseen::few_contributions ? contributions * pair.missed : 0;
        }
        const double mean = mean_of(pairs);
        for (const Pair& pair : pairs) {
            if (std::isnan(pair.missed)) {
                organ_widths_.push_back(INFINITY);
                continue;
            }
            organ_widths_.push_back((limit * pair.standard_error() + pair.missed) / mean);
            squares += std::pow(pair.difference() / pair.standard_error(), 2);
            const auto result = describe(pair, band, limit);
            if (!result) {
                verdict = result;
            }
        }
        count += pairs.size();
    }
    mean_squares_.push_back(squares / static_cast<double>(count));
    return verdict;
}

::testing::AssertionResult Comparison::are_sharp(double totals, double organs) const {
    const double total = nine_in_ten(total_widths_);
    const double organ = nine_in_ten(organ_widths_);
    return (total <= totals && organ <= organs ? ::testing::AssertionSuccess()
                                               : ::testing::AssertionFailure())
           << "nine in ten half-widths are at most " << total << " (totals) and " << organ
           << " (organs)";
}

::testing::AssertionResult Comparison::scatter_is_that_of_errors(double resolution) const {
    constexpr double kOfStudent = (kReplicates - 1.0) / (kReplicates - 3.0);
    const Measured m = measured(mean_squares_);
    const double half = student_t_quantile(1 - kLevel, m.replicates - 1) * m.standard_error;
    return (half <= resolution && m.mean - half <= kOfStudent ? ::testing::AssertionSuccess()
                                                              : ::testing::AssertionFailure())
           << "mean square of differences over errors " << m.mean << ", half-width " << half;
}

}  // namespace quasimc::test
