// Allocates the paths of a day to its time steps.
//
// A sum of independent estimates has the smallest variance for a given number of samples if each
// has samples in proportion to its standard deviation for one sample (Neyman 1934, Journal of the
// Royal Statistical Society 97, 558-625). For light the standard deviation is nearly proportional
// to the light itself: relative errors of similarly lit hours differ little.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "light/models/source.h"
#include "quasimc/series.h"

namespace quasimc {
namespace {

constexpr int kMinExponent = -6;

/// Irradiance of sources on the horizontal, per band. Lamps: their flux over the horizontal extent
/// of the scene, a rough estimate.
std::vector<double> light_of(const Scene& scene, const Sources& sources) {
    const double radius = scene.bounds().radius();
    const double disc = std::numbers::pi * radius * radius;
    std::vector<double> light(scene.bands().size());
    for (const auto& source : sources) {
        const double given = source->horizontal_irradiance();
        const double amount = std::isnan(given) ? 1 / disc : given;
        for (std::size_t b = 0; b < light.size(); ++b) {
            light[b] += amount * source->spectrum()[b];
        }
    }
    return light;
}

using Energies = std::map<std::size_t, std::vector<double>>;  // per band, by the computed time step

/// A trace's share of a day, mean over the bands.
double share_of(const std::vector<double>& part, const std::vector<double>& whole) {
    double sum = 0;
    double bands = 0;
    for (std::size_t b = 0; b < whole.size(); ++b) {
        if (whole[b] > 0) {
            sum += part[b] / whole[b];
            ++bands;
        }
    }
    return bands > 0 ? sum / bands : 0;
}

/// The paths of a trace, relative to the days that it counts for.
struct Claim {
    double path_factor = 0;  ///< share x number of traces
    double share = 0;
};

void claim_day(const Energies& energies, std::map<std::size_t, Claim>& claims) {
    std::vector<double> whole;
    for (const auto& [traced, part] : energies) {
        whole.resize(part.size());
        for (std::size_t b = 0; b < part.size(); ++b) {
            whole[b] += part[b];
        }
    }
    for (const auto& [traced, part] : energies) {
        const double share = share_of(part, whole);
        Claim& claim = claims[traced];
        claim.path_factor =
            std::max(claim.path_factor, share * static_cast<double>(energies.size()));
        claim.share = std::max(claim.share, share);
    }
}

}  // namespace

void allocate_paths(
    const Scene& scene, const std::vector<TimeStep>& time_steps, std::vector<TimeStepPlan>& plans) {
    std::map<std::size_t, Claim> claims;
    Energies energies;
    for (std::size_t i = 0; i < time_steps.size(); ++i) {
        if (plans[i].factor > 0) {
            std::vector<double>& sum = energies[plans[i].traced];
            sum.resize(scene.bands().size());
            const std::vector<double> light = light_of(scene, time_steps[i].sources);
            for (std::size_t b = 0; b < sum.size(); ++b) {
                sum[b] += time_steps[i].seconds * light[b];
            }
        }
        if (i + 1 == time_steps.size() || time_steps[i + 1].day != time_steps[i].day) {
            claim_day(energies, claims);
            energies.clear();
        }
    }
    for (const auto& [traced, claim] : claims) {
        const double least = std::ldexp(1, kMinExponent);
        const double exponent = std::round(std::log2(std::max(claim.path_factor, least)));
        plans[traced].path_factor = std::exp2(exponent);
        plans[traced].target = 1 / std::sqrt(std::max(claim.share, least * least));
    }
}

}  // namespace quasimc
