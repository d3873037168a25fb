#include "stress/coverage.h"

#include <algorithm>
#include <cmath>

#include "sums/statistics.h"

namespace quasimc::stress {
namespace {

using Answers = std::vector<Answer>;  // of one way

/// The mean of a number over the seeds.
Estimate mean_of(const Answers& answers, std::size_t number) {
    std::vector<double> means;
    for (const Answer& answer : answers) {
        means.push_back(answer.numbers[number].mean);
    }
    return estimate_mean(means);
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The mean of the most precise other way, if it is precise compared with both halves of the
/// intervals (low counts widen one half). Intervals end at physical limits, which this mean may
/// exceed by noise and rounding. Bundles are excluded: the discretization error of their patches is
/// the same at every seed.
std::optional<double> truth_of(
    const Case& it, const std::vector<Answers>& all, std::size_t own, std::size_t number) {
    std::optional<Estimate> best;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Estimate e = mean_of(all[i], number);
        const bool is_told = all[i][0].numbers[number].is_known && e.mean > 0;
        if (i != own && all[i][0].way != Way::ray_bundles && is_told &&
            (!best || e.standard_error < best->standard_error)) {
            best = e;
        }
    }
    std::vector<double> below, above;
    double highest = 0;
    for (const Answer& answer : all[own]) {
        const Number& n = answer.numbers[number];
        highest = std::max(highest, n.high);
        below.push_back(n.mean - n.low);
        above.push_back(n.high - n.mean);
    }
    // The median, because a few seeds with rare contributions are hundreds of times as wide as the
    // others.
    const double width = std::min(median_of(std::move(below)), median_of(std::move(above)));
    const bool is_narrow =
        best && best->standard_error < .2 * width && width > 4 * slack_of(it, number, best->mean);
    if (!is_narrow) {
        return std::nullopt;
    }
    constexpr double kErrors = 4;
    const double noise = kErrors * best->standard_error + slack_of(it, number, best->mean);
    const bool is_noise = best->mean <= highest + noise;
    return is_noise ? std::min(best->mean, highest) : best->mean;
}

Coverage coverage_of_way(const Case& it, const std::vector<Answers>& all, std::size_t own) {
    std::vector<double> held(all[own].size(), 0.0);
    Coverage coverage{all[own][0].way};
    for (std::size_t i = 0; i < all[own][0].numbers.size(); ++i) {
        const std::optional<double> truth = truth_of(it, all, own, i);
        if (!truth || !all[own][0].numbers[i].is_known) {
            continue;
        }
        ++coverage.numbers;
        const double slack = slack_of(it, i, *truth);
        double of_number = 0;
        for (std::size_t s = 0; s < held.size(); ++s) {
            const Number& n = all[own][s].numbers[i];
            const double holds = n.low - slack <= *truth && *truth <= n.high + slack ? 1 : 0;
            held[s] += holds;
            of_number += holds / static_cast<double>(held.size());
        }
        if (of_number < coverage.worst_held) {
            coverage.worst_held = of_number;
            coverage.worst = i;
        }
    }
    if (coverage.numbers == 0) {
        return coverage;
    }
    for (double& h : held) {
        h /= static_cast<double>(coverage.numbers);
    }
    const Estimate e = estimate_mean(held);
    coverage.held = e.mean;
    coverage.error = e.standard_error;
    return coverage;
}

}  // namespace

std::vector<Coverage> coverage_of(
    const Case& it, const Effort& effort, unsigned seeds, std::uint64_t number) {
    std::vector<Answers> all;
    for (const Way way : ways_of(it)) {
        Answers answers;
        for (unsigned s = 0; s < seeds; ++s) {
            Effort own = effort;
            own.seed = mix64(mix64(number) + 7000 + 16 * s + static_cast<unsigned>(way)) >> 1;
            answers.push_back(compute(it, way, own));
        }
        all.push_back(std::move(answers));
    }
    std::vector<Coverage> result;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i][0].way != Way::reference && all[i][0].way != Way::plain_paths) {
            result.push_back(coverage_of_way(it, all, i));
        }
    }
    return result;
}

}  // namespace quasimc::stress
