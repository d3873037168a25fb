#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "coupling/environment.h"
#include "window/live_window.h"
#include "window/window_server.h"

/// Shows the steps of a growing plant on the page in the browser. A step only
/// stores its light; it is converted when a page requests it.
class StepWindow final : public quasimc::StepViewer {
  public:
    /// @param send  takes the address of the page
    explicit StepWindow(std::function<void(const std::string&)> send) : send_(std::move(send)) {}

    void open(int port) override;
    void on_begin(std::int64_t step) override;
    void on_step(const quasimc::StepSnapshot& step) override;

  private:
    std::function<void(const std::string&)> send_;
    std::shared_ptr<quasimc::LiveWindow> window_;
    std::optional<quasimc::HttpServer> server_;
};
