// Warnings about where organs are: the periodic cell and the ground.

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "scene/lint.h"

namespace quasimc {
namespace {

/// Two horizontal axes, one after the other.
struct Axis {
    char name;
    double Vec3::*of;
};
constexpr std::array kAxes{Axis{'x', &Vec3::x}, Axis{'y', &Vec3::y}};

/// The period along an axis; 0 if the scene is open along it.
double period(const Cell& cell, const Axis& axis) {
    if (axis.name == 'x') {
        return cell.along_x ? cell.size_x : 0;
    }
    return cell.along_y ? cell.size_y : 0;
}

std::vector<Warning> lint_ground_size(const Survey& survey, const Bounds& ground) {
    const Scene& scene = survey.scene;
    const std::string where = describe_organ(scene.organs().back());
    std::vector<Warning> warnings;
    if (length(ground.size()) == 0) {  // organs lie on all of it
        return warnings;
    }
    for (const Axis& axis : kAxes) {
        constexpr double kOverhang = 0.01;
        const double size = ground.size().*(axis.of);
        const double cell_size = period(scene.cell(), axis);
        if (cell_size > 0) {
            if (size < (1 - kOverhang) * cell_size) {
                warnings.push_back(
                    {where,
                     fmt::format(
                         "covers {:.3g} of the cell's {:.3g} along {}; light escapes beside it",
                         size, cell_size, axis.name)});
            }
            continue;
        }
        if (survey.canopy.empty()) {
            continue;
        }
        const double canopy = survey.canopy.size().*(axis.of);
        const double beyond = std::max(
            ground.low.*(axis.of) - survey.canopy.low.*(axis.of),
            survey.canopy.high.*(axis.of) - ground.high.*(axis.of));
        if (beyond > kOverhang * canopy) {
            warnings.push_back(
                {where, fmt::format(
                            "is smaller than the canopy, which extends {:.3g} beyond it along {}; "
                            "light escapes beside it",
                            beyond, axis.name)});
        }
    }
    return warnings;
}

std::vector<Warning> lint_below(const Survey& survey, double height) {
    const Scene& scene = survey.scene;
    WarningKind below("organ extends below the ground", "organs extend below the ground");
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        const Bounds& bounds = survey.organ_bounds[i];
        constexpr double kRounding = 1e-4;
        const double depth = height - bounds.low.z;
        if (organ.is_ground || depth <= kRounding * 2 * bounds.radius()) {
            continue;
        }
        below.add(
            describe_organ(organ), bounds.high.z <= height
                                       ? fmt::format("is below the ground (height {:.6g})", height)
                                       : fmt::format("extends {:.3g} below the ground", depth));
    }
    return std::move(below).finish();
}

}  // namespace

std::vector<Warning> lint_cell(const Survey& survey) {
    const Scene& scene = survey.scene;
    WarningKind wide("organ is wider than three cells", "organs are wider than three cells");
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        if (scene.organs()[i].is_ground) {
            continue;
        }
        for (const Axis& axis : kAxes) {
            constexpr double kManyCells = 3;
            const double size = survey.organ_bounds[i].size().*(axis.of);
            const double cell_size = period(scene.cell(), axis);
            if (cell_size > 0 && size > kManyCells * cell_size) {
                wide.add(
                    describe_organ(scene.organs()[i]),
                    fmt::format(
                        "is {:.3g} long along {}, the cell {:.3g}: it overlaps its periodic copies",
                        size, axis.name, cell_size));
                break;
            }
        }
    }
    return std::move(wide).finish();
}

std::vector<Warning> lint_ground(const Survey& survey) {
    if (ground_of(survey.scene) == nullptr) {
        return {};
    }
    const Bounds& ground = survey.organ_bounds.back();
    std::vector<Warning> warnings = lint_ground_size(survey, ground);
    if (ground.size().z == 0) {
        std::vector<Warning> below = lint_below(survey, ground.low.z);
        std::move(below.begin(), below.end(), std::back_inserter(warnings));
    }
    return warnings;
}

}  // namespace quasimc
