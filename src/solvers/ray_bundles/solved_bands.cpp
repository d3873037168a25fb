#include "solvers/ray_bundles/solved_bands.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solvers/ray_bundles/patch_optics.h"

namespace quasimc {
namespace {

/// Fewer bands are all solved.
constexpr std::size_t kMinInterpolated = 16;
/// The part of the bands that is solved, at most.
constexpr double kMaxSolved = 0.5;
/// The largest unexplained part of a band, relative to the brightest one.
constexpr double kMaxUnexplained = 2e-4;
/// The kernel is 1 / (kReach - 1) for the brightest band with itself.
constexpr double kReach = 2;

using Table = std::vector<std::vector<double>>;

/// Reflectances and transmittances of all sides of materials, [feature][band].
Table features_of(const Scene& scene) {
    Table features;
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = data_of(scene).materials[m];
        for (const SurfaceSide side : kSurfaceSides) {
            if (is_used[m] && !material.is_transparent()) {
                PatchOptics optics = optics_of(material.side(side), scene.bands().size());
                features.push_back(std::move(optics.reflected));
                features.push_back(std::move(optics.transmitted));
            }
        }
    }
    return features;
}

/// Shares of the lights: in each band with light their sum is 1.
Table normalized_shares(std::span<const std::vector<double>> shares, std::size_t bands) {
    Table normalized(shares.begin(), shares.end());
    for (std::size_t b = 0; b < bands; ++b) {
        double sum = 0;
        for (const std::vector<double>& light : shares) {
            sum += light[b];
        }
        for (std::vector<double>& light : normalized) {
            light[b] = sum > 0 ? light[b] / sum : 0;
        }
    }
    return normalized;
}

/// The kernel of a band and others.
class Kernel {
  public:
    Kernel(const Scene& scene, std::span<const std::vector<double>> shares)
        : bands_(scene.bands().size()),
          features_(features_of(scene)),
          shares_(normalized_shares(shares, bands_)) {
        for (std::size_t b = 0; b < bands_; ++b) {
            largest_ = std::max(largest_, product(features_, b, b));
        }
    }

    [[nodiscard]] double operator()(std::size_t a, std::size_t b) const {
        const double t = largest_ > 0 ? product(features_, a, b) / (kReach * largest_) : 0;
        return t / (1 - t) * product(shares_, a, b);
    }

  private:
    static double product(const Table& table, std::size_t a, std::size_t b) {
        double sum = 0;
        for (const std::vector<double>& row : table) {
            sum += row[a] * row[b];
        }
        return sum;
    }

    std::size_t bands_;
    Table features_, shares_;
    double largest_ = 0;
};

/// A factorization K = L L^T + rest.
struct Factorization {
    std::vector<std::size_t> chosen;
    Table factor;              // columns of L, [in order of choice][band]
    std::vector<double> rest;  // its diagonal, by band
};

/// Chooses, again and again, the band that is explained least. Ends without success if too many
/// bands would be chosen.
Factorization factorize(const Kernel& kernel, std::size_t bands) {
    Factorization found;
    for (std::size_t b = 0; b < bands; ++b) {
        found.rest.push_back(kernel(b, b));
    }
    const double brightest = *std::max_element(found.rest.begin(), found.rest.end());
    const double enough = kMaxUnexplained * kMaxUnexplained * brightest;
    for (;;) {
        const auto least = std::max_element(found.rest.begin(), found.rest.end());
        const auto next = static_cast<std::size_t>(least - found.rest.begin());
        if (*least <= enough) {
            return found;
        }
        std::vector<double> column(bands);
        const double root = std::sqrt(*least);
        for (std::size_t b = 0; b < bands; ++b) {
            double rest = kernel(next, b);
            for (const std::vector<double>& before : found.factor) {
                rest -= before[next] * before[b];
            }
            column[b] = rest / root;
            found.rest[b] = std::max(0.0, found.rest[b] - column[b] * column[b]);
        }
        found.rest[next] = 0;
        found.chosen.push_back(next);
        found.factor.push_back(std::move(column));
        if (static_cast<double>(found.chosen.size()) > kMaxSolved * static_cast<double>(bands)) {
            return {};
        }
    }
}

}  // namespace

