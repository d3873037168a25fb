#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "quasimc/quasimc.h"
#include "window/live_window.h"
#include "window/window_server.h"

/// The page in the browser that follows `quasimc run --view`.
class RunWindow {
  public:
    /// Tells the address of the page on stderr.
    /// @param port  0: any that is free. @throws InputError  if it can't be had, or there is no
    /// page
    RunWindow(const quasimc::RunFile& first, int port);

    /// What follows is of the next point of a sweep.
    void next_run(const quasimc::RunFile& run);
    /// Lets the page follow what a run tells, beside others who hear of it. Both must outlive it.
    void listen(quasimc::SeriesEvents& events);
    /// The run is over.
    void finish(quasimc::StopReason stop);
    /// Serves the page until Ctrl-C.
    static void stay();

  private:
    void add(std::size_t moment, quasimc::Result result);
    [[nodiscard]] std::string label_of(std::size_t moment) const;

    std::shared_ptr<quasimc::LiveWindow> window_ = std::make_shared<quasimc::LiveWindow>();
    quasimc::WindowServer server_;
    const quasimc::RunFile* run_ = nullptr;
    std::shared_ptr<const quasimc::LiveScene> scene_;
    std::optional<std::size_t> newest_;  // moment of the point, that a frame stands for
    quasimc::RunPreview preview_;
};
