// A series whose times are computed together. What all of them have in common is solved first
// (run/season_basis.h); then each time is put together from it, and the light straight from its
// suns is found along scan lines of its own.

#include "run/season.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/process_time.h"
#include "results/patch_error.h"
#include "run/early_stop.h"
#include "run/season_basis.h"
#include "run/trace_spec.h"

namespace quasimc {
namespace {

/// Of the progress of a series, the part that what its times have in common takes.
constexpr double kShareOfBasis = 0.5;

/// Groups as SeriesSum has them.
GroupResults without_fractions(GroupResults groups) {
    groups.sunlit_fraction.clear();
    groups.sunlit_area.clear();
    groups.ratio_values.clear();
    groups.ratios = 0;
    return groups;
}

class Season {
  public:
    Season(
        Simulator& simulator,
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        const SeriesEvents& events,
        const std::stop_token& stop)
        : simulator_(simulator),
          scene_(scene),
          time_steps_(time_steps),
          spec_(spec),
          events_(events),
          early_(stop) {
        for (const Region& region : scene.regions()) {
            area_ += region.area;
        }
        if (spec.max_seconds > 0) {
            early_.set_limit(spec.max_seconds);
        }
    }

    SeriesSummary run() {
        make_basis();
        day_.emplace(*basis_, spec_.replicates);
        total_.emplace(*basis_, spec_.replicates);
        while (summary_.done < time_steps_.size() && go_on(summary_.done)) {
            const std::size_t i = summary_.done++;
            tell_progress(
                kShareOfBasis + (1 - kShareOfBasis) * static_cast<double>(summary_.done) /
                                    static_cast<double>(time_steps_.size()));
            if (summary_.done == time_steps_.size() ||
                time_steps_[i + 1].day != time_steps_[i].day) {
                finish_day(time_steps_[i].day);
            }
        }
        if (events_.wants_total) {
            summary_.total = sum_of(*total_);
        }
        summary_.seconds = watch_.seconds();
        summary_.trace_seconds = watch_.seconds();
        summary_.trace_cpu_seconds = watch_.cpu_seconds();
        return std::move(summary_);
    }

  private:
    /// Light that is summed over times.
    struct Period {
        Period(const SeasonBasis& basis, std::size_t replicates)
            : amounts(basis.no_light()), suns(basis.layout(), replicates) {}
        SeasonBasis::Amounts amounts;  ///< x s, of the directions
        LightSum suns;                 ///< x s
        double seconds = 0;
    };

    void make_basis() {
        try {
            basis_.emplace(
                simulator_, scene_, time_steps_, spec_,
                SeasonBasis::Control{
                    [this](double part) { tell_progress(kShareOfBasis * part); }, early_.token()});
        } catch (const Stopped&) {
            throw Stopped(
                early_.why(),
                "stopped before what all times have in common was computed: there "
                "is no result");
        }
        summary_.rays += basis_->rays();
    }

    void tell_progress(double fraction) const {
        if (events_.on_progress && fraction > 0) {
            events_.on_progress({fraction, watch_.seconds(), watch_.seconds() / fraction, 0});
        }
    }

    /// Computes a time. False, and no more is to be done, if there is no result of it.
    bool go_on(std::size_t i) {
        try {
            compute(i);
        } catch (const Stopped&) {
            if (i == 0) {
                throw Stopped(
                    early_.why(), "stopped before the first time was complete: there is no result");
            }
            summary_.stop = early_.why();
            return false;
        }
        return true;
    }

    void compute(std::size_t i) {
        if (early_.token().stop_requested()) {
            throw Stopped(early_.why(), "");
        }
        const TimeStep& step = time_steps_[i];
        const SeasonBasis::Amounts amounts = basis_->amounts_of(step.sources);
        const std::optional<LightResponse> suns = light_of_suns(step);
        for (Period* period : {&*day_, &*total_}) {
            for (std::size_t k = 0; k < amounts.size(); ++k) {
                period->amounts[k] += step.seconds * amounts[k];
            }
            if (suns) {
                period->suns.add_suns(*suns, step.seconds);
            }
            period->seconds += step.seconds;
        }
        if (!events_.on_time_step) {
            return;
        }
        LightSum direct(basis_->layout(), spec_.replicates);
        if (suns) {
            direct.add_suns(*suns, 1);
        }
        Result result = result_of(amounts, direct, step.sources);
        result.rays = rays_;
        events_.on_time_step(i, result, i);
    }

    /// Light straight from the suns of a time; none if none shines.
    [[nodiscard]] std::optional<LightResponse> light_of_suns(const TimeStep& step) {
        const Sources suns = shining(step.sources, Shining::suns);
        rays_ = 0;
        if (suns.empty() && shining(step.sources, Shining::skies).empty()) {
            return std::nullopt;
        }
        // The basis has the first seed of the series.
        RunSpec spec = trace_spec(spec_, {}, ++summary_.traced);
        ++summary_.methods[Method::ray_bundles];
        if (suns.empty()) {
            return std::nullopt;
        }
        spec.max_depth = 1;
        spec.max_seconds = 0;
        const Sums sums = simulator_.sums(scene_, suns, spec, 0, {}, {.stop = early_.token()});
        rays_ = count_rays(sums);
        summary_.rays += rays_;
        return read_response(sums, 0, basis_->layout());
    }