SolvedBands::SolvedBands(
    const Scene& scene, std::span<const std::vector<double>> shares, std::size_t origins)
    : all_(scene.bands().size()), origins_(origins) {
    Factorization found;
    if (all_ >= kMinInterpolated) {
        found = factorize(Kernel(scene, shares), all_);
    }
    if (found.chosen.empty()) {
        bands_.resize(all_);
        std::iota(bands_.begin(), bands_.end(), 0);
        return;
    }
    // Bands of similar brightness share a pack, whose orders end together.
    bands_ = found.chosen;
    const auto brightness = [&](std::size_t band) {
        double sum = 0;
        for (const std::vector<double>& column : found.factor) {
            sum += column[band] * column[band];
        }
        return sum;
    };
    std::stable_sort(bands_.begin(), bands_.end(), [&](std::size_t a, std::size_t b) {
        return brightness(a) > brightness(b);
    });
    for (const std::size_t band : found.chosen) {
        const auto at = std::find(bands_.begin(), bands_.end(), band);
        columns_.push_back(static_cast<std::size_t>(at - bands_.begin()));
    }
    for (const std::vector<double>& column : found.factor) {
        factor_.insert(factor_.end(), column.begin(), column.end());
    }
    for (const double rest : found.rest) {
        unexplained_.push_back(std::sqrt(rest));
    }
}

SolvedBands SolvedBands::of(const PreparedScene& prepared) {
    Table shares;
    for (const BoundSource& light : prepared.lights()) {
        shares.push_back(light.start_weights);
        for (double& share : shares.back()) {
            share *= light.probability;
        }
    }
    return {prepared.scene(), shares, prepared.lights().origin_count()};
}

std::vector<double> SolvedBands::select(std::span<const double> numbers) const {
    std::vector<double> selected;
    selected.reserve(count());
    for (std::size_t origin = 0; origin < origins_; ++origin) {
        for (const std::size_t band : bands_) {
            selected.push_back(numbers[band]);
        }
    }
    return selected;
}

std::vector<double> SolvedBands::weights_of(const BoundSource& light) const {
    std::vector<double> weights(count());
    for (std::size_t i = 0; i < bands_.size(); ++i) {
        weights[light.origin * bands_.size() + i] = light.start_weights[bands_[i]];
    }
    return weights;
}

void SolvedBands::interpolate(
    std::span<const double> light,
    std::span<const double> deviations,
    std::span<double> all) const {
    std::fill(all.begin(), all.end(), 0);
    // The light is L y, and |y| is the norm of the interpolant: the rest is at most |y| times the
    // unexplained part (Wendland 2005, Scattered Data Approximation, theorem 11.4).
    double square = 0;
    for (std::size_t j = 0; j < columns_.size(); ++j) {
        const double* column = &factor_[j * all_];
        const std::size_t band = bands_[columns_[j]];
        const double y = (light[columns_[j]] - all[band]) / column[band];
        square += y * y;
        for (std::size_t b = 0; b < all_; ++b) {
            all[b] += y * column[b];
        }
    }
    const double norm = std::sqrt(square);
    const double least = std::min(0.0, *std::min_element(light.begin(), light.end()));
    for (std::size_t b = 0; b < all_; ++b) {
        const double mean = std::max(least, all[b]);
        const double most = std::abs(mean);
        all[b] = mean + std::clamp(norm * unexplained_[b] * deviations[b], -most, most);
    }
    for (std::size_t c = 0; c < bands_.size(); ++c) {
        all[bands_[c]] = light[c];
    }
}

std::size_t count_solved_bands(
    const Scene& scene, const Sources& sources, std::span<const std::string> origins) {
    Table shares;
    for (const auto& source : sources) {
        shares.emplace_back(source->spectrum().begin(), source->spectrum().end());
        const double horizontal = source->horizontal_irradiance();
        for (double& share : shares.back()) {
            share *= horizontal > 0 ? horizontal : 1;
        }
    }
    return SolvedBands(scene, shares, source_origins(sources, origins).count()).count();
}

}  // namespace quasimc
