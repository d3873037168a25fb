#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "grow_environment.h"
#include "grow_plant.h"
#include "quasimc/scene.h"
#include "window/plant_window.h"

/// Shows the steps of a growing plant in the browser: its shapes, in the colours of light those
/// before which it queries the light.
class GrowWindow {
  public:
    /// @param port  0: any free port. @throws InputError  as PlantWindow
    GrowWindow(int port, std::string title) : window_(port, std::move(title)) {}

    [[nodiscard]] std::string address() const { return window_.address(); }
    /// Adds a step. @param has_light  whether its light is still to come
    void add(GrownPlant& plant, bool has_light);
    /// Adds the light of the last pass: on the last step, or on the shapes that were lit.
    void set_light(const GrowEnvironment& environment);
    /// Marks the growth as finished. @param text  how it ended
    void end(const std::string& text) { window_.end(text); }

  private:
    quasimc::PlantWindow window_;
    std::int64_t step_ = -1;                                 // of drawn_
    std::shared_ptr<const quasimc::Scene> drawn_ = nullptr;  // the last step
};
