#include "sweep_run.h"

#include <algorithm>
#include <string>
#include <utility>

#include "part_run.h"
#include "progress.h"
#include "series/trace_spec.h"

namespace {

/// What all points of a sweep have together.
void add_point(const quasimc::SeriesSummary& point, quasimc::SeriesSummary& all) {
    all.traced += point.traced;
    all.unlit += point.unlit;
    all.at_target += point.at_target;
    all.done += point.done;
    all.cut_short += point.cut_short;
    all.stop = point.stop == quasimc::StopReason::paths_done ? all.stop : point.stop;
    // Of the most unlikely audit, times their number.
    if (point.audited > 0) {
        const double count = static_cast<double>(all.audited);
        const double own = static_cast<double>(point.audited);
        const double least =
            std::min(count > 0 ? all.audit_chance / count : 1.0, point.audit_chance / own);
        all.audited += point.audited;
        all.audit_chance = std::min(1.0, least * (count + own));
    }
    all.rays += point.rays;
    all.seconds += point.seconds;
    all.build_seconds += point.build_seconds;
    all.trace_seconds += point.trace_seconds;
    all.trace_cpu_seconds += point.trace_cpu_seconds;
    for (const auto& [method, times] : point.methods) {
        all.methods[method] += times;
    }
}

}  // namespace

SweepRun::SweepRun(
    const RunArguments& arguments,
    quasimc::RunSweep& sweep,
    quasimc::PartFiles* parts,
    quasimc::RunTeam* team,
    const quasimc::Stopwatch& reading)
    : arguments_(arguments),
      sweep_(sweep),
      parts_(parts),
      team_(team),
      reading_seconds_(reading.seconds()),
      run_(next_file(0)),
      writers_(arguments, *run_),
      interrupt_(std::in_place, stopping_note(arguments)),
      checkpoint_(arguments, *run_),
      tell_(progress_line(progress_lines(arguments))) {
    if (arguments.view) {
        window_.emplace(*run_, 0);
    }
    if (team != nullptr) {
        const std::size_t traces =
            quasimc::traces_of(run_->scene, quasimc::moments_of(*run_), run_->spec).size();
        is_dealt_ = traces * sweep.size() >= team->size && team->size > 1;
    }
}

void SweepRun::compute() {
    while (trace(interrupt_->token()) && point_ + 1 < sweep_.size() && goes_on()) {
        std::unique_ptr<quasimc::RunFile> next = next_file(++point_);
        writers_.next_run(*next, last_);
        if (window_) {
            window_->next_run(*next);
        }
        run_ = std::move(next);
    }
    if (sweep_.size() > 1) {
        all_.seconds += reading_seconds_;
        all_.build_seconds += reading_seconds_;
    }
    checkpoint_.flush();
    dealt_.reset();
    if (window_) {
        window_->finish(all_.stop);
    }
    interrupt_.reset();
}

void SweepRun::stay() const {
    if (window_ && all_.stop != quasimc::StopReason::interrupted) {
        RunWindow::stay();
    }
}

std::unique_ptr<quasimc::RunFile> SweepRun::next_file(std::size_t point) {
    const quasimc::Stopwatch watch;
    auto run = std::make_unique<quasimc::RunFile>(sweep_.take(point));
    reading_seconds_ += watch.seconds();
    apply_choice(arguments_.choice, *run);
    return run;
}

bool SweepRun::goes_on() {
    const double limit = run_->spec.max_seconds;
    if (limit > 0 && all_.seconds >= limit && all_.stop != quasimc::StopReason::interrupted) {
        last_.stop = all_.stop = quasimc::StopReason::time_is_up;
        return false;
    }
    return last_.stop != quasimc::StopReason::interrupted;
}

bool SweepRun::trace(const std::stop_token& stop) {
    quasimc::RunSpec spec = run_->spec;
    const auto points_left = static_cast<double>(sweep_.size() - point_);
    if (spec.max_seconds > 0) {
        constexpr double kLeast = 1e-3;
        spec.max_seconds = std::max(spec.max_seconds - all_.seconds, kLeast) / points_left;
    }
    const quasimc::Stopwatch watch;
    try {
        moments_ = quasimc::moments_of(*run_);
        checkpoint_.set_moments_before(moments_before_);
        last_ = quasimc::run_series(simulator_, run_->scene, moments_, spec, events(), stop);
        moments_before_ += moments_.size();
    } catch (const quasimc::Stopped& stopped) {
        checkpoint_.flush();
        if (point_ == 0) {
            throw;
        }
        last_ = {};
        last_.seconds = last_.trace_seconds = watch.seconds();
        last_.trace_cpu_seconds = watch.cpu_seconds();
        last_.stop = stopped.why();
        add_point(last_, all_);
        return false;
    } catch (const quasimc::InputError& error) {
        writers_.throw_if_given_up();
        if (parts_ != nullptr) {
            throw;
        }
        rethrow_of_file(error, *run_, arguments_.flags.overrides());
    }
    add_point(last_, all_);
    return true;
}

std::function<void(const quasimc::Progress&)> SweepRun::progress() const {
    if (!tell_ || sweep_.size() == 1) {
        return tell_;
    }
    return [this](const quasimc::Progress& own) {
        const double fraction =
            (static_cast<double>(point_) + own.fraction) / static_cast<double>(sweep_.size());
        const double seconds = all_.seconds + own.seconds;
        tell_({fraction, seconds, seconds / fraction, own.fraction_at_target});
    };
}

quasimc::SeriesEvents SweepRun::events() {
    quasimc::SeriesEvents events = writers_.events(progress());
    if (window_) {
        window_->listen(events);
    }
    events.is_last = point_ + 1 == sweep_.size();
    events.checkpoint = checkpoint_.hooks();
    if (team_ != nullptr) {
        team_->point = point_;
        events.team = dealt_ ? nullptr : team_;
        if (is_dealt_ && quasimc::is_dealt(run_->spec)) {
            events.sums_of = [this](auto&&... of_run) { return dealt_sums(of_run...); };
        }
    }
    if (parts_ != nullptr) {
        events.sums_of = [this](std::size_t moment, const auto&...) {
            return quasimc::GivenSums{parts_->next(moments_before_ + moment)};
        };
    }
    return events;
}

std::optional<quasimc::GivenSums> SweepRun::dealt_sums(
    std::size_t moment, const quasimc::RunSpec& spec, const quasimc::RunControl& control) {
    const quasimc::RunCheckpoint* kept = checkpoint_.hooks();
    if (!dealt_ && kept != nullptr && kept->has_state(moment)) {
        return std::nullopt;
    }
    if (!dealt_) {
        dealt_ = std::make_unique<quasimc::DealtRuns>(*team_, point_, moment);
    }
    return dealt_->next(simulator_, run_->scene, moments_[moment].sources, spec, control);
}
