#include "quasimc/sums.h"

#include <algorithm>
#include <stdexcept>

namespace quasimc {

Sums& Sums::operator+=(const Sums& other) {
    const bool is_same_run = layout == other.layout && units == other.units &&
                             spectra == other.spectra && emitted_flux == other.emitted_flux &&
                             measured == other.measured && escaped == other.escaped &&
                             replicates.size() == other.replicates.size() &&
                             per_find.size() == other.per_find.size() && digest == other.digest;
    if (!is_same_run) {
        throw std::invalid_argument("sums of different runs can't be added");
    }
    for (std::size_t r = 0; r < replicates.size(); ++r) {
        replicates[r] += other.replicates[r];
    }
    paths += other.paths;
    samples += other.samples;
    for (std::size_t i = 0; i < per_find.size(); ++i) {
        per_find[i] = std::max(per_find[i], other.per_find[i]);
    }
    return *this;
}

std::uint64_t count_rays(const Sums& sums) {
    std::uint64_t rays = 0;
    for (const ExactBins& bins : sums.replicates) {
        rays += static_cast<std::uint64_t>(bins.steps(sums.layout.rays()).low);
    }
    return rays;
}

}  // namespace quasimc
