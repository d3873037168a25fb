// A series whose time steps are computed together. Their common basis is solved first
// (series/basis/daylight_coefficients.h); each time step is a combination of it, and the direct
// light of its suns is computed separately (series/basis/season_suns.h).

#include "series/basis/season.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/process_time.h"
#include "light/source_origins.h"
#include "run/early_stop.h"
#include "run/evaluation_of.h"
#include "run/run_control.h"
#include "series/basis/daylight_coefficients.h"
#include "series/basis/season_suns.h"

namespace quasimc {
namespace {

/// Fraction of the progress of a series for its basis.
constexpr double kShareOfBasis = 0.5;
/// Memory and number of time steps that are combined together.
constexpr double kStepBatchBytes = 256e6, kMaxStepsInBatch = 16;

/// Groups in the form of SeriesSum. Their shares are quotients of sums, as the light is.
GroupResults without_fractions(GroupResults groups) {
    groups.sunlit_fraction.clear();
    groups.sunlit_area.clear();
    groups.ratio_values.clear();
    groups.ratios = 0;
    return groups;
}

class Season final : public SeriesSteps {
  public:
    explicit Season(const SeriesInput& input)
        : in_(input), plain_(input.spec), early_(input.control.stop) {
        plain_.origins.clear();
        for (const Region& region : in_.scene.regions()) {
            area_ += region.area;
            is_opaque_.push_back(!data_of(in_.scene).material(region).is_transparent());
        }
        early_.stop_at(deadline_of(in_.control, in_.spec).at());
        number_traces();
    }

    SeriesSummary run() {
        prepare();
        day_ = no_light();
        total_ = no_light();
        walk_series(in_, *this, summary_);
        if (is_requested(SeriesPart::total, in_.control)) {
            summary_.total = sum_of(total_);
        }
        if (is_requested(SeriesPart::sums, in_.control)) {
            report_total();
        }
        summary_.seconds = watch_.seconds();
        summary_.solve_seconds = watch_.seconds();
        summary_.solve_cpu_seconds = watch_.cpu_seconds();
        return std::move(summary_);
    }

  private:
    /// Light that is summed over times.
    struct Period {
        Period(const DaylightCoefficients& basis, std::size_t replicates)
            : amounts(basis.no_light()), suns(basis.layout(), replicates) {}
        DaylightCoefficients::Amounts amounts;  ///< x s, per direction
        LightSum suns;                          ///< x s; and the deviations of all time steps
        double seconds = 0;
    };

    /// By part of the light: all, then each origin.
    using PeriodOfParts = std::vector<Period>;
    [[nodiscard]] PeriodOfParts no_light() const {
        return {parts(), Period(*basis_, in_.spec.replicates)};
    }
    [[nodiscard]] std::size_t parts() const { return 1 + in_.spec.origins.size(); }
    /// The sources of each part of the light of a time step.
    [[nodiscard]] std::vector<Sources> sources_of_parts(std::size_t i) const {
        const Sources& all = in_.time_steps[i].sources;
        std::vector<Sources> parts = sources_by_origin(all, in_.spec.origins);
        parts.insert(parts.begin(), all);
        return parts;
    }

    /// Time steps that are combined together: responses are read once for all of them.
    struct Batch {
        std::size_t first = 0, end = 0;
        std::vector<DaylightCoefficients::Amounts> amounts;  // [time step][part of the light]
        std::vector<LightSum> light;                         // [time step][part of the light]
        std::vector<std::optional<LightResponse>> suns;
    };

    /// The basis has the first seed of the series, each lit time step the next.
    void number_traces() {
        std::uint64_t last = 0;
        for (const TimeStep& step : in_.time_steps) {
            const bool is_lit = !shining(step.sources, Shining::suns).empty() ||
                                !shining(step.sources, Shining::skies).empty();
            traces_.push_back(is_lit ? ++last : 0);
        }
    }

    [[nodiscard]] SunsOfTime suns_of(std::size_t i) const {
        return {shining(in_.time_steps[i].sources, Shining::suns), traces_[i]};
    }

