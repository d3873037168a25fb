#include "solvers/ray_bundles/patch_light.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/ray_bundles/for_bands.h"
#include "solvers/ray_bundles/patch_scatter.h"

namespace quasimc {
namespace {

/// Orders end when a geometric series of all further ones is this fraction of the first one. Their
/// distribution over surfaces, that of the last one, need not be precise.
constexpr double kNegligible = 1e-3;

/// Whether the last order and all further ones are negligible in a pack.
bool is_negligible(const ScatteredFlux& flux, const PatchLight& light, std::size_t pack) {
    const BandPack& columns = light.packs()[pack];
    for (std::size_t c = columns.first; c < columns.first + columns.bands; ++c) {
        const std::size_t b = c % flux.last.size();
        if (flux.last[b] > 0 && !(flux.last[b] * flux.series(b) <= kNegligible * flux.first[b])) {
            return false;
        }
    }
    return true;
}

std::vector<std::size_t> all_packs(const PatchLight& light) {
    std::vector<std::size_t> packs(light.packs().size());
    std::iota(packs.begin(), packs.end(), 0);
    return packs;
}

/// The patches of a surface: [first, second).
std::pair<std::uint32_t, std::uint32_t> patches_of(
    const PatchScene& scene, const PatchScene::Surface& surface) {
    return {scene.patches.first(surface.triangle), scene.patches.first(surface.triangle + 1)};
}

/// Scatters light in the bands of a pack.
template <std::size_t kBands>
class PackScatter {
  public:
    /// @param pack  of the light
    /// @param sum  see PatchScatter
    PackScatter(PatchLight& light, std::size_t pack, double* sum)
        : scene_(light.scene()),
          each_(light.sides(pack), light.packs()[pack].first, sum),
          leaving_(light.packs()[pack].bands) {}

    /// @param lines  along which the light came; null: direct light
    /// @returns flux that leaves surfaces, by band of the pack
    const std::vector<double>& scatter(const LineStatistics* lines) {
        for (const PatchScene::Surface& surface : scene_.surfaces) {
            if (surface.is_sensor) {
                const auto [first, end] = patches_of(scene_, surface);
                for (std::size_t patch = first; patch < end; ++patch) {
                    each_.clear_incident(patch);
                }
                continue;
            }
            const double share =
                lines == nullptr ? 1
                                 : lines->areas.corrections[surface.region] * surface.exact_share;
            if (lines != nullptr) {
                even_out(surface);
            }
            scatter_from(surface, share);
        }
        return leaving_;
    }

  private:
    void scatter_from(const PatchScene::Surface& surface, double share) {
        const auto [first, end] = patches_of(scene_, surface);
        const PatchOptics& upper = scene_.of(surface.material, SurfaceSide::upper);
        const PatchOptics& lower = scene_.of(surface.material, SurfaceSide::lower);
        const CutTriangle* cut = scene_.patches.cut_of(surface.triangle);
        const double part = surface.area * scene_.patches.share(surface.triangle, 0);
        for (std::uint32_t patch = first; patch < end; ++patch) {
            const double area = cut == nullptr ? part : surface.area * cut->area(patch - first);
            each_.scatter(upper, lower, {patch, area, share}, leaving_.data());
        }
    }

    /// Spreads the incident light of each group of patches evenly over it: single patches are
    /// seldom met by lines, and would pass on light that was meant for others. Cut triangles keep
    /// theirs.
    void even_out(const PatchScene::Surface& surface) {
        if (scene_.patches.cut_of(surface.triangle) != nullptr) {
            return;
        }
        const std::vector<std::uint32_t>& parents =
            scene_.parents[static_cast<std::size_t>(scene_.patches.level(surface.triangle))];
        const std::size_t first = scene_.patches.first(surface.triangle);
        const std::size_t row = each_.row();
        light_.assign(parents.size() / 4 * row, 0);
        for (std::size_t i = 0; i < parents.size(); ++i) {
            each_.add_incident(first + i, .25, &light_[parents[i] * row]);
        }
        for (std::size_t i = 0; i < parents.size(); ++i) {
            each_.set_incident(first + i, &light_[parents[i] * row]);
        }
    }

