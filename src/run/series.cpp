// A series: the light of many moments on one scene.
//
// Moments that are lit alike, but for one factor, share a trace. A result is kept until no later
// moment needs it and the sums it counts for are done, so that a season takes no more memory than a
// day.

#include "quasimc/series.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "base/checks.h"
#include "results/evaluate.h"
#include "run/series_sum.h"
#include "run/simulator.h"
#include "samplers/hash.h"

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

/// The factor from the light of `a` to that of `b`, if it is one for all sources and bands.
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

/// A seed for each trace (SplitMix64: Steele, Lea and Flood 2014).
std::uint64_t seed_of(std::uint64_t seed, std::uint64_t trace) {
    if (trace == 0) {
        return seed;
    }
    return mix64(seed + trace * 0x9E3779B97F4A7C15U);
}

/// Traces a series, moment by moment.
class SeriesRun {
  public:
    SeriesRun(
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        const SeriesEvents& events)
        : scene_(scene), time_steps_(time_steps), spec_(spec), events_(events) {
        plans_ = plan_series(time_steps);
        for (std::size_t i = 0; i < time_steps.size(); ++i) {
            if (plans_[i].factor > 0) {
                last_use_[plans_[i].traced] = i;
            }
        }
    }

    SeriesSummary run() {
        for (std::size_t i = 0; i < time_steps_.size(); ++i) {
            trace(i);
            const bool ends_day =
                i + 1 == time_steps_.size() || time_steps_[i + 1].day != time_steps_[i].day;
            if (ends_day) {
                finish_day(i);
            }
        }
        if (events_.wants_total) {
            summary_.total = sum_of(total_);
        }
        summary_.seconds = seconds();
        const auto audits = static_cast<double>(std::max<std::size_t>(summary_.audited, 1));
        summary_.audit_chance = std::min(1.0, least_chance_ * audits);
        return std::move(summary_);
    }

  private:
    /// A trace that is still needed, and what it counts for.
    struct Kept {
        Result result;
        double day_weight = 0, total_weight = 0;
    };

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }

    void trace(std::size_t i) {
        const TimeStepPlan& plan = plans_[i];
        const TimeStep& time_step = time_steps_[i];
        day_.add_seconds(time_step.seconds);
        total_.add_seconds(time_step.seconds);
        if (plan.factor == 0) {
            if (!dark_) {
                dark_ = dark_result(scene_, spec_);
            }
            tell(i, *dark_);
            return;
        }
        if (plan.traced == i) {
            kept_[i].result = trace_one(i);
        }
        Kept& kept = kept_[plan.traced];
        kept.day_weight += plan.factor * time_step.seconds;
        kept.total_weight += plan.factor * time_step.seconds;
        if (plan.traced == i) {
            tell(i, kept.result);
        } else if (events_.on_time_step) {
            tell(i, scaled(kept.result, plan.factor));
        }
    }

    void tell(std::size_t i, const Result& result) {
        if (events_.on_time_step) {
            events_.on_time_step(i, result, plans_[i].factor > 0 ? plans_[i].traced : i);
        }
    }

    Result trace_one(std::size_t i) {
        RunSpec spec = spec_;
        spec.seed = seed_of(spec_.seed, summary_.traced);
        Result result = simulator_.run(scene_, time_steps_[i].sources, spec, progress_of(i));
        ++summary_.traced;
        ++summary_.methods[result.chosen.method];
        const bool is_unlit = result.stop == StopReason::no_light;
        summary_.unlit += is_unlit ? 1 : 0;
        summary_.at_target += is_unlit || result.stop == StopReason::target_reached ? 1 : 0;
        summary_.rays += result.rays;
        if (result.audit) {
            ++summary_.audited;
            least_chance_ = std::min(least_chance_, result.audit->chance);
        }
        return result;
    }

    /// Progress of the series: traces take about equally long.
    [[nodiscard]] std::function<void(const Progress&)> progress_of(std::size_t i) const {
        if (!events_.on_progress) {
            return {};
        }
        return [this, i](const Progress& own) {
            const auto before = static_cast<double>(i);
            const double fraction =
                (before + own.fraction) / static_cast<double>(time_steps_.size());
            events_.on_progress(
                {fraction, seconds(), seconds() / fraction, own.fraction_at_target});
        };
    }

    [[nodiscard]] SeriesSum sum_of(const SeriesAdder& adder) const {
        const std::size_t bands = scene_.bands().size();
        return adder.sum(bands, scene_.organs().size() * kQuantities * bands);
    }

    void finish_day(std::size_t last) {
        for (auto it = kept_.begin(); it != kept_.end();) {
            Kept& kept = it->second;
            if (events_.on_day && kept.day_weight > 0) {
                day_.add(kept.result, kept.day_weight);
                kept.day_weight = 0;
            }
            const bool is_needed = last_use_[it->first] > last;
            if (events_.wants_total && !is_needed && kept.total_weight > 0) {
                total_.add(kept.result, kept.total_weight);
            }
            it = is_needed ? std::next(it) : kept_.erase(it);
        }
        if (events_.on_day) {
            events_.on_day(time_steps_[last].day, sum_of(day_));
        }
        day_ = {};
    }

    using Clock = std::chrono::steady_clock;

    const Scene& scene_;
    const std::vector<TimeStep>& time_steps_;
    const RunSpec& spec_;
    const SeriesEvents& events_;
    Simulator simulator_;
    Clock::time_point start_ = Clock::now();
    std::vector<TimeStepPlan> plans_;
    std::map<std::size_t, std::size_t> last_use_;  // of a trace, by the moment traced
    std::map<std::size_t, Kept> kept_;
    SeriesAdder day_, total_;
    std::optional<Result> dark_;  // once it was needed
    double least_chance_ = 1;     // of an audit
    SeriesSummary summary_;
};

}  // namespace

