#include "results/bounds/patch_error_pool.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "results/quantities.h"

namespace quasimc {
namespace {

/// Scattered fraction of the light of an organ in a band: 0 to 1.
double scattered_part(const Result& light, std::size_t i, std::size_t band) {
    const double all = light.at(i, Quantity::incident_upper, band).mean +
                       light.at(i, Quantity::incident_lower, band).mean;
    const double part = light.at(i, Quantity::incident_scattered, band).mean / all;
    return std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0;
}

/// One kind of estimate of organs and groups: its means and those of the coarser level.
struct Kind {
    std::size_t stride, index;  ///< of the estimate within an organ or a group
    bool is_flux;               ///< otherwise per area

    template <typename Estimates>
    [[nodiscard]] auto& mean(Estimates& estimates, std::size_t i) const {
        return estimates[i * stride + index].mean;
    }
};

/// The differences of one kind of estimate between two levels of patches.
class KindPool {
  public:
    /// @param scattered  scattered light of each organ, per area
    KindPool(const Scene& scene, const Kind& kind, std::vector<double> scattered)
        : scene_(scene), kind_(kind), scattered_(std::move(scattered)) {}

    void shrink_organs(const std::vector<Estimate>& fine, std::vector<Estimate>& coarse) {
        for_each_organ([&](std::size_t i, double per_area) {
            const double difference = per_area * (kind_.mean(fine, i) - kind_.mean(coarse, i));
            if (std::isfinite(difference)) {
                pool_.add(scattered_[i], difference);
            }
        });
        for_each_organ([&](std::size_t i, double per_area) {
            const double mean = kind_.mean(fine, i), own = mean - kind_.mean(coarse, i);
            kind_.mean(coarse, i) = mean - pool_.shrunk(own, scattered_[i] / per_area);
        });
    }

    /// Leaves the differences of groups that hold an organ which is not pooled.
    void shrink_groups(
        const std::vector<OrganGroup>& groups,
        const std::vector<Estimate>& fine,
        std::vector<Estimate>& coarse) const {
        for (std::size_t g = 0; g < groups.size(); ++g) {
            double sum = 0, squares = 0;
            bool are_pooled = true;
            for (const std::uint32_t i : groups[g].organs) {
                const Organ& organ = scene_.organs()[i];
                const double flux = scattered_[i] * organ.area;
                sum += flux;
                squares += flux * flux;
                are_pooled = are_pooled && is_pooled(organ);
            }
            if (are_pooled) {
                const double unit = kind_.is_flux ? 1 : 1 / groups[g].area;
                const double mean = kind_.mean(fine, g), own = mean - kind_.mean(coarse, g);
                kind_.mean(coarse, g) = mean - pool_.shrunk(own, unit * sum, unit * unit * squares);
            }
        }
    }

  private:
    /// Calls act(organ, factor to densities) for each pooled organ.
    template <typename Act>
    void for_each_organ(const Act& act) const {
        for (std::size_t i = 0; i < scattered_.size(); ++i) {
            const Organ& organ = scene_.organs()[i];
            if (is_pooled(organ)) {
                act(i, kind_.is_flux ? 1 / organ.area : 1.0);
            }
        }
    }

    const Scene& scene_;
    Kind kind_;
    std::vector<double> scattered_;
    PatchErrorPool pool_;
};

/// The values of a function for all organs; 0 for those that are not pooled.
template <typename OfOrgan>
std::vector<double> scattered_of(const Scene& scene, const OfOrgan& of_organ) {
    std::vector<double> scattered(scene.organs().size());
    for (std::size_t i = 0; i < scattered.size(); ++i) {
        scattered[i] = is_pooled(scene.organs()[i]) ? of_organ(i) : 0;
    }
    return scattered;
}

void pool_quantity(
    const Scene& scene,
    const QuantityEntry& entry,
    std::size_t band,
    const Result& fine,
    Result& coarse) {
    const bool is_absorbed = parts_of(entry.quantity).is_absorbed;
    const auto of_organ = [&](std::size_t i) {
        return is_absorbed ? fine.at(i, Quantity::absorbed_flux_density, band).mean *
                                 scattered_part(fine, i, band)
                           : fine.at(i, Quantity::incident_scattered, band).mean;
    };
    const auto q = static_cast<std::size_t>(entry.quantity);
    const Kind kind{kQuantities * fine.bands, q * fine.bands + band, entry.is_flux};
    KindPool pool(scene, kind, scattered_of(scene, of_organ));
    pool.shrink_organs(fine.values, coarse.values);
    pool.shrink_groups(fine.groups.groups, fine.groups.values, coarse.groups.values);
}

void pool_ratio(
    const Scene& scene,
    const std::pair<std::size_t, std::size_t>& bands,
    std::size_t number,
    const Result& fine,
    Result& coarse) {
    const auto of_organ = [&](std::size_t i) {
        const double ratio = fine.ratio(i, number).mean;
        const double part =
            std::max(scattered_part(fine, i, bands.first), scattered_part(fine, i, bands.second));
        return std::isfinite(ratio) ? ratio * part : 0;
    };
    KindPool pool(scene, {fine.ratios, number, false}, scattered_of(scene, of_organ));
    pool.shrink_organs(fine.ratio_values, coarse.ratio_values);
    pool.shrink_groups(fine.groups.groups, fine.groups.ratio_values, coarse.groups.ratio_values);
}

}  // namespace

void PatchErrorPool::add(double scattered, double difference) {
    squares_ += scattered * scattered;
    products_ += scattered * difference;
    differences_ += difference * difference;
}

PatchErrorPool& PatchErrorPool::operator+=(const PatchErrorPool& other) {
    squares_ += other.squares_;
    products_ += other.products_;
    differences_ += other.differences_;
    return *this;
}

double PatchErrorPool::shrunk(double own, double scattered, double squares) const {
    if (!(squares_ > 0)) {
        return std::abs(own);
    }
    const double common = products_ / squares_;  // least squares
    const double rest = std::max(0.0, differences_ - common * products_) / squares_;
    const double usual = common * common * scattered * scattered + rest * squares;
    return std::sqrt((own * own + usual) / 2);
}

void pool_patch_errors(
    const Scene& scene, const EvaluationSpec& spec, const Result& fine, Result& coarse) {
    for (const QuantityEntry& entry : quantity_table()) {
        for (std::size_t b = 0; b < fine.bands; ++b) {
            pool_quantity(scene, entry, b, fine, coarse);
        }
    }
    for (std::size_t i = 0; i < spec.ratios.size(); ++i) {
        pool_ratio(scene, spec.ratios[i], i, fine, coarse);
    }
}

}  // namespace quasimc