    /// Computes the common basis of all time steps, and the number of pixels per sun.
    void prepare() {
        try {
            basis_.emplace(
                in_.simulator, in_.scene, in_.time_steps, in_.spec,
                RunControl{.stop = early_.token(), .work = work_.part(0, kShareOfBasis)});
            summary_.rays += basis_->rays();
            suns_.emplace(in_.simulator, in_.scene, in_.spec, basis_->layout(), early_.token());
            choose_pixels();
            work_.report(kShareOfBasis);
        } catch (const Stopped&) {
            throw Stopped(
                early_.why(),
                "stopped before the solutions for all directions were complete; there is no "
                "result");
        }
    }

    void choose_pixels() {
        std::vector<SunsOfTime> times;
        std::vector<SumWithVariance> others;
        for (const std::size_t i : basis_->reference_steps()) {
            times.push_back(suns_of(i));
            times.back().trace = in_.time_steps.size() + times.size();
            const DaylightCoefficients::Amounts amounts =
                basis_->amounts_of(in_.time_steps[i].sources, nullptr);
            others.push_back(basis_->light_of(amounts).spread(basis_->errors()));
        }
        suns_->choose_pixels(times, others);
    }

    /// The number of time steps that fit into memory.
    [[nodiscard]] std::size_t batch_size() const {
        const double each = sizeof(double) * static_cast<double>(basis_->layout().bins()) *
                            static_cast<double>(in_.spec.replicates * parts());
        return static_cast<std::size_t>(std::clamp(kStepBatchBytes / each, 1.0, kMaxStepsInBatch));
    }

    void fill_batch(std::size_t first) {
        batch_.amounts.clear();
        batch_.first = first;
        batch_.end = std::min(first + batch_size(), in_.time_steps.size());
        std::vector<SunsOfTime> suns;
        for (std::size_t i = first; i < batch_.end; ++i) {
            suns.push_back(suns_of(i));
        }
        batch_.suns = suns_->light_of(suns);
        for (std::size_t i = first; i < batch_.end; ++i) {
            const std::optional<LightResponse>& own = batch_.suns[i - first];
            for (const Sources& sources : sources_of_parts(i)) {
                batch_.amounts.push_back(basis_->amounts_of(sources, own ? &*own : nullptr));
            }
        }
        basis_->find_light(batch_.amounts, batch_.light);
    }

    void compute(std::size_t i) override {
        try {
            if (early_.token().stop_requested()) {
                throw Stopped(early_.why(), "");
            }
            if (i >= batch_.end) {
                fill_batch(i);
            }
        } catch (const Stopped&) {
            throw Stopped(
                early_.why(),
                "stopped before the first time step was complete; there is no result");
        }
        const std::vector<Sources> sources = sources_of_parts(i);
        for (std::size_t part = 0; part < parts(); ++part) {
            complete(i, part, !shining(sources[part], Shining::suns).empty());
        }
        if (traces_[i] > 0) {
            ++summary_.computed;
            ++summary_.methods[Method::ray_bundles];
        }
        if (is_requested(SeriesPart::time_steps, in_.control)) {
            const LightSum* light = &batch_.light[(i - batch_.first) * parts()];
            Result result = result_of(light[0], sources[0], area_);
            for (std::size_t part = 1; part < parts(); ++part) {
                result.origins.push_back(
                    {in_.spec.origins[part - 1], result_of(light[part], sources[part], 0)});
            }
            report_time_step(in_.control, {i, std::move(result), i});
        }
        work_.report(
            kShareOfBasis + (1 - kShareOfBasis) * static_cast<double>(i + 1) /
                                static_cast<double>(in_.time_steps.size()));
    }

    /// Adds deviations and the direct light of suns to a part of the light of a time step, and the
    /// part to its day and to the total.
    void complete(std::size_t i, std::size_t part, bool has_suns) {
        const double seconds = in_.time_steps[i].seconds;
        const std::size_t at = i - batch_.first;
        const DaylightCoefficients::Amounts& amounts = batch_.amounts[at * parts() + part];
        const std::optional<LightResponse>& suns = batch_.suns[at];
        LightSum& light = batch_.light[at * parts() + part];
        if (!light.is_dark()) {
            const LightSum deviations = light.deviations(basis_->errors(), is_opaque_, i);
            light.add(deviations, 1);
            day_[part].suns.add(deviations, seconds);
            total_[part].suns.add(deviations, seconds);
        }
        if (suns && has_suns) {
            light.add_suns(*suns, 1);
        }
        for (Period* period : {&day_[part], &total_[part]}) {
            for (std::size_t k = 0; k < amounts.size(); ++k) {
                period->amounts[k] += seconds * amounts[k];
            }
            if (suns && has_suns) {
                period->suns.add_suns(*suns, seconds);
            }
            period->seconds += seconds;
        }
    }

