// The solvers. To add one: write its file, its test and its page, add a value to Method and a row
// here. (docs/develop/decisions/solver-owns-its-loop.md tells what a solver promises.)

#include "solvers/catalogue.h"

#include <algorithm>
#include <array>

#include "base/checks.h"
#include "samplers/catalogue.h"
#include "solvers/first_hits.h"
#include "solvers/from_organs.h"
#include "solvers/light_tracing.h"

namespace quasimc {
namespace {

const SolverEntry& entry_of(Method method) {
    const auto all = solver_catalogue();
    const auto entry = std::find_if(
        all.begin(), all.end(), [&](const SolverEntry& e) { return e.method == method; });
    EXPECT(entry != all.end());
    return *entry;
}

}  // namespace

std::span<const SolverEntry> solver_catalogue() {
    static constexpr std::array kSolvers{
        SolverEntry{
            Method::light_tracing, "light_tracing", "paths start at the sources",
            make_light_tracing, light_tracing_meaning},
        SolverEntry{
            Method::first_hits, "first_hits",
            "what the sources light first is found by geometry, paths start there", make_first_hits,
            light_tracing_meaning},
        SolverEntry{
            Method::from_organs, "from_organs", "points on every organ look for light",
            make_from_organs, from_organs_meaning},
    };
    return kSolvers;
}

std::vector<SamplerModel> sampler_models() {
    std::vector<SamplerModel> models;
    for (const SamplerEntry& entry : sampler_catalogue()) {
        models.push_back({entry.name, entry.summary});
    }
    return models;
}

std::unique_ptr<Solver> make_solver(const SolverInput& input) {
    return entry_of(input.spec.method).make(input);
}

Sums empty_sums(const PreparedScene& prepared, const RunSpec& spec) {
    SumMeaning meaning = entry_of(spec.method).meaning(prepared, spec);
    Sums sums;
    sums.layout = {
        .regions = prepared.scene().regions().size(),
        .spectra = prepared.spectra().size(),
        .bands = prepared.bands(),
        .absorbed_light =
            prepared.has_constant_albedos() ? AbsorbedLight::inferred : AbsorbedLight::summed};
    sums.units = std::move(meaning.units);
    sums.spectra = prepared.spectra();
    sums.emitted_flux = prepared.flux();
    sums.measured = meaning.measured;
    sums.escaped = meaning.escaped;
    for (std::uint32_t r = 0; r < spec.replicates; ++r) {
        sums.replicates.emplace_back(sums.layout.bins());
    }
    return sums;
}

}  // namespace quasimc