    const PatchScene& scene_;
    PatchScatter<kBands> each_;
    std::vector<double> leaving_;
    std::vector<double> light_;  // of groups; scratch
};

/// The part of a pack in a sum of exitances: [2 * patch + side][band of the pack].
double* sum_of_pack(double* sum, const PatchScene& scene, const BandPack& pack) {
    return sum + std::size_t{2} * scene.patches.count() * pack.first;
}

/// Moves on the flux of the bands of scattered packs, which the columns have.
void update_bands(
    const PatchLight& light, const std::vector<std::size_t>& packs, ScatteredFlux& flux) {
    const std::size_t bands = light.bands() / light.scene().bands.origins();
    std::vector<double> sums(bands);
    std::vector<bool> is_scattered(bands);
    for (const std::size_t pack : packs) {
        const BandPack& columns = light.packs()[pack];
        for (std::size_t c = columns.first; c < columns.first + columns.bands; ++c) {
            sums[c % bands] += flux.last_by_column[c];
            is_scattered[c % bands] = true;
        }
    }
    flux.before.resize(bands);
    flux.last.resize(bands);
    for (std::size_t b = 0; b < bands; ++b) {
        if (is_scattered[b]) {
            flux.before[b] = flux.last[b];
            flux.last[b] = sums[b];
        }
    }
}

/// @param sum  receives the exitance of the previous order, or null
ScatteredOrder scatter_packs(PatchIrradiance irradiance, ScatteredFlux before, double* sum) {
    PatchLight& light = *irradiance.light;
    ScatteredFlux flux = std::move(before);
    flux.last_by_column.resize(light.bands());
    for (const std::size_t pack : irradiance.packs) {
        for_bands(light.packs()[pack].bands, [&]<std::size_t kBands>() {
            double* own =
                sum == nullptr ? nullptr : sum_of_pack(sum, light.scene(), light.packs()[pack]);
            PackScatter<kBands> of_pack(light, pack, own);
            const std::vector<double>& leaving =
                of_pack.scatter(irradiance.lines ? &*irradiance.lines : nullptr);
            std::ranges::copy(leaving, &flux.last_by_column[light.packs()[pack].first]);
        });
    }
    update_bands(light, irradiance.packs, flux);
    if (flux.first.empty()) {
        flux.first = flux.last;
    }
    PatchExitance exitance{static_cast<PatchField&&>(irradiance)};
    std::erase_if(
        exitance.packs, [&](std::size_t pack) { return is_negligible(flux, light, pack); });
    return {std::move(exitance), std::move(flux)};
}

}  // namespace

PatchLight::PatchLight(const PatchScene& scene)
    : scene_(scene),
      patches_(scene.patches.count()),
      bands_(scene.bands.count()),
      packs_(band_packs(bands_ / scene.bands.origins(), scene.bands.origins())),
      numbers_(4 * std::max<std::size_t>(1, patches_) * bands_) {}

void PatchLight::clear() {
    std::fill(numbers_.begin(), numbers_.end(), 0);
}

PatchIrradiance no_irradiance(std::unique_ptr<PatchLight> memory) {
    memory->clear();
    std::vector<std::size_t> packs = all_packs(*memory);
    return {{std::move(memory), std::move(packs)}, {}};
}

ScatteredOrder scatter(PatchIrradiance direct) {
    return scatter_packs(std::move(direct), {}, nullptr);
}

ExitanceSum::ExitanceSum(const PatchScene& scene, std::vector<double>& memory) : numbers_(memory) {
    numbers_.assign(size(scene), 0);
}

std::size_t ExitanceSum::size(const PatchScene& scene) {
    return std::size_t{2} * scene.patches.count() * scene.bands.count();
}

ScatteredOrder ExitanceSum::add_and_scatter(PatchIrradiance irradiance, ScatteredFlux before) {
    return scatter_packs(std::move(irradiance), std::move(before), numbers_.data());
}

void ExitanceSum::add_series(const ScatteredOrder& last) {
    PatchLight& light = *last.exitance.light;
    const std::size_t sides = std::size_t{2} * light.scene().patches.count();
    const std::vector<std::size_t>& sent = last.exitance.packs;
    for (std::size_t pack = 0; pack < light.packs().size(); ++pack) {
        if (std::find(sent.begin(), sent.end(), pack) != sent.end()) {
            continue;
        }
        const PatchSides<0> from = light.sides(pack);
        double* to = sum_of_pack(numbers_.data(), light.scene(), light.packs()[pack]);
        for (std::size_t b = 0; b < from.columns(); ++b) {
            const std::size_t band = (light.packs()[pack].first + b) % last.flux.last.size();
            const double factor = last.flux.last[band] > 0 ? last.flux.series(band) : 0;
            for (std::size_t side = 0; side < sides; ++side) {
                to[side * from.columns() + b] += factor * from.exitance(side)[b];
            }
        }
    }
}

PatchExitance ExitanceSum::exitance(std::unique_ptr<PatchLight> memory) const {
    std::vector<std::size_t> packs = all_packs(*memory);
    for (const std::size_t pack : packs) {
        const PatchSides<0> to = memory->sides(pack);
        const double* from = sum_of_pack(numbers_.data(), memory->scene(), memory->packs()[pack]);
        const std::size_t sides = std::size_t{2} * memory->scene().patches.count();
        for (std::size_t side = 0; side < sides; ++side, from += to.columns()) {
            std::copy_n(from, to.columns(), to.exitance(side));
        }
    }
    return {{std::move(memory), std::move(packs)}};
}

RegionFlux::RegionFlux(std::size_t regions, std::size_t bands)
    : bands_(bands), sums_(2 * regions * bands), missed_(bands) {}

RegionFlux::RegionFlux(const PatchIrradiance& irradiance, std::span<const double> corrections)
    : RegionFlux(irradiance.light->scene().region_areas.size(), irradiance.light->bands()) {
    for (std::size_t pack = 0; pack < irradiance.light->packs().size(); ++pack) {
        for (const PatchScene::Surface& surface : irradiance.light->scene().surfaces) {
            add(irradiance, surface, pack);
        }
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        sums_[i] *= corrections[i / bands_];
    }
}

void RegionFlux::add(
    const PatchIrradiance& irradiance, const PatchScene::Surface& surface, std::size_t pack) {
    PatchLight& light = *irradiance.light;
    const PatchSides<0> from = light.sides(pack);
    const BandPack& bands = light.packs()[pack];
    const double correction = irradiance.lines->areas.corrections[surface.region];
    const double share = correction * surface.exact_share;
    const double missing = surface.is_sensor ? 0 : correction - share;
    const auto [first_patch, end_patch] = patches_of(light.scene(), surface);
    const std::size_t end = std::size_t{2} * end_patch;
    for (std::size_t side = std::size_t{2} * first_patch; side < end; ++side) {
        const double* came = from.incident(side);
        double* sums = &sums_[(std::size_t{2} * surface.region + side % 2) * bands_];
        for (std::size_t b = bands.first; b < bands.first + bands.bands; ++b, ++came) {
            sums[b] += share * *came;
            missed_[b] += missing * *came;
        }
    }
}

}  // namespace quasimc
