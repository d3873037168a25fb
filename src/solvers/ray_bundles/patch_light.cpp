#include "solvers/ray_bundles/patch_light.h"

#include <algorithm>

#include "base/checks.h"
#include "solvers/ray_bundles/for_bands.h"

namespace quasimc {
namespace {

/// Of a region that is met by fewer lines in the mean, how often it is met tells little: at times
/// it is not met at all.
constexpr double kFewestMeetings = 10;

}  // namespace

PatchLight::PatchLight(const PatchScene& scene)
    : scene_(scene),
      patches_(scene.patches.count()),
      bands_(scene.prepared.bands()),
      columns_(2 * bands_),
      packs_(band_packs(bands_)),
      rests_(packs_.size()),
      leaving_(columns_),
      lines_(std::max<std::size_t>(1, patches_) * bands_),
      kept_(2 * patches_ * columns_),
      sums_(2 * scene.prepared.scene().regions().size() * columns_),
      found_areas_(scene.surfaces.size()),
      region_areas_(scene.prepared.scene().regions().size()),
      corrections_(region_areas_.size(), 1),
      met_areas_(region_areas_.size()),
      is_corrected_(region_areas_.size()),
      parents_(Patches::kFinest + 1) {
    for (const PatchScene::Surface& surface : scene.surfaces) {
        region_areas_[surface.region] += surface.is_sensor ? 0 : surface.area;
        const int level = scene.patches.level(surface.triangle);
        std::vector<std::uint32_t>& parents = parents_[static_cast<std::size_t>(level)];
        const std::uint32_t parts = 1U << (2U * static_cast<unsigned>(level));
        for (std::uint32_t i = static_cast<std::uint32_t>(parents.size()); level > 0 && i < parts;
             ++i) {
            parents.push_back(Patches::parent(level, i));
        }
    }
}

void PatchLight::count_lines(std::span<const std::uint32_t> lines, double weight) {
    EXPECT(lines.size() == found_areas_.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        found_areas_[i] += weight * lines[i];
    }
}

void PatchLight::correct_areas(double lines_per_area) {
    std::fill(met_areas_.begin(), met_areas_.end(), 0);
    for (std::size_t i = 0; i < found_areas_.size(); ++i) {
        met_areas_[scene_.surfaces[i].region] += found_areas_[i];
    }
    std::fill(found_areas_.begin(), found_areas_.end(), 0);
    for (std::size_t region = 0; region < met_areas_.size(); ++region) {
        is_corrected_[region] =
            region_areas_[region] * lines_per_area >= kFewestMeetings && met_areas_[region] > 0;
        corrections_[region] =
            is_corrected_[region] ? region_areas_[region] / met_areas_[region] : 1;
    }
}

void PatchLight::clear() {
    std::fill(rests_.begin(), rests_.end(), false);
    std::fill(found_areas_.begin(), found_areas_.end(), 0);
    std::fill(lines_.begin(), lines_.end(), CacheLine{});
    std::fill(kept_.begin(), kept_.end(), 0);
    std::fill(sums_.begin(), sums_.end(), 0);
}

std::vector<LitBands> PatchLight::lit_bands(std::span<const double> weights) {
    const auto is_lit = [](double weight) { return weight != 0; };
    std::vector<LitBands> lit;
    for (std::size_t p = 0; p < packs_.size(); ++p) {
        const auto own = weights.subspan(packs_[p].first, packs_[p].bands);
        const auto first = std::find_if(own.begin(), own.end(), is_lit);
        if (first != own.end()) {
            const auto end = std::find_if(own.rbegin(), own.rend(), is_lit).base();
            lit.push_back({sides(p), static_cast<std::size_t>(first - own.begin()), {first, end}});
        }
    }
    return lit;
}

const std::vector<double>& PatchLight::scatter(bool is_direct) {
    if (is_direct) {
        copy_to_coarse();
    }
    std::vector<double> scattered;
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
        if (rests(pack)) {
            continue;
        }
        scattered.assign(2 * packs_[pack].bands, 0);
        for_bands(packs_[pack].bands, [&]<std::size_t kBands>() {
            scatter_pack<kBands>(pack, is_direct, scattered);
        });
        for (std::size_t i = 0; i < scattered.size(); ++i) {
            leaving_[column(pack, i)] = scattered[i];
        }
    }
    return leaving_;
}

void PatchLight::rest(const std::vector<bool>& is_little) {
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
        bool is_all = true;
        for (std::size_t i = 0; i < 2 * packs_[pack].bands; ++i) {
            is_all = is_all && is_little[column(pack, i)];
        }
        rests_[pack] = rests_[pack] || is_all;
    }
}

