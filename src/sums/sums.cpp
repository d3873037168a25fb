#include "quasimc/sums.h"

#include <algorithm>
#include <stdexcept>

namespace quasimc {

namespace {

/// Adds the bins of sums of one run.
void add_replicates(Sums& sums, const Sums& other) {
    const bool is_same_run =
        sums.layout == other.layout && sums.units == other.units && sums.spectra == other.spectra &&
        sums.emitted_flux == other.emitted_flux && sums.measured == other.measured &&
        sums.escaped == other.escaped && sums.replicates.size() == other.replicates.size() &&
        sums.per_find.size() == other.per_find.size() && sums.digest == other.digest;
    if (!is_same_run) {
        throw std::invalid_argument("sums of different runs can't be added");
    }
    for (std::size_t r = 0; r < sums.replicates.size(); ++r) {
        sums.replicates[r] += other.replicates[r];
    }
    for (std::size_t i = 0; i < sums.per_find.size(); ++i) {
        sums.per_find[i] = std::max(sums.per_find[i], other.per_find[i]);
    }
}

}  // namespace

Sums& Sums::operator+=(const Sums& other) {
    add_replicates(*this, other);
    paths += other.paths;
    samples += other.samples;
    return *this;
}

Sums& Sums::add_share(const Sums& other) {
    if (paths != other.paths || samples != other.samples) {
        throw std::invalid_argument("shares of different numbers of paths can't be added");
    }
    add_replicates(*this, other);
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
