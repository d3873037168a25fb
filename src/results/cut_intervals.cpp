#include "results/cut_intervals.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/parallel.h"
#include "results/organ_blocks.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

/// @param values  [quantity][band] of an organ or of a group
void cut(const OrganLimits& most, double area, std::size_t bands, std::span<Estimate> values) {
    const double per_area = area > 0 ? 1 / area : 0;
    for (const QuantityEntry& entry : quantity_table()) {
        for (std::size_t b = 0; b < bands; ++b) {
            Estimate& e = values[static_cast<std::size_t>(entry.quantity) * bands + b];
            e = not_above(e, most.of(entry.quantity, b) * (entry.is_flux ? 1 : per_area));
        }
    }
}

/// @param values  [quantity][band] of the parts of an organ or of a group
void cut_sunlit_fractions(
    const OrganLimits& most, double area, std::size_t bands, std::span<Estimate> values) {
    for (const SunShadeEntry& entry : sun_shade_table()) {
        for (std::size_t b = 0; !entry.has_bands() && b < bands; ++b) {
            Estimate& e = values[static_cast<std::size_t>(entry.quantity) * bands + b];
            e = not_above(e, area > 0 ? most.sunlit_area / area : 0);
        }
    }
}

void cut_organs(
    const PhysicalBounds& limits, const Scene& scene, const EvaluationSpec& spec, Result& result) {
    const std::size_t values = kQuantities * result.bands;
    for_each_block(scene, spec.threads, [&](std::size_t first, std::size_t last) {
        OrganLimits most = limits.none();
        for (std::size_t i = first; i < last; ++i) {
            const Organ& organ = scene.organs()[i];
            limits.find(organ, most);
            cut(most, organ.area, result.bands,
                std::span(result.values).subspan(i * values, values));
            if (!result.sunlit_fraction.empty()) {
                Estimate& sunlit = result.sunlit_fraction[i];
                sunlit = not_above(sunlit, organ.area > 0 ? most.sunlit_area / organ.area : 0);
            }
            if (!result.sun_shade.empty()) {
                const std::size_t size = result.sun_shade.values_per_row();
                cut_sunlit_fractions(
                    most, organ.area, result.bands,
                    std::span(result.sun_shade.values).subspan(i * size, size));
            }
        }
    });
}

/// Upper limits of the light of all organs of a group.
OrganLimits limits_of(const PhysicalBounds& limits, const Scene& scene, const OrganGroup& group) {
    OrganLimits sum = limits.none(), own = sum;
    for (const std::uint32_t index : group.organs) {
        limits.find(scene.organs()[index], own);
        sum += own;
    }
    return sum;
}

/// In a scene that is periodic along both axes all emitted light crosses the horizontal plane, and
/// no fraction exceeds it.
void cut_fractions(const Scene& scene, std::vector<CanopyFractions>& canopy) {
    const bool is_infinite = scene.cell().along_x && scene.cell().along_y;
    for (CanopyFractions& band : canopy) {
        for (Estimate CanopyFractions::*part :
             {&CanopyFractions::reflectance, &CanopyFractions::absorptance,
              &CanopyFractions::ground_absorptance}) {
            band.*part = is_infinite ? not_above(band.*part, 1) : band.*part;
        }
    }
}

}  // namespace

void cut_groups(
    const PhysicalBounds& limits,
    const Scene& scene,
    const EvaluationSpec& spec,
    GroupResults& all) {
    const std::size_t values = kQuantities * all.bands;
    parallel_blocks(all.groups.size(), spec.threads, [&](std::uint64_t g, unsigned) {
        const OrganGroup& group = all.groups[g];
        const OrganLimits most = limits_of(limits, scene, group);
        cut(most, group.area, all.bands, std::span(all.values).subspan(g * values, values));
        if (!all.sunlit_area.empty()) {
            all.sunlit_area[g] = not_above(all.sunlit_area[g], most.sunlit_area);
            all.sunlit_fraction[g] =
                not_above(scaled(all.sunlit_area[g], group.area > 0 ? 1 / group.area : 0), 1);
        }
        if (!all.sun_shade.empty()) {
            const std::size_t size = all.sun_shade.values_per_row();
            cut_sunlit_fractions(
                most, group.area, all.bands,
                std::span(all.sun_shade.values).subspan(g * size, size));
        }
    });
}

void cut_intervals(
    const PhysicalBounds& limits, const Scene& scene, const EvaluationSpec& spec, Result& result) {
    cut_organs(limits, scene, spec, result);
    cut_groups(limits, scene, spec, result.groups);
    cut_fractions(scene, result.canopy);
}

}  // namespace quasimc
