#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "light/models/source.h"
#include "quasimc/series.h"

namespace quasimc {
namespace {

double sum_of_spectra(const TimeStep& time_step) {
    double sum = 0;
    for (const auto& source : time_step.sources) {
        for (const double x : source->spectrum()) {
            sum += x;
        }
    }
    return sum;
}

/// The factor from the light of `a` to that of `b`, if it is common to all sources and bands.
std::optional<double> factor_between(const TimeStep& a, const TimeStep& b) {
    constexpr double kRounding = 1e-12;
    const double factor = sum_of_spectra(b) / sum_of_spectra(a);
    if (a.sources.size() != b.sources.size()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < a.sources.size(); ++i) {
        const auto x = a.sources[i]->spectrum();
        const auto y = b.sources[i]->spectrum();
        const bool is_proportional =
            std::equal(x.begin(), x.end(), y.begin(), y.end(), [&](double p, double q) {
                return std::abs(q - factor * p) <= kRounding * std::max(q, factor * p);
            });
        if (!is_proportional) {
            return std::nullopt;
        }
    }
    return factor;
}

}  // namespace

std::vector<TimeStepPlan> plan_series(const std::vector<TimeStep>& time_steps) {
    std::vector<TimeStepPlan> plans;
    std::multimap<std::string_view, std::size_t> traced;
    for (std::size_t i = 0; i < time_steps.size(); ++i) {
        plans.push_back({i, sum_of_spectra(time_steps[i]) > 0 ? 1.0 : 0.0});
        if (plans[i].factor == 0) {
            continue;
        }
        const auto [first, last] = traced.equal_range(time_steps[i].directional_key);
        const auto same = std::find_if(first, last, [&](const auto& entry) {
            const auto factor = factor_between(time_steps[entry.second], time_steps[i]);
            if (factor) {
                plans[i] = {entry.second, *factor};
            }
            return factor.has_value();
        });
        if (same == last) {
            traced.emplace(time_steps[i].directional_key, i);
        }
    }
    return plans;
}

}  // namespace quasimc
