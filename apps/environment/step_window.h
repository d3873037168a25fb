#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "coupling/environment.h"
#include "window/plant_window.h"

/// Shows the light of the steps of a growing plant on the page in the browser.
class StepWindow final : public quasimc::StepViewer {
  public:
    /// @param send  takes the address of the page
    explicit StepWindow(std::function<void(const std::string&)> send) : send_(std::move(send)) {}

    void open(int port) override;
    void on_begin(std::int64_t step) override;
    void on_step(const quasimc::StepSnapshot& step) override;

  private:
    std::function<void(const std::string&)> send_;
    std::optional<quasimc::PlantWindow> window_;
};