std::vector<TimeStepPlan> plan_series(const std::vector<TimeStep>& time_steps) {
    std::vector<TimeStepPlan> plans;
    std::multimap<std::string_view, std::size_t> traced;
    for (std::size_t i = 0; i < time_steps.size(); ++i) {
        plans.push_back({i, sum_of_spectra(time_steps[i]) > 0 ? 1.0 : 0.0});
        if (plans[i].factor == 0) {
            continue;
        }
        const auto [first, last] = traced.equal_range(time_steps[i].shapes);
        const auto same = std::find_if(first, last, [&](const auto& entry) {
            const auto factor = factor_between(time_steps[entry.second], time_steps[i]);
            if (factor) {
                plans[i] = {entry.second, *factor};
            }
            return factor.has_value();
        });
        if (same == last) {
            traced.emplace(time_steps[i].shapes, i);
        }
    }
    return plans;
}

Result scaled(const Result& result, double factor) {
    Result copy = result;
    for (Estimate& estimate : copy.values) {
        estimate = scaled(estimate, factor);
    }
    for (BandBudget& band : copy.budget) {
        band.emitted *= factor;
        for (Estimate BandBudget::*part :
             {&BandBudget::absorbed_by_organs, &BandBudget::absorbed_by_ground,
              &BandBudget::escaped, &BandBudget::cut_off, &BandBudget::roulette}) {
            band.*part = scaled(band.*part, factor);
        }
    }
    for (DetectorResult& detector : copy.detectors) {
        for (Estimate& estimate : detector.values) {
            estimate = scaled(estimate, factor);
        }
    }
    if (copy.audit) {
        for (BandAudit& band : copy.audit->bands) {
            band.difference *= factor;
            band.standard_error *= factor;
        }
    }
    return copy;
}

Result dark_result(const Scene& scene, const RunSpec& spec) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Result dark;
    dark.bands = scene.bands().size();
    dark.ratios = spec.ratios.size();
    dark.values.resize(scene.organs().size() * kQuantities * dark.bands);
    dark.ratio_values.resize(scene.organs().size() * dark.ratios, {kNan, kNan, kNan, kNan});
    dark.budget.resize(dark.bands);
    dark.detectors = dark_detectors(scene);
    dark.replicates = spec.replicates;
    dark.chosen.reason = "it is dark, nothing was traced";
    return dark;
}

SeriesSummary run_series(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const SeriesEvents& events) {
    EXPECT(std::is_sorted(time_steps.begin(), time_steps.end(), [](const auto& a, const auto& b) {
        return a.day < b.day;
    }));
    return SeriesRun(scene, time_steps, spec, events).run();
}

}  // namespace quasimc
