#include "solvers/ray_bundles/patch_scene.h"

#include <algorithm>
#include <utility>

#include "quasimc/error.h"
#include "scene/scene.h"
#include "solvers/ray_bundles/patch_size.h"

namespace quasimc {
namespace {

double area_of(const PreparedScene& prepared, std::uint32_t triangle) {
    return length(prepared.caster().mesh().across(triangle)) / 2;
}

bool is_image(std::span<const VisibilityRole> roles, std::uint32_t triangle) {
    return !roles.empty() && roles[triangle] == VisibilityRole::omitted;
}

bool is_sensor(std::span<const VisibilityRole> roles, std::uint32_t triangle) {
    return !roles.empty() && roles[triangle] == VisibilityRole::sensor;
}

/// @returns by column
PatchOptics optics_of(const Side& side, const SolvedBands& bands) {
    const PatchOptics all = optics_of(side, bands.all());
    return {bands.select(all.reflected), bands.select(all.transmitted)};
}

/// By triangle, the one that represents all its periodic images; empty: each its own.
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

/// By level of triangles that have patches, and part: the part of the level above that holds it.
std::vector<std::vector<std::uint32_t>> parents_of(const Patches& patches) {
    std::vector<std::vector<std::uint32_t>> parents(Patches::kFinest + 1);
    for (std::uint32_t triangle = 0; triangle < patches.triangles(); ++triangle) {
        if (!patches.has(triangle)) {
            continue;
        }
        const int level = patches.level(triangle);
        std::vector<std::uint32_t>& of_level = parents[static_cast<std::size_t>(level)];
        const std::uint32_t parts = 1U << (2U * static_cast<unsigned>(level));
        for (auto i = static_cast<std::uint32_t>(of_level.size()); i < parts; ++i) {
            of_level.push_back(level > 0 ? TriangleParts(level).parent(i) : 0);
        }
    }
    return parents;
}

/// Intersections of surfaces, on the triangles that have patches.
std::vector<SurfaceCrossing> crossings_of(
    const PreparedScene& prepared, const std::stop_token& stop) {
    const SurfaceCrossings& all = prepared.caster().crossings(stop);
    if (all.gave_up) {
        throw InputError({{
            "method",
            "ray_bundles can't be used where very many triangles intersect",
            "dividing patches at the intersections would take too long",
            "use method = \"first_hits\"",
        }});
    }
    const auto is_sensor = [&](std::uint32_t triangle) {
        return prepared.optics().has_transparent &&
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

PatchScene::PatchScene(
    const PreparedScene& scene,
    const SolvedBands& solved,
    const ProjectedScene& projection,
    Patches cut)
    : prepared(scene),
      bands(solved),
      projected(projection),
      patches(std::move(cut)),
      region_areas(scene.scene().regions().size()),
      parents(parents_of(patches)) {
    const std::size_t columns = bands.count();
    for (const Material& material : data_of(prepared.scene()).materials) {
        for (const SurfaceSide side : kSurfaceSides) {
            optics.push_back(
                material.is_transparent()
                    ? PatchOptics{std::vector<double>(columns), std::vector<double>(columns)}
                    : optics_of(material.side(side), bands));
        }
    }
    const LocalMesh& mesh = prepared.caster().mesh();
    const std::uint32_t triangles = patches.triangles();
    representatives = find_representatives(prepared);
    std::vector<double> scattered(columns);
    std::vector<float> least_cosines;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        if (prepared.fields_of_view().any_narrow()) {
            least_cosines.push_back(
                static_cast<float>(prepared.fields_of_view().least_cosine(prepared.region(i))));
        }
        if (!patches.has(i)) {
            continue;
        }
        const double own = area_of(prepared, i);
        const PrimitiveInfo info = prepared.primitive(i);
        surfaces.push_back(
            {i, info.region, info.material, own, length(mesh.exact_across(i)) / (2 * own),
             is_sensor(projected.roles, i)});
        area += own;
        region_areas[info.region] += surfaces.back().is_sensor ? 0 : own;
        region_of_patch.resize(patches.first(i + 1), info.region);
        for (std::size_t c = 0; c < columns; ++c) {
            for (const SurfaceSide side : kSurfaceSides) {
                const PatchOptics& o = of(info.material, side);
                scattered[c] += own / 2 * (o.reflected[c] + o.transmitted[c]);
            }
        }
    }
    drawn = line_triangles(projected, patches, least_cosines);
    mean_albedo = area > 0 ? *std::max_element(scattered.begin(), scattered.end()) / area : 0;
}

}  // namespace quasimc
