#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "quasimc/gap_fraction.h"
#include "results/organ_height.h"
#include "results/organ_values.h"
#include "scene/lint.h"

namespace quasimc {
namespace {

std::string location_of(const GapFractionSpec& spec) {
    return spec.location.empty() ? fmt::format("gap_fraction '{}'", spec.name) : spec.location;
}

void check_rings(const std::vector<double>& rings, const std::string& where, Faults& faults) {
    const bool rises = std::is_sorted(rings.begin(), rings.end(), std::less_equal<>());
    const bool is_inside = std::all_of(
        rings.begin(), rings.end(), [](double angle) { return angle >= 0 && angle <= 90; });
    if (rings.size() < 2 || !rises || !is_inside) {
        faults.add(
            {where, "rings_deg are no bounds of rings",
             "they are at least two angles from the zenith, ascending within 0 to 90",
             "for example [0, 13, 28, 43, 58, 74]"});
    }
}

void check_number(
    std::string_view key,
    std::uint32_t value,
    std::uint32_t most,
    const std::string& where,
    Faults& faults) {
    if (value < 1 || value > most) {
        faults.add({where, fmt::format("{} is {}", key, value), fmt::format("1 ... {}", most), ""});
    }
}

void check_condition(
    const Scene& scene, const std::string& text, const std::string& where, Faults& faults) {
    try {
        if (!text.empty()) {
            const OrganValues values(scene, {});
            WhereExpression(text).check_names(values.names(), "label");
        }
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            faults.add({where, "where: " + fault.problem, fault.why, fault.suggestion});
        }
    }
}

void check_positions(
    const Scene& scene, const GapFractionSpec& spec, const std::string& where, Faults& faults) {
    if (spec.positions.empty()) {
        faults.add({where, "it has no positions", "", "give `at`"});
    }
    const bool are_near = std::ranges::all_of(spec.positions, [&](const Vec3& position) {
        return is_in_reach(scene, scene.orientation().inward(position));
    });
    if (!are_near) {
        faults.add({where, "a position is too far from the scene, or not finite", kReachRule, ""});
    }
    const Organ* ground = ground_of(scene);
    const double lowest = ground == nullptr ? 0 : height_of(scene, *ground).low;
    std::size_t below = 0, first = 0;
    for (std::size_t i = 0; i < spec.positions.size() && ground != nullptr; ++i) {
        if (scene.orientation().inward(spec.positions[i]).z < lowest) {
            first = below++ == 0 ? i : first;
        }
    }
    if (below > 0) {
        faults.add(
            {where,
             fmt::format(
                 "{} of {} positions below the ground (first: position {})", below,
                 spec.positions.size(), first + 1),
             "they see nothing", "raise them, or give above_ground = true in `at`"});
    }
}

}  // namespace

void check_gap_keys(const GapFractionSpec& spec, Faults& faults) {
    const std::string where = location_of(spec);
    check_rings(spec.rings_deg, where, faults);
    check_number("azimuths", spec.azimuths, kMaxGapAzimuths, where, faults);
    check_number("rays", spec.rays, kMaxGapRays, where, faults);
    check_number("replicates", spec.replicates, kMaxGapReplicates, where, faults);
}

void check_gap_fraction(const Scene& scene, const GapFractionSpec& spec, Faults& faults) {
    const std::string where = location_of(spec);
    check_gap_keys(spec, faults);
    check_condition(scene, spec.where, where, faults);
    check_positions(scene, spec, where, faults);
}

}  // namespace quasimc
