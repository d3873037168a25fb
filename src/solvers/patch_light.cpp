#include "solvers/patch_light.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"

namespace quasimc {
namespace {

double area_of(const PreparedScene& prepared, std::uint32_t triangle) {
    return length(prepared.caster().mesh().across(triangle)) / 2;
}

bool is_image(std::span<const VisibilityRole> roles, std::uint32_t triangle) {
    return !roles.empty() && roles[triangle] == VisibilityRole::left_out;
}

bool is_sensor(std::span<const VisibilityRole> roles, std::uint32_t triangle) {
    return !roles.empty() && roles[triangle] == VisibilityRole::sensor;
}

PatchScene::Optics optics_of(const Side& side, std::size_t bands) {
    PatchScene::Optics optics{std::vector<double>(bands), std::vector<double>(bands)};
    for (const Lobe& lobe : side.lobes()) {
        const bool is_reflected = lobe.shape->hemisphere() == Hemisphere::reflected;
        for (std::size_t b = 0; b < bands; ++b) {
            (is_reflected ? optics.reflected : optics.transmitted)[b] += lobe.albedo[b];
        }
    }
    return optics;
}

}  // namespace

Patches make_patches(
    const PreparedScene& prepared, std::span<const VisibilityRole> roles, double most) {
    const std::uint32_t triangles = prepared.caster().mesh().triangle_count();
    double area = 0;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        area += is_image(roles, i) ? 0 : area_of(prepared, i);
    }
    const double usual = area / std::max(1.0, most);
    std::vector<std::uint8_t> levels;
    levels.reserve(triangles);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const double own = area_of(prepared, i);
        if (is_image(roles, i) || !(own > 0)) {
            levels.push_back(Patches::kNone);
        } else if (is_sensor(roles, i)) {
            levels.push_back(0);  // no light leaves it
        } else {
            const double level = std::round(std::log2(own / usual) / 2);
            levels.push_back(
                static_cast<std::uint8_t>(std::clamp(level, 1.0, double{Patches::kFinest})));
        }
    }
    return Patches(std::move(levels));
}

PatchScene::PatchScene(const PreparedScene& scene, const ProjectedScene& seen, Patches cut)
    : prepared(scene), patches(std::move(cut)) {
    const std::size_t bands = prepared.bands();
    for (const Material& material : prepared.scene().materials()) {
        for (const SurfaceSide side : kSurfaceSides) {
            optics.push_back(
                material.is_transparent()
                    ? Optics{std::vector<double>(bands), std::vector<double>(bands)}
                    : optics_of(material.side(side), bands));
        }
    }
    const RayCaster& caster = prepared.caster();
    const LocalMesh& mesh = caster.mesh();
    const std::uint32_t triangles = patches.triangles();
    std::vector<double> scattered(bands);
    std::vector<float> least_cosines;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        if (prepared.scene().cell().periodic()) {
            const bool image = i > 0 && caster.source(i) == caster.source(i - 1);
            representatives.push_back(image ? representatives.back() : i);
        }
        if (prepared.has_narrow()) {
            least_cosines.push_back(static_cast<float>(prepared.least_cosine(prepared.region(i))));
        }
        if (!patches.has(i)) {
            continue;
        }
        const double own = area_of(prepared, i);
        const PrimitiveInfo info = prepared.primitive(i);
        surfaces.push_back(
            {i, info.region, info.material, own / std::ldexp(1.0, 2 * patches.level(i)),
             length(mesh.exact_across(i)) / (2 * own), is_sensor(seen.roles, i)});
        area += own;
        for (std::size_t b = 0; b < bands; ++b) {
            for (const SurfaceSide side : kSurfaceSides) {
                const Optics& o = of(info.material, side);
                scattered[b] += own / 2 * (o.reflected[b] + o.transmitted[b]);
            }
        }
    }
    drawn = column_triangles(seen, patches, least_cosines);
    mean_albedo = area > 0 ? *std::max_element(scattered.begin(), scattered.end()) / area : 0;
}

PatchLight::PatchLight(const PatchScene& scene)
    : scene_(scene),
      bands_(scene.prepared.bands()),
      columns_(2 * bands_),
      incident_(std::size_t{2} * scene.patches.count() * columns_),
      exitance_(incident_.size()),
      sums_(2 * scene.prepared.scene().regions().size() * columns_),
      parents_(Patches::kFinest + 1) {
    for (const PatchScene::Surface& surface : scene.surfaces) {
        const int level = scene.patches.level(surface.triangle);
        std::vector<std::uint32_t>& parents = parents_[static_cast<std::size_t>(level)];
        const std::uint32_t parts = 1U << (2U * static_cast<unsigned>(level));
        for (std::uint32_t i = static_cast<std::uint32_t>(parents.size()); level > 0 && i < parts;
             ++i) {
            parents.push_back(Patches::parent(level, i));
        }
    }
}

