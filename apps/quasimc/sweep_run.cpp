#include "sweep_run.h"

#include <algorithm>
#include <string>
#include <utility>

#include "part_run.h"
#include "progress.h"
#include "series/trace_spec.h"

namespace {

/// Adds the summary of a point to that of the sweep.
void add_point(const quasimc::SeriesSummary& point, quasimc::SeriesSummary& all) {
    all.computed += point.computed;
    all.unlit += point.unlit;
    all.at_target += point.at_target;
    all.completed += point.completed;
    all.with_fewer_paths += point.with_fewer_paths;
    all.without_sensors += point.without_sensors;
    all.stop = point.stop == quasimc::StopReason::finished ? all.stop : point.stop;
    // The smallest p value times the number of audits (Bonferroni).
    if (point.audited > 0) {
        const double count = static_cast<double>(all.audited);
        const double own = static_cast<double>(point.audited);
        const double least =
            std::min(count > 0 ? all.audit_p_value / count : 1.0, point.audit_p_value / own);
        all.audited += point.audited;
        all.audit_p_value = std::min(1.0, least * (count + own));
    }
    all.rays += point.rays;
    all.seconds += point.seconds;
    all.preparation_seconds += point.preparation_seconds;
    all.solve_seconds += point.solve_seconds;
    all.solve_cpu_seconds += point.solve_cpu_seconds;
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
      progress_line_(progress_lines(arguments)) {
    if (arguments.view) {
        window_.emplace(*run_, 0);
    }
    if (team != nullptr) {
        const std::size_t traces = quasimc::traces_of(run_->scene, time_steps_, run_->spec).size();
        is_dealt_ = traces * sweep.size() >= team->size() && team->size() > 1;
    }
}

void SweepRun::compute() {
    const double limit = run_->spec.max_seconds;
    deadline_ = limit > 0 ? quasimc::Deadline::after(limit) : quasimc::Deadline();
    work_ = quasimc::Work(listeners());
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
        all_.preparation_seconds += reading_seconds_;
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
    time_steps_ = quasimc::time_steps_of(*run, simulator_);
    reading_seconds_ += watch.seconds();
    apply_choice(arguments_.choice, *run);
    return run;
}

bool SweepRun::goes_on() {
    if (deadline_.is_over() && all_.stop != quasimc::StopReason::interrupted) {
        last_.stop = all_.stop = quasimc::StopReason::time_limit;
        return false;
    }
    return last_.stop != quasimc::StopReason::interrupted;
}

bool SweepRun::trace(const std::stop_token& stop) {
    const quasimc::Stopwatch watch;
    try {
        checkpoint_.set_time_steps_before(time_steps_before_);
        const bool is_last = point_ + 1 == sweep_.size();
        const quasimc::RunControl own = control(stop);
        last_ = is_last
                    ? quasimc::run_series(
                          std::move(simulator_), run_->scene, time_steps_, run_->spec, own)
                    : quasimc::run_series(simulator_, run_->scene, time_steps_, run_->spec, own);
        time_steps_before_ += time_steps_.size();
    } catch (const quasimc::Stopped& stopped) {
        checkpoint_.flush();
        if (point_ == 0) {
            throw;
        }
        last_ = {};
        last_.seconds = last_.solve_seconds = watch.seconds();
        last_.solve_cpu_seconds = watch.cpu_seconds();
        last_.stop = stopped.why();
        add_point(last_, all_);
        return false;
    } catch (const quasimc::InputError& error) {
        checkpoint_.flush();
        if (writers_.are_all_given_up()) {
            throw;  // the error names these files
        }
        quasimc::Faults faults = writers_.faults();
        faults.add(
            parts_ != nullptr ? error : error_of_file(error, *run_, arguments_.flags.overrides()));
        faults.throw_if_any();
    }
    add_point(last_, all_);
    return true;
}

std::vector<quasimc::RunListener*> SweepRun::listeners() {
    std::vector<quasimc::RunListener*> listeners{&progress_line_, &writers_, &checkpoint_};
    if (window_) {
        listeners.push_back(&*window_);
    }
    return listeners;
}

quasimc::RunControl SweepRun::control(const std::stop_token& stop) {
    const auto points = static_cast<double>(sweep_.size());
    const auto done = static_cast<double>(point_);
    const bool is_dealt = is_dealt_ && quasimc::is_dealt(run_->spec);
    return {
        .stop = stop,
        .deadline = sweep_.size() == 1 ? deadline_ : deadline_.share(1 / (points - done)),
        .listeners = listeners(),
        .origin =
            {.given = parts_ != nullptr || is_dealt ? this : nullptr,
             .states = checkpoint_.states(),
             .team = dealt_ ? nullptr : team_,
             .point = point_},
        .work = work_.part(done / points, 1 / points)};
}

std::optional<quasimc::GivenSums> SweepRun::sums_of(
    std::size_t time_step, const quasimc::RunSpec& spec, const quasimc::RunControl& control) {
    if (parts_ != nullptr) {
        return quasimc::GivenSums{parts_->next(time_steps_before_ + time_step)};
    }
    if (!dealt_ && checkpoint_.has_state(time_step)) {
        return std::nullopt;
    }
    if (!dealt_) {
        dealt_ = std::make_unique<quasimc::DealtRuns>(*team_, point_, time_step);
    }
    return dealt_->next(simulator_, run_->scene, time_steps_[time_step].sources, spec, control);
}