    /// @param sources  of the time; empty for sums over times
    [[nodiscard]] Result result_of(
        const SeasonBasis::Amounts& amounts, const LightSum& suns, const Sources& sources) const {
        LightSum light = basis_->light_of(amounts);
        LightSum raised = light;
        light += suns;
        if (light.is_dark()) {
            Result dark = dark_result(scene_, spec_);
            dark.stop = sources.empty() ? StopReason::paths_done : StopReason::no_light;
            return dark;
        }
        const bool is_sunny = !shining(sources, Shining::suns).empty();
        const LightSum::Reading reading{spec_.paths, is_sunny ? area_ : 0};
        Result result = evaluate_run(light.sums(reading), scene_, spec_, sources);
        raised.raise(basis_->errors());
        raised += suns;
        add_patch_errors(
            evaluate_run(coarser_sums(raised.sums(reading)), scene_, spec_, sources), result);
        result.chosen = {
            Method::ray_bundles,
            fmt::format(
                "as asked for: all times together, from the light of {} directions and times",
                basis_->lights())};
        return result;
    }

    [[nodiscard]] SeriesSum sum_of(const Period& period) const {
        Result result = result_of(period.amounts, period.suns, {});
        return {
            .bands = result.bands,
            .seconds = period.seconds,
            .values = std::move(result.values),
            .groups = without_fractions(std::move(result.groups))};
    }

    void finish_day(std::size_t day) {
        if (events_.on_day) {
            events_.on_day(day, sum_of(*day_));
        }
        day_.emplace(*basis_, spec_.replicates);
    }

    Simulator& simulator_;
    const Scene& scene_;
    const std::vector<TimeStep>& time_steps_;
    const RunSpec& spec_;
    const SeriesEvents& events_;
    EarlyStop early_;
    Stopwatch watch_;
    double area_ = 0;
    std::optional<SeasonBasis> basis_;
    std::optional<Period> day_, total_;
    std::uint64_t rays_ = 0;  // of the last time
    SeriesSummary summary_;
};

void check_together_sources(const std::vector<TimeStep>& time_steps, Faults& faults) {
    for (const TimeStep& step : time_steps) {
        for (const auto& source : step.sources) {
            const std::string place = fmt::format("source '{}'", source->name());
            if (source->is_lamp()) {
                faults.add(
                    {place, "a lamp, where series = \"together\"",
                     "only light from far away is put together from directions",
                     "use series = \"one_by_one\""});
                return;
            }
            if (source->is_sun() && !(beam_of(*source).to_light.z > 0)) {
                faults.add(
                    {place, "light from below the horizon, where series = \"together\"",
                     "light is put together from directions of the upper hemisphere",
                     "use series = \"one_by_one\""});
                return;
            }
        }
    }
}

}  // namespace

void check_together(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    Faults& faults) {
    if (spec.series != SeriesMode::together) {
        return;
    }
    const auto refuse = [&](bool is_so, std::string problem, std::string why, std::string what) {
        if (is_so) {
            faults.add({"series", std::move(problem), std::move(why), std::move(what)});
        }
    };
    refuse(
        spec.method != Method::ray_bundles, "it is \"together\", and method is not ray_bundles",
        "no other way of computing solves for many lights at once",
        "state method = \"ray_bundles\"");
    refuse(
        spec.target_error > 0 || spec.max_paths > 0,
        "it is \"together\", with target_error or max_paths",
        "what all times have in common is computed once, with paths", "state paths alone");
    refuse(
        spec.audit > 0, "it is \"together\", with audit", "no time is a run that could be audited",
        "audit one_by_one");
    refuse(
        spec.effort == Effort::day, "it is \"together\", with effort = \"day\"",
        "all times have the same paths", "leave effort out");
    refuse(
        !scene.detectors().empty(), "it is \"together\", and the scene has detectors",
        "light that escapes is not kept by direction", "use series = \"one_by_one\"");
    check_together_sources(time_steps, faults);
}

SeriesSummary run_season(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const SeriesEvents& events,
    const std::stop_token& stop) {
    Faults faults;
    check_together(scene, time_steps, spec, faults);
    const auto refuse = [&](bool is_so, std::string_view what) {
        if (is_so) {
            faults.add(
                {"series", fmt::format("it is \"together\", with {}", what),
                 "what all times have in common is computed by one process, in one go",
                 "use series = \"one_by_one\""});
        }
    };
    refuse(events.checkpoint != nullptr, "a checkpoint");
    refuse(events.team != nullptr || events.traced_runs != nullptr, "several processes");
    refuse(static_cast<bool>(events.sums_of), "parts of a run");
    faults.throw_if_any();
    return Season(simulator, scene, time_steps, spec, events, stop).run();
}

}  // namespace quasimc