void PatchLight::clear() {
    std::fill(incident_.begin(), incident_.end(), 0);
    std::fill(exitance_.begin(), exitance_.end(), 0);
    std::fill(sums_.begin(), sums_.end(), 0);
}

void PatchLight::add_direct(
    std::uint32_t triangle,
    std::uint32_t part,
    SurfaceSide side,
    double amount,
    std::span<const double> weights) {
    const std::size_t patch = scene_.patches.first(triangle) + part;
    double* to = &incident_[(2 * patch + index_of(side)) * columns_];
    for (std::size_t b = 0; b < bands_; ++b) {
        to[b] += amount * weights[b];
        to[bands_ + b] += amount * weights[b];
    }
}

PatchLight::Step PatchLight::scatter(bool is_direct) {
    Step step{std::vector<double>(columns_), std::vector<double>(columns_)};
    for (const PatchScene::Surface& surface : scene_.surfaces) {
        const std::uint32_t first = scene_.patches.first(surface.triangle);
        const std::uint32_t end = scene_.patches.first(surface.triangle + 1);
        const double share = is_direct ? 1 : surface.exact_share;
        for (std::uint32_t patch = first; !is_direct && patch < end; ++patch) {
            sum_patch(surface, patch, step);
        }
        for (std::uint32_t patch = first; !surface.is_sensor && patch < end; ++patch) {
            scatter_patch(surface, patch, share, step);
        }
        if (!surface.is_sensor) {
            even_out(surface);
        }
    }
    std::fill(incident_.begin(), incident_.end(), 0);
    return step;
}

/// Adds what fell on a patch to the sums of its region.
void PatchLight::sum_patch(const PatchScene::Surface& surface, std::uint32_t patch, Step& step) {
    const double share = surface.exact_share;
    double* sums = &sums_[std::size_t{2} * surface.region * columns_];
    const double* from = &incident_[std::size_t{2} * patch * columns_];
    for (std::size_t i = 0; i < 2 * columns_; ++i) {
        sums[i] += share * from[i];
        step.passed_by[i % columns_] += surface.is_sensor ? 0 : (1 - share) * from[i];
    }
}

/// The cosine law: light leaves a patch equally bright in all directions.
void PatchLight::scatter_patch(
    const PatchScene::Surface& surface, std::uint32_t patch, double share, Step& step) {
    const double per_area = share / surface.patch_area;
    for (const SurfaceSide side : kSurfaceSides) {
        const SurfaceSide other = opposite(side);
        const auto& reflected = scene_.of(surface.material, side).reflected;
        const auto& transmitted = scene_.of(surface.material, other).transmitted;
        const double* own = &incident_[(std::size_t{2} * patch + index_of(side)) * columns_];
        const double* across = &incident_[(std::size_t{2} * patch + index_of(other)) * columns_];
        double* out = &exitance_[(std::size_t{2} * patch + index_of(side)) * columns_];
        for (std::size_t i = 0; i < columns_; ++i) {
            const std::size_t b = i < bands_ ? i : i - bands_;
            out[i] = (reflected[b] * own[i] + transmitted[b] * across[i]) * per_area;
            step.scattered[i] += out[i] * surface.patch_area;
        }
    }
}

/// In the columns of the coarser level, each four patches get the mean of them.
void PatchLight::even_out(const PatchScene::Surface& surface) {
    const auto level = static_cast<std::size_t>(scene_.patches.level(surface.triangle));
    const std::vector<std::uint32_t>& parents = parents_[level];
    const std::size_t row = 2 * bands_;  // of a patch, both sides
    means_.assign(parents.size() / 4 * row, 0);
    const std::size_t first = scene_.patches.first(surface.triangle);
    const auto coarse = [&](std::size_t part, std::size_t i) -> double& {
        const std::size_t side = i / bands_;
        return exitance_[(2 * (first + part) + side) * columns_ + bands_ + i % bands_];
    };
    for (std::size_t part = 0; part < parents.size(); ++part) {
        for (std::size_t i = 0; i < row; ++i) {
            means_[parents[part] * row + i] += coarse(part, i) / 4;
        }
    }
    for (std::size_t part = 0; part < parents.size(); ++part) {
        for (std::size_t i = 0; i < row; ++i) {
            coarse(part, i) = means_[parents[part] * row + i];
        }
    }
}

}  // namespace quasimc
