#include "window/plant_window.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "window/page.h"
#include "window/window_parts.h"

namespace quasimc {
namespace {

/// The routes of a page that follows a growing plant.
ViewerRoutes routes_of(const std::shared_ptr<LiveWindow>& window) {
    require_page("view");
    return {
        [window](std::string_view name) { return window->file(name); }, random_token(),
        WindowKind::live};
}

/// The light's properties as JSON; with one result per band, those of the first band with light.
std::string head_of(
    const Scene& scene, const std::vector<Result>& results, std::span<const Band> bands) {
    const auto lit = std::find_if(
        results.begin(), results.end(), [](const auto& result) { return !result.values.empty(); });
    if (lit == results.end()) {
        return "{}";
    }
    const bool is_together = results.size() == 1;
    const auto band = static_cast<std::size_t>(lit - results.begin());
    return window_light_head(
        is_together ? bands : bands.subspan(band, 1), scene.length_unit(), *lit);
}

std::shared_ptr<const LiveScene> live_scene(
    std::shared_ptr<const Scene> scene, const std::vector<Band>& bands, const std::string& title) {
    return std::make_shared<const LiveScene>(
        LiveScene{.scene = std::move(scene), .bands = bands, .title = title, .grows = true});
}

}  // namespace

PlantWindow::PlantWindow(int port, std::string title)
    : title_(std::move(title)), server_(routes_of(window_), port) {
    window_->send("waiting for the first step");
}

void PlantWindow::add(std::int64_t step, LiveFrame frame) {
    frame.label = fmt::format("step {}", step);
    window_->add(std::move(frame));
    window_->send(fmt::format("after step {}: the plant grows", step));
}

void PlantWindow::add(const StepSnapshot& step) {
    const std::shared_ptr<const StepLight>& light = step.light;
    if (!light->scene) {
        window_->send(fmt::format("step {}: nothing is lit", step.step));
        return;
    }
    const std::vector<Band>& bands = step.specification.bands;
    const auto& sources = step.lighting.sources;
    add(step.step, {.scene = live_scene({light, &*light->scene}, bands, title_),
                    .results = {light, &light->results},
                    .sources = sources.empty() ? Sources() : sources.front(),
                    .head = head_of(*light->scene, light->results, bands)});
}

void PlantWindow::add(std::int64_t step, const std::shared_ptr<const Scene>& scene) {
    if (!scene) {
        window_->send(fmt::format("step {}: no shape is drawn", step));
        return;
    }
    add(step, {.scene = live_scene(scene, scene->bands(), title_),
               .results = std::make_shared<const std::vector<Result>>()});
}

}  // namespace quasimc
