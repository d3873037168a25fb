#include "run/simulator.h"

#include "light/source_origins.h"
#include "samplers/catalogue.h"

namespace quasimc {
namespace {

void require_origins(const Sources& sources, const RunSpec& spec) {
    Faults faults;
    check_origins(sources, spec.origins, faults);
    faults.throw_if_any();
}

}  // namespace

Simulator::Simulator() : state_(std::make_unique<State>()) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&& other) noexcept = default;
Simulator& Simulator::operator=(Simulator&& other) noexcept = default;

Result Simulator::run(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control) & {
    require_origins(sources, spec);
    return state_->run(scene, sources, spec, control, {});
}

Result Simulator::run(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control) && {
    require_origins(sources, spec);
    return state_->run(scene, sources, spec, control, {.is_last = true});
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

const Sampler& Simulator::State::sampler_for(const std::string& name) {
    std::unique_ptr<Sampler>& sampler = samplers_[name];
    if (!sampler) {
        sampler = make_sampler(name);
    }
    return *sampler;
}

}  // namespace quasimc
