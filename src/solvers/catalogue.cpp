// To add a solver, tools/new.py solver NAME makes name.cpp (a class derived from Solver),
// name_test.cpp and docs/theory/name.md, and enters it here and in Method (quasimc/run_spec.h).
// `method = "name"`, its flag and `quasimc list options` follow from the row;
// tests/unit/solvers/every_solver_test.cpp tries every row.

#include "solvers/catalogue.h"

#include <algorithm>
#include <array>

#include "base/checks.h"
#include "samplers/catalogue.h"
#include "solvers/first_hits/first_hits.h"
#include "solvers/from_organs/from_organs.h"
#include "solvers/light_tracing/light_tracing.h"
#include "solvers/ray_bundles/ray_bundles.h"

namespace quasimc {

// (tools/new.py declares a solver above this line)

std::span<const SolverEntry> solver_catalogue() {
    static constexpr std::array kSolvers{
        SolverEntry{
            Method::light_tracing, "light_tracing", "paths start at the sources",
            make_light_tracing, light_tracing_meaning, EscapedLight::summed,
            do_light_tracing_rounds_add_up},
        SolverEntry{
            Method::first_hits, "first_hits",
            "direct light by projection; scattered paths start on the lit surfaces",
            make_first_hits, first_hits_meaning},
        SolverEntry{
            Method::from_organs, "from_organs",
            "paths start on the measured organs and sample the sources", make_from_organs,
            from_organs_meaning, EscapedLight::remainder, do_from_organs_rounds_add_up},
        SolverEntry{
            Method::ray_bundles, "ray_bundles",
            "scattered light of Lambertian surfaces along bundles of parallel lines",
            make_ray_bundles, ray_bundles_meaning},
        // (tools/new.py enters a solver above this line)
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

const SolverEntry* find_solver(Method method) {
    const auto all = solver_catalogue();
    const auto entry = std::find_if(
        all.begin(), all.end(), [&](const SolverEntry& e) { return e.method == method; });
    return entry == all.end() ? nullptr : &*entry;
}

std::unique_ptr<Solver> make_solver(const SolverInput& input) {
    const SolverEntry* entry = find_solver(input.spec.method);
    EXPECT(entry != nullptr);
    return entry->make(input);
}

namespace {

std::vector<SumOrigin> sum_origins(const BoundLights& lights) {
    std::vector<SumOrigin> origins;
    for (const std::string& name : lights.origins()) {
        origins.push_back({name, false, {}, std::vector<double>(lights.flux().size())});
    }
    for (std::size_t i = 0; i < lights.size() && !origins.empty(); ++i) {
        const BoundSource& light = lights[i];
        SumOrigin& origin = origins[light.origin];
        origin.has_suns = origin.has_suns || light.source->is_sun();
        if (std::ranges::find(origin.spectra, light.spectrum) == origin.spectra.end()) {
            origin.spectra.push_back(light.spectrum);
        }
        for (std::size_t b = 0; b < origin.emitted_flux.size(); ++b) {
            origin.emitted_flux[b] += lights.flux()[b] * light.probability * light.start_weights[b];
        }
    }
    return origins;
}

std::vector<std::size_t> sun_spectra(const BoundLights& lights) {
    std::vector<std::size_t> suns;
    for (const BoundSource& light : lights) {
        if (light.source->is_sun() && std::ranges::find(suns, light.spectrum) == suns.end()) {
            suns.push_back(light.spectrum);
        }
    }
    return suns;
}

}  // namespace

Sums empty_sums(const PreparedScene& prepared, const RunSpec& spec) {
    const SolverEntry* entry = find_solver(spec.method);
    EXPECT(entry != nullptr);
    SumMeaning meaning = entry->meaning(prepared, spec);
    const auto origins = static_cast<std::uint32_t>(prepared.lights().origin_count());
    SumBlocks blocks = light_blocks(
        prepared.lights().spectra().size(), prepared.bands(),
        !prepared.optics().has_constant_albedos, origins, spec.sun_shade == SunShade::apart);
    blocks.insert(blocks.end(), meaning.blocks.begin(), meaning.blocks.end());
    for (std::size_t i = 0; i < prepared.detectors().size(); ++i) {
        blocks.push_back(detector_block(
            prepared.scene().detectors()[i].name, prepared.detectors()[i]->axis().bins.size(),
            prepared.bands(), origins));
    }
    SumData sums;
    sums.layout = SumLayout(prepared.scene().regions().size(), std::move(blocks));
    sums.units = std::move(meaning.units);
    sums.bounds = std::move(meaning.bounds);
    sums.strategies = std::move(meaning.strategies);
    for (const SamplingStrategy& strategy : sums.strategies) {
        sums.per_contribution.push_back(strategy.by == SampledBy::paths ? 1 : 0);
    }
    sums.spectra = prepared.lights().spectra();
    sums.sun_spectra = sun_spectra(prepared.lights());
    sums.emitted_flux = prepared.lights().flux();
    sums.measured = meaning.measured;
    sums.escaped = entry->escaped;
    sums.origins = sum_origins(prepared.lights());
    for (std::uint32_t r = 0; r < spec.replicates; ++r) {
        sums.replicates.emplace_back(sums.layout.bins());
    }
    return Sums(std::move(sums));
}

}  // namespace quasimc