template <std::size_t kBands>
void PatchLight::scatter_pack(std::size_t pack, bool is_direct, std::span<double> scattered) {
    const PatchScatter<kBands> each(sides(pack), packs_[pack].first, kept(pack));
    for (const PatchScene::Surface& surface : scene_.surfaces) {
        const std::uint32_t first = scene_.patches.first(surface.triangle);
        const std::uint32_t end = scene_.patches.first(surface.triangle + 1);
        if (surface.is_sensor) {
            for (std::size_t patch = first; patch < end; ++patch) {
                each.forget_incident(patch);
            }
            continue;
        }
        const PatchOptics& upper = scene_.of(surface.material, SurfaceSide::upper);
        const PatchOptics& lower = scene_.of(surface.material, SurfaceSide::lower);
        const double share = is_direct ? 1 : corrections_[surface.region] * surface.exact_share;
        const CutTriangle* cut = scene_.patches.cut_of(surface.triangle);
        const double part = surface.area * scene_.patches.share(surface.triangle, 0);
        for (std::uint32_t patch = first; patch < end; ++patch) {
            const double area = cut == nullptr ? part : surface.area * cut->area(patch - first);
            each.scatter(upper, lower, {patch, area, share}, scattered.data());
        }
        cut == nullptr ? even_out(surface, each) : even_out_cut(surface, *cut, each);
    }
}

void PatchLight::send_all_kept() {
    std::fill(rests_.begin(), rests_.end(), false);
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
        const PatchSides<0> to = sides(pack);
        const double* from = kept(pack);
        for (std::size_t side = 0; side < side_count(); ++side) {
            std::copy_n(from + side * to.columns(), to.columns(), to.exitance(side));
        }
    }
}

std::vector<double> PatchLight::collect() {
    std::vector<double> passed_by(columns_);
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
        for (const PatchScene::Surface& surface : scene_.surfaces) {
            collect_from(surface, pack, passed_by);
        }
    }
    return passed_by;
}

void PatchLight::collect_from(
    const PatchScene::Surface& surface, std::size_t pack, std::vector<double>& passed_by) {
    const PatchSides<0> from = sides(pack);
    const BandPack& bands = packs_[pack];
    const double correction = corrections_[surface.region];
    const double share = correction * surface.exact_share;
    const double missing = surface.is_sensor ? 0 : correction - share;
    const std::size_t end = std::size_t{2} * scene_.patches.first(surface.triangle + 1);
    for (std::size_t side = std::size_t{2} * scene_.patches.first(surface.triangle); side < end;
         ++side) {
        const double* came = from.incident(side);
        double* sums = &sums_[(std::size_t{2} * surface.region + side % 2) * columns_];
        for (std::size_t level = 0; level < 2; ++level) {
            const std::size_t first = level * bands_ + bands.first;
            for (std::size_t b = 0; b < bands.bands; ++b, ++came) {
                sums[first + b] += share * *came;
                passed_by[first + b] += missing * *came;
            }
        }
    }
}

/// What came straight from a source is the same on both levels.
void PatchLight::copy_to_coarse() {
    for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
        const PatchSides<0> all = sides(pack);
        for (std::size_t side = 0; side < side_count(); ++side) {
            double* came = all.incident(side);
            std::copy_n(came, packs_[pack].bands, came + packs_[pack].bands);
        }
    }
}

/// In the columns of the coarser level, each four patches get the mean of them.
template <std::size_t kBands>
void PatchLight::even_out(const PatchScene::Surface& surface, const PatchScatter<kBands>& each) {
    const auto level = static_cast<std::size_t>(scene_.patches.level(surface.triangle));
    const std::vector<std::uint32_t>& parents = parents_[level];
    const std::size_t row = each.row();
    means_.assign(parents.size() / 4 * row, 0);
    const std::size_t first = scene_.patches.first(surface.triangle);
    for (std::size_t part = 0; part < parents.size(); ++part) {
        each.add_coarse(first + part, .25, &means_[parents[part] * row]);
    }
    for (std::size_t part = 0; part < parents.size(); ++part) {
        each.set_coarse(first + part, &means_[parents[part] * row]);
    }
}

/// The same where patches are not equally large, nor four by four.
template <std::size_t kBands>
void PatchLight::even_out_cut(
    const PatchScene::Surface& surface, const CutTriangle& cut, const PatchScatter<kBands>& each) {
    const std::size_t row = each.row();
    const std::size_t first = scene_.patches.first(surface.triangle);
    means_.assign(cut.patches() * row, 0);
    areas_.assign(cut.patches(), 0);
    for (std::uint32_t patch = 0; patch < cut.patches(); ++patch) {
        const std::size_t group = cut.group(patch);
        areas_[group] += cut.area(patch);
        each.add_coarse(first + patch, cut.area(patch), &means_[group * row]);
    }
    for (std::uint32_t group = 0; group < cut.patches(); ++group) {
        for (std::size_t i = 0; areas_[group] > 0 && i < row; ++i) {
            means_[group * row + i] /= areas_[group];
        }
    }
    for (std::uint32_t patch = 0; patch < cut.patches(); ++patch) {
        if (cut.area(patch) > 0) {
            each.set_coarse(first + patch, &means_[cut.group(patch) * row]);
        }
    }
}

}  // namespace quasimc
