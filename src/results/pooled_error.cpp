#include <cmath>
#include <limits>
#include <vector>

#include "results/bounds/organ_reader.h"
#include "results/evaluate.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

/// Sums over organs.
struct Pooled {
    double count = 0, light = 0, variance = 0;

    void add(const Estimate& e) {
        ++count;
        light += e.mean;
        variance += e.standard_error * e.standard_error;
    }
    [[nodiscard]] double error() const {
        return light > 0 ? std::sqrt(variance * count) / light
                         : std::numeric_limits<double>::infinity();
    }
};

}  // namespace

double pooled_error(const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const SumReader reader(sums);
    double worst = 0;
    for (std::size_t b = 0; b < sums->bands(); ++b) {
        Pooled pooled;
        for (const Organ& organ : scene.organs()) {
            if (!organ.measured || organ.is_ground || !(organ.area > 0)) {
                continue;
            }
            const OrganReader own(reader, scene, spec, organ);
            const bool absorbs = own.largest_absorptance(b) > 0;
            std::vector<double> light;
            for (std::uint32_t r = 0; r < own.replicates(); ++r) {
                const Incident in = own.incident(r, b);
                light.push_back(
                    absorbs ? in.absorbed
                            : in.direct_upper + in.direct_lower + in.scattered_upper +
                                  in.scattered_lower);
            }
            pooled.add(estimate_mean(light));
        }
        worst = std::max(worst, pooled.count > 0 ? pooled.error() : 0);
    }
    return worst;
}

}  // namespace quasimc
