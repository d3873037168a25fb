#include "step_window.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "window/page.h"
#include "window/window_parts.h"

namespace {

/// The light's properties as JSON; with one result per band, those of the first band with light.
std::string head_of(const quasimc::StepSnapshot& step) {
    const std::vector<quasimc::Result>& results = step.light->results;
    const std::span<const quasimc::Band> bands = step.specification.bands;
    const auto lit = std::find_if(
        results.begin(), results.end(), [](const auto& result) { return !result.values.empty(); });
    if (lit == results.end()) {
        return "{}";
    }
    const bool is_together = results.size() == 1;
    const auto band = static_cast<std::size_t>(lit - results.begin());
    return quasimc::window_light_head(
        is_together ? bands : bands.subspan(band, 1), step.light->scene->length_unit(), *lit);
}

}  // namespace

void StepWindow::on_begin(std::int64_t step) {
    window_->send(fmt::format("the light of step {} is being computed", step));
}

void StepWindow::open(int port) {
    quasimc::require_page("view");
    window_ = std::make_shared<quasimc::LiveWindow>();
    window_->send("waiting for the first step");
    server_.emplace(
        quasimc::ViewerRoutes(
            [window = window_](std::string_view name) { return window->file(name); },
            quasimc::random_token(), quasimc::WindowKind::live),
        port);
    send_("view: " + server_->address());
}

void StepWindow::on_step(const quasimc::StepSnapshot& step) {
    if (!step.light->scene) {
        window_->send(fmt::format("step {}: nothing is lit", step.step));
        return;
    }
    const auto scene = std::make_shared<const quasimc::LiveScene>(quasimc::LiveScene{
        .scene = {step.light, &*step.light->scene},
        .bands = step.specification.bands,
        .title = "A plant that grows",
        .grows = true});
    const auto& lighting = step.lighting.sources;
    window_->add(
        {.label = fmt::format("step {}", step.step),
         .scene = scene,
         .results = {step.light, &step.light->results},
         .sources = lighting.empty() ? quasimc::Sources() : lighting.front(),
         .head = head_of(step)});
    window_->send(fmt::format("after step {}: the plant grows", step.step));
}
