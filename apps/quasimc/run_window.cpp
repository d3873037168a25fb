#include "run_window.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interrupt.h"
#include "resultio/describe_result.h"
#include "show_values.h"
#include "window/page.h"
#include "window/window_parts.h"

namespace {

quasimc::ViewerRoutes site_of(const std::shared_ptr<quasimc::LiveWindow>& window) {
    quasimc::require_page("--view");
    return {
        [window](std::string_view name) { return window->file(name); }, quasimc::random_token(),
        quasimc::WindowKind::live};
}

}  // namespace

RunWindow::RunWindow(const quasimc::RunFile& first, int port) : server_(site_of(window_), port) {
    next_run(first);
    window_->send("the scene is being prepared");
    fmt::print(stderr, "view: {}\n", server_.address());
}

void RunWindow::next_run(const quasimc::RunFile& run) {
    run_ = &run;
    newest_.reset();
    finished_ = 0;
    std::vector<std::string> coming;
    for (const std::size_t step : lit_steps()) {
        coming.push_back(label_of(step));
    }
    scene_ = std::make_shared<const quasimc::LiveScene>(quasimc::LiveScene{
        .scene = std::make_shared<const quasimc::Scene>(run.scene),
        .bands = run.scene.bands(),
        .ratios = run.spec.ratios,
        .title = quasimc::title_of(run),
        .coming = std::move(coming),
        .head = quasimc::window_run_head(run)});
}

void RunWindow::on_progress(const quasimc::Progress& progress) {
    window_->send(describe(progress), progress.fraction);
}

void RunWindow::on_time_step(const quasimc::TimeStepResult& step) {
    finished_ += run_->series && !run_->series->time_steps[step.time_step].sources.empty() ? 1 : 0;
    add(step.time_step, step.result);
}

bool RunWindow::is_due() const {
    return Clock::now() >= not_before_ && window_->is_watched();
}

bool RunWindow::wants_pause() {
    return Clock::now() >= ask_after_ && is_due();
}

void RunWindow::on_pause(const quasimc::RunSoFar& run) {
    constexpr std::size_t kMinReplicates = 2;  // for an error
    if (run.replicates() < kMinReplicates || run.replicates() <= shown_) {
        constexpr std::chrono::milliseconds kPatience{20};  // a pause for nothing costs as well
        ask_after_ = Clock::now() + kPatience;
        return;
    }
    shown_ = run.replicates();
    show(run);
}

void RunWindow::on_round(const quasimc::RunSoFar& run) {
    shown_ = 0;
    if (is_due()) {
        show(run);
    }
}

void RunWindow::show(const quasimc::RunSoFar& run) {
    constexpr std::chrono::milliseconds kBetween{300};
    constexpr int kPauseFactor = 20;  // pause over the time that an update takes
    const Clock::time_point start = Clock::now();
    add(run.time_step(), run.result());
    const Clock::time_point end = Clock::now();
    not_before_ = end + std::max<Clock::duration>(kBetween, kPauseFactor * (end - start));
}

void RunWindow::add(std::size_t time_step, quasimc::Result result) {
    const quasimc::Sources& sources =
        run_->series ? run_->series->time_steps[time_step].sources : run_->sources;
    quasimc::LiveFrame frame{
        .label = label_of(time_step),
        .scene = scene_,
        .sources = sources,
        .head = quasimc::window_light_head(*run_, result)};
    std::vector<quasimc::Result> results;
    results.push_back(std::move(result));
    frame.results = std::make_shared<const std::vector<quasimc::Result>>(std::move(results));
    if (newest_ == time_step) {
        window_->replace_newest(std::move(frame));
    } else {
        window_->add(std::move(frame));
    }
    newest_ = time_step;
}

std::string RunWindow::label_of(std::size_t time_step) const {
    std::string label = run_->sweep ? fmt::format("point {}", run_->point + 1) : "";
    if (run_->series) {
        label += (label.empty() ? "" : ", ") + run_->series->notes[time_step].time;
    }
    return label;
}

std::vector<std::size_t> RunWindow::lit_steps() const {
    std::vector<std::size_t> steps;
    for (std::size_t i = 0; run_->series && i < run_->series->time_steps.size(); ++i) {
        if (!run_->series->time_steps[i].sources.empty()) {
            steps.push_back(i);
        }
    }
    return steps;
}

/// "Computing: 9 of 17 hours, about 40 s left".
std::string RunWindow::describe(const quasimc::Progress& progress) const {
    std::string text = "Computing: ";
    if (run_->sweep) {
        text += fmt::format("point {} of {}, ", run_->point + 1, run_->sweep->size());
    }
    if (run_->series) {
        constexpr double kHour = 3600;
        const auto& steps = run_->series->time_steps;
        const bool is_hourly = std::ranges::all_of(
            steps, [](const quasimc::TimeStep& step) { return step.seconds == kHour; });
        text += fmt::format(
            "{} of {} {}, ", finished_, lit_steps().size(), is_hourly ? "hours" : "times");
    }
    text += fmt::format(
        "about {:.0f} s left", std::max(0.0, progress.expected_seconds - progress.seconds));
    if (progress.fraction_at_target > 0) {
        text += fmt::format(", {:.1f} % at the target", 100 * progress.fraction_at_target);
    }
    return text;
}

void RunWindow::finish(quasimc::StopReason stop) {
    window_->end(
        stop == quasimc::StopReason::interrupted ? "The run was stopped."
                                                 : "The run has finished.");
}

void RunWindow::stay() {
    fmt::print(stderr, "The page stays until Ctrl-C.\n");
    InterruptWatch([] {}).wait_for_first();
}
