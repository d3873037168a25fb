#include "run/evaluation_of.h"

#include <cmath>

#include "base/parallel.h"
#include "run/rounds.h"

namespace quasimc {
namespace {

/// Irradiance on the horizontal, per band, of all sources; empty where it is not known.
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

}  // namespace

EvaluationSpec evaluation_of(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    return {
        .ratios = ratio_bands(scene, spec),
        .direct_light = spec.direct_light,
        .groups = group_spec(spec),
        .horizontal_irradiance = horizontal_irradiance_of(scene, sources),
        .sources = sources,
        .threads = thread_count(spec.threads)};
}

}  // namespace quasimc
