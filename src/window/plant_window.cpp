#include "window/plant_window.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "quasimc/sums.h"
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

/// Numbers of organs, `each` of them per organ, for other organs; unknown ones for kNoOrgan.
std::vector<Estimate> numbers_for(
    std::span<const std::uint32_t> organs, const std::vector<Estimate>& numbers, std::size_t each) {
    std::vector<Estimate> chosen;
    if (numbers.empty()) {
        return chosen;
    }
    chosen.reserve(organs.size() * each);
    for (const std::uint32_t organ : organs) {
        for (std::size_t i = 0; i < each; ++i) {
            chosen.push_back(organ == kNoOrgan ? kUnknownEstimate : numbers[organ * each + i]);
        }
    }
    return chosen;
}

/// The numbers of a result for other organs, and what is known of all of its organs together.
Result result_for(std::span<const std::uint32_t> organs, const Result& result) {
    Result chosen;
    chosen.bands = result.bands;
    chosen.ratios = result.ratios;
    chosen.values = numbers_for(organs, result.values, kQuantities * result.bands);
    chosen.sunlit_fraction = numbers_for(organs, result.sunlit_fraction, 1);
    chosen.ratio_values = numbers_for(organs, result.ratio_values, result.ratios);
    chosen.budget = result.budget;
    return chosen;
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

void PlantWindow::add(
    const StepSnapshot& step,
    const std::shared_ptr<const Scene>& drawn,
    std::span<const std::uint32_t> organs) {
    const StepLight& light = *step.light;
    if (!light.scene) {
        add(step);
        return;
    }
    const std::vector<Band>& bands = step.specification.bands;
    auto results = std::make_shared<std::vector<Result>>();
    for (const Result& result : light.results) {
        results->push_back(result_for(organs, result));
    }
    const auto& sources = step.lighting.sources;
    add(step.step, {.scene = live_scene(drawn, bands, title_),
                    .results = std::move(results),
                    .sources = sources.empty() ? Sources() : sources.front(),
                    .head = head_of(*light.scene, light.results, bands)});
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
