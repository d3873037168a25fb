// Warnings about sensors inside closed organs.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "geometry/mesh/closed_surface.h"
#include "scene/lint.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// Organs whose check takes more steps than this, a fraction of a second, are omitted.
constexpr double kMaxSteps = 1e7;

bool transmits(const Material& material) {
    const auto side_transmits = [](const Side& side) {
        return std::ranges::any_of(side.lobes(), [](const Lobe& lobe) {
            return lobe.shape->hemisphere() == Hemisphere::transmitted;
        });
    };
    return side_transmits(material.side(SurfaceSide::upper)) ||
           side_transmits(material.side(SurfaceSide::lower));
}

bool is_opaque(const Scene& scene, const Organ& organ) {
    for (std::uint32_t i = 0; i < organ.region_count; ++i) {
        const Region& region = scene.regions()[organ.first_region + i];
        if (transmits(data_of(scene).materials[region.material.value])) {
            return false;
        }
    }
    return true;
}

/// The number of times that a surface without a rim goes round a point: the sum of the solid angles
/// of its triangles (Van Oosterom and Strackee 1983) over 4 pi.
double winding_number(const std::vector<Triangle>& triangles, const Vec3& p) {
    double half_angles = 0;
    for (const Triangle& t : triangles) {
        const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        half_angles += std::atan2(
            dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return half_angles / (2 * std::numbers::pi);
}

/// The image of a point in a periodic scene that is nearest to another point.
Vec3 nearest_image(Vec3 p, const Vec3& to, const Cell& cell) {
    p.x -= cell.along_x ? std::round((p.x - to.x) / cell.size_x) * cell.size_x : 0;
    p.y -= cell.along_y ? std::round((p.y - to.y) / cell.size_y) * cell.size_y : 0;
    return p;
}

bool is_within(const Bounds& bounds, const Vec3& p) {
    return bounds.low.x <= p.x && p.x <= bounds.high.x && bounds.low.y <= p.y &&
           p.y <= bounds.high.y && bounds.low.z <= p.z && p.z <= bounds.high.z;
}

/// Counts the points of sets that lie inside organs.
class HiddenPoints {
  public:
    explicit HiddenPoints(const Survey& survey)
        : survey_(survey), sets_(survey.scene.sensors().size()) {
        for (std::size_t s = 0; s < sets_.size(); ++s) {
            sets_[s].is_hidden.resize(survey.scene.sensors()[s].points.size());
        }
    }

    void add(std::size_t organ) {
        const std::vector<Candidate> inside = points_within(organ);
        const Organ& own = survey_.scene.organs()[organ];
        const double steps =
            static_cast<double>(own.triangle_count) * static_cast<double>(inside.size());
        if (inside.empty() || steps > kMaxSteps || !is_opaque(survey_.scene, own)) {
            return;
        }
        const std::vector<Triangle> triangles = survey_.scene.triangles_of(own);
        if (!is_closed(triangles)) {
            return;
        }
        for (const Candidate& candidate : inside) {
            if (std::abs(winding_number(triangles, candidate.position)) > 0.75) {
                Set& set = sets_[candidate.set];
                set.is_hidden[candidate.point] = true;
                if (set.first.empty()) {
                    set.first = fmt::format(
                        "'{}' in {}",
                        survey_.scene.sensors()[candidate.set].points[candidate.point].name,
                        describe_organ(own));
                }
            }
        }
    }

    [[nodiscard]] std::vector<Warning> warnings() const {
        std::vector<Warning> all;
        for (std::size_t s = 0; s < sets_.size(); ++s) {
            const auto count = std::ranges::count(sets_[s].is_hidden, true);
            if (count > 0) {
                all.push_back(
                    {fmt::format("sensors '{}'", survey_.scene.sensors()[s].name),
                     fmt::format(
                         "{} of {} points {} inside a closed organ (first: {}), which light from "
                         "outside does not reach; move them",
                         count, sets_[s].is_hidden.size(), count == 1 ? "is" : "are",
                         sets_[s].first)});
            }
        }
        return all;
    }

  private:
    struct Candidate {
        std::size_t set, point;
        Vec3 position;  ///< the image next to the organ
    };
    struct Set {
        std::vector<bool> is_hidden;
        std::string first;
    };

    [[nodiscard]] std::vector<Candidate> points_within(std::size_t organ) const {
        const Bounds& bounds = survey_.organ_bounds[organ];
        std::vector<Candidate> inside;
        for (std::size_t s = 0; s < sets_.size(); ++s) {
            const std::vector<SensorPoint>& points = survey_.scene.sensors()[s].points;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Vec3 p =
                    nearest_image(points[i].position, bounds.center(), survey_.scene.cell());
                if (is_within(bounds, p)) {
                    inside.push_back({s, i, p});
                }
            }
        }
        return inside;
    }

    const Survey& survey_;
    std::vector<Set> sets_;
};

}  // namespace

std::vector<Warning> lint_sensors(const Survey& survey) {
    constexpr double kMaxPairs = 1e8;
    double points = 0;
    for (const SensorSet& set : survey.scene.sensors()) {
        points += static_cast<double>(set.points.size());
    }
    const std::vector<Organ>& organs = survey.scene.organs();
    if (points == 0 || points * static_cast<double>(organs.size()) > kMaxPairs) {
        return {};
    }
    HiddenPoints hidden(survey);
    for (std::size_t i = 0; i < organs.size(); ++i) {
        hidden.add(i);
    }
    return hidden.warnings();
}

}  // namespace quasimc
