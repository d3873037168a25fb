#include "run/evaluation_of.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/memory_need.h"
#include "base/parallel.h"
#include "light/source_origins.h"
#include "results/evaluate.h"
#include "results/question.h"
#include "run/rounds.h"

namespace quasimc {
namespace {

/// Irradiance on the horizontal, per band, of all sources; empty where it is unknown.
std::vector<double> horizontal_irradiance_of(const Scene& scene, const Sources& sources) {
    std::vector<double> sums(sources.empty() ? 0 : scene.bands().size());
    for (const auto& source : sources) {
        if (std::isnan(source->horizontal_irradiance())) {
            return {};
        }
        for (std::size_t b = 0; b < sums.size(); ++b) {
            sums[b] += source->spectrum()[b] * source->horizontal_irradiance();
        }
    }
    return sums;
}

template <typename SomeSums>
Result make_big_result(SomeSums&& sums, const Scene& scene, const EvaluationSpec& asked) {
    const double estimates = static_cast<double>(scene.organs().size()) * kQuantities *
                             static_cast<double>(scene.bands().size());
    return make_big(
        fmt::format(
            "the results of {} organs in {} bands", scene.organs().size(), scene.bands().size()),
        estimates * sizeof(Estimate),
        [&] { return evaluate(std::forward<SomeSums>(sums), scene, asked); });
}

}  // namespace

EvaluationSpec evaluation_of(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    std::vector<OriginSources> origins;
    for (const Sources& own : sources_by_origin(sources, spec.origins)) {
        origins.push_back({horizontal_irradiance_of(scene, own), own});
    }
    return {
        .ratios = ratio_bands(scene, spec),
        .direct_light = spec.direct_light,
        .sun_shade = spec.sun_shade,
        .groups = group_spec(spec),
        .question = question_of(scene, spec),
        .horizontal_irradiance = horizontal_irradiance_of(scene, sources),
        .sources = sources,
        .origins = std::move(origins),
        .threads = thread_count(spec.threads)};
}

Result make_result(const Sums& sums, const Scene& scene, const EvaluationSpec& asked) {
    return make_big_result(sums, scene, asked);
}

Result make_result(Sums&& sums, const Scene& scene, const EvaluationSpec& asked) {
    return make_big_result(std::move(sums), scene, asked);
}

}  // namespace quasimc
