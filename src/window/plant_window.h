#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "coupling/environment.h"
#include "scene/scene.h"
#include "window/live_window.h"
#include "window/window_server.h"

namespace quasimc {

/// Shows the steps of a growing plant on the page in the browser. A step is only stored; it is
/// converted when a page requests it.
class PlantWindow {
  public:
    /// Opens the page.
    /// @param port  0: any free port. @param title  of the page. @throws InputError  if it is not
    /// available, or the program
    ///        was built without the page
    explicit PlantWindow(int port, std::string title = "A plant that grows");

    [[nodiscard]] std::string address() const { return server_.address(); }
    /// Adds the light of a step. Without a scene only the progress is set.
    void add(const StepSnapshot& step);
    /// Adds the light of a step on a drawn plant, of which it knows some organs.
    /// @param organs  for every organ of the drawn plant its index in the scene of the light; or
    ///        kNoOrgan: its light is unknown
    void add(
        const StepSnapshot& step,
        const std::shared_ptr<const Scene>& drawn,
        std::span<const std::uint32_t> organs);
    /// Adds a step without light. @param scene  null: there is nothing to show
    void add(std::int64_t step, const std::shared_ptr<const Scene>& scene);
    /// Sets the progress.
    void send(const std::string& text) { window_->send(text); }
    /// Marks the growth as finished. @param text  how it ended
    void end(const std::string& text) { window_->end(text); }

  private:
    void add(std::int64_t step, LiveFrame frame);

    std::string title_;
    std::shared_ptr<LiveWindow> window_ = std::make_shared<LiveWindow>();
    HttpServer server_;
};

}  // namespace quasimc
