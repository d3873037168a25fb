#include <algorithm>

#include "detectors/catalogue.h"
#include "results/evaluate.h"
#include "sums/light_blocks.h"
#include "sums/statistics.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// The flux of one bin of scattered light in a band; an upper bound where it is zero.
Estimate estimate_bin(const Sums& sums, std::size_t bin, std::size_t band) {
    const auto samples = static_cast<double>(sums->samples);
    const double unit = sums->units.flux[band] / samples;
    std::vector<double> values;
    for (const ExactBins& bins : sums->replicates) {
        values.push_back(bins.value(bin) * unit);
    }
    return estimate_seen_or_bound(values, sums->bound("direct").largest[band] / samples);
}

DetectorResult unseen_result(const DetectorSpec& spec, std::size_t bands) {
    DetectorAxis axis = make_detector(spec)->axis();
    DetectorResult result{spec.name, spec.type, std::move(axis.quantity), std::move(axis.bins), {}};
    result.values.resize(result.bins.size() * bands);
    return result;
}

}  // namespace

std::vector<DetectorResult> zero_detectors(const Scene& scene) {
    std::vector<DetectorResult> results;
    for (const DetectorSpec& spec : scene.detectors()) {
        results.push_back(unseen_result(spec, scene.bands().size()));
    }
    return results;
}

std::vector<DetectorResult> evaluate_detectors(const Sums& sums, const Scene& scene) {
    const LightBlocks blocks(sums->layout);
    std::vector<DetectorResult> results = zero_detectors(scene);
    for (std::size_t d = 0; d < results.size(); ++d) {
        const std::size_t first = blocks.detector(d);
        for (std::size_t i = 0; i < results[d].values.size(); ++i) {
            results[d].values[i] = estimate_bin(sums, first + i, i % sums->bands());
        }
    }
    return results;
}

}  // namespace quasimc
