#include "solvers/patch_light.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"
#include "quasimc/error.h"
#include "solvers/for_bands.h"
#include "solvers/patch_size.h"

namespace quasimc {
namespace {

/// Of a region that is met by fewer lines in the mean, how often it is met tells little: at times
/// it is not met at all.
constexpr double kFewestMeetings = 10;

double area_of(const PreparedScene& prepared, std::uint32_t triangle) {
    return length(prepared.caster().mesh().across(triangle)) / 2;
}

bool is_image(std::span<const VisibilityRole> roles, std::uint32_t triangle) {
    return !roles.empty() && roles[triangle] == VisibilityRole::left_out;
}

bool is_sensor(std::span<const VisibilityRole> roles, std::uint32_t triangle) {
    return !roles.empty() && roles[triangle] == VisibilityRole::sensor;
}

PatchOptics optics_of(const Side& side, std::size_t bands) {
    PatchOptics optics{std::vector<double>(bands), std::vector<double>(bands)};
    for (const Lobe& lobe : side.lobes()) {
        const bool is_reflected = lobe.shape->hemisphere() == Hemisphere::reflected;
        for (std::size_t b = 0; b < bands; ++b) {
            (is_reflected ? optics.reflected : optics.transmitted)[b] += lobe.albedo[b];
        }
    }
    return optics;
}

/// Which triangle stands for all images of one, by triangle; empty: each for itself.
std::vector<std::uint32_t> find_representatives(const PreparedScene& prepared) {
    std::vector<std::uint32_t> found;
    if (prepared.scene().cell().periodic()) {
        const RayCaster& caster = prepared.caster();
        for (std::uint32_t i = 0; i < caster.mesh().triangle_count(); ++i) {
            const bool image = i > 0 && caster.source(i) == caster.source(i - 1);
            found.push_back(image ? found.back() : i);
        }
    }
    return found;
}

/// Where surfaces cross those that light leaves, on the triangles that have patches.
std::vector<SurfaceCrossing> crossings_of(
    const PreparedScene& prepared, const std::stop_token& stop) {
    const SurfaceCrossings& all = prepared.caster().crossings(stop);
    if (all.gave_up) {
        throw InputError({{
            "method",
            "ray_bundles, where very many triangles cross each other, or their boxes overlap",
            "patches are cut where surfaces cross, which would take too long",
            "use method = \"first_hits\"",
        }});
    }
    const auto is_sensor = [&](std::uint32_t triangle) {
        return prepared.has_transparent() &&
               prepared.material(prepared.region(triangle)).is_transparent();
    };
    const std::vector<std::uint32_t> representatives = find_representatives(prepared);
    std::vector<SurfaceCrossing> crossings;
    for (SurfaceCrossing crossing : all.found) {
        if (!is_sensor(crossing.triangle) && !is_sensor(crossing.other)) {
            crossing.triangle =
                representatives.empty() ? crossing.triangle : representatives[crossing.triangle];
            crossings.push_back(crossing);
        }
    }
    return crossings;
}

}  // namespace

Patches make_patches(
    const PreparedScene& prepared,
    std::span<const VisibilityRole> roles,
    double most,
    const std::stop_token& stop) {
    const LocalMesh& mesh = prepared.caster().mesh();
    const std::uint32_t triangles = mesh.triangle_count();
    double area = 0;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        area += is_image(roles, i) ? 0 : area_of(prepared, i);
    }
    const double usual = area * patch_size(prepared.scene(), most).part;
    std::vector<std::uint8_t> levels;
    levels.reserve(triangles);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const double own = area_of(prepared, i);
        if (is_image(roles, i) || !(own > 0)) {
            levels.push_back(Patches::kNone);
        } else if (is_sensor(roles, i)) {
            levels.push_back(0);  // no light leaves it
        } else {
            levels.push_back(static_cast<std::uint8_t>(patch_level(own, usual)));
        }
    }
    return Patches(std::move(levels), crossings_of(prepared, stop));
}

