#include "run/simulator.h"

#include <fmt/format.h>

#include "base/memory_need.h"
#include "samplers/catalogue.h"

namespace quasimc {

Simulator::Simulator() : state_(std::make_unique<State>()) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&& other) noexcept = default;
Simulator& Simulator::operator=(Simulator&& other) noexcept = default;

Result Simulator::run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress) {
    return state_->run(scene, sources, spec, {.on_progress = on_progress});
}

Result Simulator::run(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control) {
    return state_->run(scene, sources, spec, control);
}

Sums Simulator::sums(
    const Scene& scene, const Sources& sources, const RunSpec& spec, std::uint64_t first) {
    return state_->sums(scene, sources, spec, first, {}, {});
}

Sums Simulator::sums(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    std::uint64_t first,
    const Share& share,
    const RunControl& control) {
    return state_->sums(scene, sources, spec, first, share, control);
}

std::size_t Simulator::builds() const {
    return state_->builds();
}

std::shared_ptr<const RayCaster> Simulator::State::caster_for(
    const Scene& scene, Engine engine, const std::stop_token& stop) {
    const auto triangles = scene.shared_triangles();
    const bool same = caster_ && engine == engine_ && scene.cell() == cell_ &&
                      (triangles == triangles_ || *triangles == *triangles_);
    if (!same) {
        caster_.reset();  // their memory first
        triangles_.reset();
        constexpr double kBytesOfTriangle = 150;  // docs/develop/architecture.md
        caster_ = make_big(
            fmt::format("the ray caster of {} triangles", triangles->size()),
            kBytesOfTriangle * static_cast<double>(triangles->size()), [&] {
                return std::make_shared<const RayCaster>(triangles, scene.cell(), engine, stop);
            });
        cell_ = scene.cell();
        engine_ = engine;
        ++builds_;
    }
    triangles_ = triangles;
    return caster_;
}

const Sampler& Simulator::State::sampler_for(const std::string& name) {
    std::unique_ptr<Sampler>& sampler = samplers_[name];
    if (!sampler) {
        sampler = make_sampler(name);
    }
    return *sampler;
}

}  // namespace quasimc
