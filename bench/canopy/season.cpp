// The time of a year of hours with daylight coefficients, relative to one hour at the same error.
// The year is extrapolated from some of its days, half of them overcast: the basis is timed once,
// and an hour by the mean of the sample.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/process_time.h"
#include "light/daylight/hour_light.h"
#include "parts.h"
#include "quasimc/series.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr double kTarget = 0.02;
constexpr double kHoursOfYear = 4400, kMaxHours = 40;
constexpr double kHour = 3600;
constexpr int kMonths = 12, kDayHours = 24;

std::vector<TimeStep> sample_of_year() {
    const Site site{.latitude_deg = 51.97, .longitude_deg = 5.67};
    DaylightSources how;
    how.bands = {{400, 700}, {700, 1100}};
    std::vector<TimeStep> hours;
    for (int month = 1; month <= kMonths; ++month) {
        for (int hour = 0; hour < kDayHours; ++hour) {
            const SunPath path = sun_path(site, {2024, month, 15, hour, 0, 0, 1}, kHour, 300);
            HourLight light = clear_light(path, {});
            if (month % 2 == 0) {
                const Reading overcast{
                    .global = light.daylight.global() / 3, .diffuse = light.daylight.global() / 3};
                light = measured_light(
                    path, overcast, LightUnit::full_spectrum, DiffuseModel::erbs, how.spectra);
            }
            HourSources sources = make_hour_sources(make_hour_parts(path, light, how));
            if (!sources.sources.empty()) {
                hours.push_back(
                    {"hour", std::move(sources.sources), std::move(sources.directional_key), kHour,
                     static_cast<std::size_t>(month)});
            }
        }
    }
    return hours;
}

TimeStep brightest(const std::vector<TimeStep>& hours) {
    const auto light = [](const TimeStep& hour) {
        double sum = 0;
        for (const auto& source : hour.sources) {
            sum += source->spectrum()[0] * source->horizontal_irradiance();
        }
        return sum;
    };
    return *std::max_element(hours.begin(), hours.end(), [&](const auto& a, const auto& b) {
        return light(a) < light(b);
    });
}

/// Root mean square of the errors of the organs' absorbed flux, over its mean, in the worst band.
double error_of(const Result& result) {
    double worst = 0;
    for (std::size_t b = 0; b < result.bands; ++b) {
        double squares = 0, sum = 0;
        for (std::size_t i = 0; i < result.organs(); ++i) {
            const Estimate& e = result.at(i, Quantity::absorbed_flux_density, b);
            squares += e.standard_error * e.standard_error;
            sum += e.mean;
        }
        const auto organs = static_cast<double>(result.organs());
        worst = std::max(worst, std::sqrt(squares / organs) / (sum / organs));
    }
    return worst;
}

struct Cost {
    double seconds = 0, before = 0, each = 0;  ///< all, before the first hour, and per hour
    double error = 0;                          ///< median of the hours
};

/// Records the time when the basis is complete, and the errors of the hours.
class HourErrors final : public RunListener {
  public:
    /// Called when the basis is complete; hours are computed in batches.
    void on_progress(const Progress& /*progress*/) override {
        before = errors.empty() ? watch.cpu_seconds() : before;
    }
    void on_time_step(const TimeStepResult& step) override {
        errors.push_back(error_of(step.result));
    }

    Stopwatch watch;
    double before = 0;
    std::vector<double> errors;
};

Cost cost_of(const Scene& scene, const std::vector<TimeStep>& hours, const RunSpec& spec) {
    HourErrors heard;
    run_series(scene, hours, spec, {.listeners = {&heard}});
    std::vector<double>& errors = heard.errors;
    const double before = heard.before;
    const double all = heard.watch.cpu_seconds();
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return {all, before, (all - before) / static_cast<double>(errors.size()), *middle};
}

/// The first number of paths with an error below the target, by repeated doubling of the
/// specification's.
std::pair<std::uint64_t, Cost> cost_at_target(
    const Scene& scene, const std::vector<TimeStep>& hours, RunSpec spec) {
    constexpr std::uint64_t kLast = 1 << 18;
    Cost cost;
    for (; spec.paths <= kLast; spec.paths *= 2) {
        cost = cost_of(scene, hours, spec);
        if (cost.error <= kTarget) {
            break;
        }
    }
    return {std::min(spec.paths, kLast), cost};
}

}  // namespace

void print_season(const Effort& effort) {
    const bool is_quick = effort.most_leaves <= 10000;
    const std::uint32_t leaves = is_quick ? 1000 : 10000;
    const Scene scene = make_canopy({.leaves = leaves, .albedos = {0.2, 0.85}, .seed = 7});
    const std::vector<TimeStep> hours = sample_of_year();
    RunSpec spec;
    spec.method = Method::ray_bundles;
    spec.threads = 1;
    spec.paths = 1 << 12;
    const std::vector<TimeStep> noon{brightest(hours)};
    const auto [paths, one] = cost_at_target(scene, noon, spec);
    spec.time_method = TimeMethod::daylight_coefficients;
    spec.paths = paths;
    const auto [paths_together, all] = cost_at_target(scene, hours, spec);
    const double year = all.before + kHoursOfYear * all.each;
    std::printf(
        "  season, %u leaves, PAR and NIR: an hour to %.1f %% in %.2f s (%lu paths); together to "
        "%.1f %% (%lu paths) %.1f s and %.3f s an hour, a year %.0f times the hour (at most %g: "
        "%s)\n",
        leaves, 100 * one.error, one.seconds, paths, 100 * all.error, paths_together, all.before,
        all.each, year / one.seconds, kMaxHours,
        year <= kMaxHours * one.seconds ? "met" : "MISSED");
}

}  // namespace quasimc::bench
