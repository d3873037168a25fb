#include "run_window.h"

#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interrupt.h"
#include "progress.h"
#include "show_values.h"
#include "window/page.h"
#include "window/window_parts.h"

namespace {

quasimc::WindowSite site_of(const std::shared_ptr<quasimc::LiveWindow>& window) {
    quasimc::require_page("--view");
    return {
        [window](std::string_view name) { return window->file(name); }, quasimc::random_token(),
        quasimc::WindowKind::live};
}

}  // namespace

RunWindow::RunWindow(const quasimc::RunFile& first, int port) : server_(site_of(window_), port) {
    preview_.is_wanted = [this] { return window_->is_watched(); };
    preview_.on_result = [this](std::size_t moment, quasimc::Result result) {
        add(moment, std::move(result));
    };
    next_run(first);
    window_->tell("the scene is being prepared");
    fmt::print(stderr, "view: {}\n", server_.address());
}

void RunWindow::next_run(const quasimc::RunFile& run) {
    run_ = &run;
    newest_.reset();
    scene_ = std::make_shared<const quasimc::LiveScene>(quasimc::LiveScene{
        .scene = std::make_shared<const quasimc::Scene>(run.scene),
        .bands = run.scene.bands(),
        .ratios = run.spec.ratios,
        .title = title_of(run),
        .head = quasimc::window_run_head(run)});
}

void RunWindow::listen(quasimc::SeriesEvents& events) {
    events.preview = &preview_;
    events.on_time_step = [this, others = std::move(events.on_time_step)](
                              auto moment, const auto& result, auto traced) {
        others(moment, result, traced);
        add(moment, result);
    };
    events.on_progress = [this, others = std::move(events.on_progress)](const auto& progress) {
        if (others) {
            others(progress);
        }
        window_->tell(progress_words(progress), progress.fraction);
    };
}

void RunWindow::add(std::size_t moment, quasimc::Result result) {
    const quasimc::Sources& sources =
        run_->series ? run_->series->time_steps[moment].sources : run_->sources;
    quasimc::LiveFrame frame{
        .label = label_of(moment),
        .scene = scene_,
        .sources = sources,
        .head = quasimc::window_light_head(*run_, result)};
    std::vector<quasimc::Result> results;
    results.push_back(std::move(result));
    frame.results = std::make_shared<const std::vector<quasimc::Result>>(std::move(results));
    if (newest_ == moment) {
        window_->replace_newest(std::move(frame));
    } else {
        window_->add(std::move(frame));
    }
    newest_ = moment;
}

std::string RunWindow::label_of(std::size_t moment) const {
    std::string label = run_->sweep ? fmt::format("point {}", run_->point + 1) : "";
    if (run_->series) {
        label += (label.empty() ? "" : ", ") + run_->series->notes[moment].time;
    }
    return label;
}

void RunWindow::finish(quasimc::StopReason stop) {
    window_->end(
        stop == quasimc::StopReason::interrupted ? "The run was stopped." : "The run is done.");
}

void RunWindow::stay() {
    fmt::print(stderr, "The page stays until Ctrl-C.\n");
    InterruptWatch([] {}).wait_for_first();
}