    /// The equivalent number of paths for the light of several suns, limited by their pixels.
    [[nodiscard]] std::uint64_t paths_of(std::size_t suns) const {
        const double pixels = suns_->pixels() * static_cast<double>(suns);
        return suns == 0 ? in_.spec.paths
                         : static_cast<std::uint64_t>(
                               std::min(pixels, static_cast<double>(in_.spec.paths)));
    }

    /// @param sources  of the time; empty for sums over times
    /// @param area  that suns may light; 0: sunlit areas are not reported
    [[nodiscard]] Result result_of(
        const LightSum& light, const Sources& sources, double area) const {
        if (light.is_dark()) {
            Result dark = zero_result(in_.scene, plain_);
            dark.stop = sources.empty() ? StopReason::finished : StopReason::no_light;
            return dark;
        }
        const std::size_t sunny = shining(sources, Shining::suns).size();
        const LightSum::Reading reading{paths_of(sunny), sunny > 0 ? area : 0};
        const EvaluationSpec asked = evaluation_of(in_.scene, sources, plain_);
        Result result = evaluate(light.sums(reading), in_.scene, asked);
        result.chosen = {
            Method::ray_bundles,
            fmt::format(
                "requested, with daylight coefficients of {} directions and time steps",
                basis_->lights())};
        return result;
    }

    [[nodiscard]] LightSum light_of(const Period& period) const {
        LightSum light = basis_->light_of(period.amounts);
        light.add(period.suns, 1);
        return light;
    }

    /// Reports the sums of the light of all time steps, and of each origin of it.
    void report_total() const {
        const EvaluationSpec asked = evaluation_of(in_.scene, {}, plain_);
        for (std::size_t part = 0; part < parts(); ++part) {
            const LightSum light = light_of(total_[part]);
            if (!light.is_dark()) {
                report_sums(
                    in_.control, {light.sums({paths_of(0), 0}), in_.scene, asked, 1,
                                  part == 0 ? SeriesSums::kAllLight : part - 1});
            }
        }
    }

    [[nodiscard]] SeriesSum sum_of(const Period& period) const {
        Result result = result_of(light_of(period), {}, 0);
        return {
            .bands = result.bands,
            .seconds = period.seconds,
            .values = std::move(result.values),
            .groups = without_fractions(std::move(result.groups)),
            .canopy = std::move(result.canopy),
            .origins = {}};
    }

    [[nodiscard]] SeriesSum sum_of(const PeriodOfParts& parts) const {
        SeriesSum sum = sum_of(parts.front());
        for (std::size_t part = 1; part < parts.size(); ++part) {
            sum.origins.push_back({in_.spec.origins[part - 1], sum_of(parts[part])});
        }
        return sum;
    }

    void finish_day(std::size_t last) override {
        if (is_requested(SeriesPart::days, in_.control)) {
            report_day(in_.control, in_.time_steps[last].day, sum_of(day_));
        }
        day_ = no_light();
    }

    const SeriesInput& in_;
    RunSpec plain_;  // without origins
    EarlyStop early_;
    Stopwatch watch_;
    Work work_ = work_of(in_.control);
    double area_ = 0;
    std::vector<bool> is_opaque_;        // by region
    std::vector<std::uint64_t> traces_;  // by time step; 0: no light
    std::optional<DaylightCoefficients> basis_;
    std::optional<SeasonSuns> suns_;
    PeriodOfParts day_, total_;
    Batch batch_;
    SeriesSummary summary_;
};

}  // namespace

SeriesSummary run_season(const SeriesInput& input) {
    Faults faults;
    check_together(input.scene, input.time_steps, input.spec, faults);
    const auto refuse = [&](bool is_so, std::string_view what) {
        if (is_so) {
            faults.add(
                {"time_method", fmt::format("it is \"daylight_coefficients\", with {}", what),
                 "daylight coefficients are computed by one process",
                 "use time_method = \"independent\""});
        }
    };
    const SumsOrigin& origin = input.control.origin;
    refuse(origin.states != nullptr, "a checkpoint");
    refuse(origin.team != nullptr, "several processes");
    refuse(origin.given != nullptr, "parts of a run");
    faults.throw_if_any();
    return Season(input).run();
}

}  // namespace quasimc