PatchScene::PatchScene(const PreparedScene& scene, const ProjectedScene& seen, Patches cut)
    : prepared(scene), patches(std::move(cut)) {
    const std::size_t bands = prepared.bands();
    for (const Material& material : prepared.scene().materials()) {
        for (const SurfaceSide side : kSurfaceSides) {
            optics.push_back(
                material.is_transparent()
                    ? PatchOptics{std::vector<double>(bands), std::vector<double>(bands)}
                    : optics_of(material.side(side), bands));
        }
    }
    const LocalMesh& mesh = prepared.caster().mesh();
    const std::uint32_t triangles = patches.triangles();
    representatives = find_representatives(prepared);
    std::vector<double> scattered(bands);
    std::vector<float> least_cosines;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        if (prepared.has_narrow()) {
            least_cosines.push_back(static_cast<float>(prepared.least_cosine(prepared.region(i))));
        }
        if (!patches.has(i)) {
            continue;
        }
        const double own = area_of(prepared, i);
        const PrimitiveInfo info = prepared.primitive(i);
        surfaces.push_back(
            {i, info.region, info.material, own, length(mesh.exact_across(i)) / (2 * own),
             is_sensor(seen.roles, i)});
        area += own;
        for (std::size_t b = 0; b < bands; ++b) {
            for (const SurfaceSide side : kSurfaceSides) {
                const PatchOptics& o = of(info.material, side);
                scattered[b] += own / 2 * (o.reflected[b] + o.transmitted[b]);
            }
        }
    }
    drawn = column_triangles(seen, patches, least_cosines);
    mean_albedo = area > 0 ? *std::max_element(scattered.begin(), scattered.end()) / area : 0;
}

LitBands lit_bands(std::span<const double> weights) {
    const auto is_lit = [](double weight) { return weight != 0; };
    const auto first = std::find_if(weights.begin(), weights.end(), is_lit);
    const auto last = std::find_if(weights.rbegin(), weights.rend(), is_lit).base();
    const auto before = static_cast<std::size_t>(first - weights.begin());
    return {
        before, first < last ? std::span<const double>(first, last) : std::span<const double>()};
}

PatchLight::PatchLight(const PatchScene& scene)
    : scene_(scene),
      bands_(scene.prepared.bands()),
      columns_(2 * bands_),
      lines_(std::max<std::size_t>(1, scene.patches.count()) * bands_),
      kept_(std::size_t{2} * scene.patches.count() * columns_),
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
    std::fill(found_areas_.begin(), found_areas_.end(), 0);
    std::fill(lines_.begin(), lines_.end(), CacheLine{});
    std::fill(kept_.begin(), kept_.end(), 0);
    std::fill(sums_.begin(), sums_.end(), 0);
}

void PatchLight::add_direct(
    std::uint32_t patch, SurfaceSide side, double amount, const LitBands& bands) {
    double* to = sides().incident(std::size_t{2} * patch + index_of(side)) + bands.first;
    for (std::size_t i = 0; i < bands.weights.size(); ++i) {
        to[i] += amount * bands.weights[i];
    }
}

std::vector<double> PatchLight::scatter(bool is_direct) {
    std::vector<double> scattered(columns_);
    if (is_direct) {
        copy_to_coarse();
    }
    for_bands(bands_, [&]<std::size_t kBands>() { scatter_all<kBands>(is_direct, scattered); });
    return scattered;
}

template <std::size_t kBands>
void PatchLight::scatter_all(bool is_direct, std::vector<double>& scattered) {
    const PatchScatter<kBands> each(sides(), kept_.data());
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
    for (std::size_t side = 0; side < side_count(); ++side) {
        std::copy_n(&kept_[side * columns_], columns_, sides().exitance(side));
    }
}

std::vector<double> PatchLight::collect() {
    std::vector<double> passed_by(columns_);
    for (const PatchScene::Surface& surface : scene_.surfaces) {
        const double correction = corrections_[surface.region];
        const double share = correction * surface.exact_share;
        const double missing = surface.is_sensor ? 0 : correction - share;
        const std::size_t end = std::size_t{2} * scene_.patches.first(surface.triangle + 1);
        for (std::size_t side = std::size_t{2} * scene_.patches.first(surface.triangle); side < end;
             ++side) {
            const double* from = sides().incident(side);
            double* sums = &sums_[(std::size_t{2} * surface.region + side % 2) * columns_];
            for (std::size_t i = 0; i < columns_; ++i) {
                sums[i] += share * from[i];
                passed_by[i] += missing * from[i];
            }
        }
    }
    return passed_by;
}

/// What came straight from a source is the same on both levels.
void PatchLight::copy_to_coarse() {
    for (std::size_t side = 0; side < side_count(); ++side) {
        double* came = sides().incident(side);
        std::copy_n(came, bands_, came + bands_);
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
