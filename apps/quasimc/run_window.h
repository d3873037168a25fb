#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/quasimc.h"
#include "window/live_window.h"
#include "window/window_server.h"

/// The page in the browser that follows `quasimc run --view`. While a page is watched it shows the
/// current result: after rounds, and within the first round after replicates. This takes a small
/// part of the run's time.
class RunWindow final : public quasimc::RunListener {
  public:
    /// Prints the address of the page on stderr.
    /// @param port  0: any free port. @throws InputError  if it is not available, or there is
    /// no page
    RunWindow(const quasimc::RunFile& first, int port);

    /// Begins the next point of a sweep.
    void next_run(const quasimc::RunFile& run);
    /// Marks the run as finished.
    void finish(quasimc::StopReason stop);
    /// Serves the page until Ctrl-C.
    static void stay();

    void on_progress(const quasimc::Progress& progress) override;
    [[nodiscard]] bool wants_pause() override;
    void on_pause(const quasimc::RunSoFar& run) override;
    void on_round(const quasimc::RunSoFar& run) override;
    void on_last_round(const quasimc::RunSoFar& /*run*/) override { shown_ = 0; }
    void on_time_step(const quasimc::TimeStepResult& step) override;
    [[nodiscard]] bool wants(quasimc::SeriesPart part) const override {
        return part == quasimc::SeriesPart::time_steps;
    }

  private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] bool is_due() const;
    void show(const quasimc::RunSoFar& run);
    void add(std::size_t time_step, quasimc::Result result);
    [[nodiscard]] std::string label_of(std::size_t time_step) const;
    [[nodiscard]] std::vector<std::size_t> lit_steps() const;
    [[nodiscard]] std::string describe(const quasimc::Progress& progress) const;

    std::shared_ptr<quasimc::LiveWindow> window_ = std::make_shared<quasimc::LiveWindow>();
    quasimc::HttpServer server_;
    const quasimc::RunFile* run_ = nullptr;
    std::shared_ptr<const quasimc::LiveScene> scene_;
    std::optional<std::size_t> newest_;  // time step of the newest frame, within the point
    std::size_t shown_ = 0;              // replicates in the shown result
    std::size_t finished_ = 0;           // time steps with light, within the point
    Clock::time_point not_before_;       // earliest time of the next result
    Clock::time_point ask_after_;        // earliest time of the next pause
};
