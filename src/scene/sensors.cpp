#include "scene/sensors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "scene/scene_checks.h"

namespace quasimc {
namespace {

/// A direction of any length, as the file has it, as a unit vector with z up.
Vec3 facing_of(const Vec3& given, const Orientation& orientation) {
    const double largest = std::max({std::abs(given.x), std::abs(given.y), std::abs(given.z)});
    return largest > 0 ? normalized(orientation.inward(given / largest)) : Vec3{0, 0, 1};
}

/// Checks and completes a set.
class SetCheck {
  public:
    SetCheck(SensorSet& set, Faults& faults) : set_(set), faults_(faults) {}

    void run(const Orientation& orientation) {
        if (set_.points.empty()) {
            fault("it has no points", "", "give at least one");
        }
        if (!(set_.field_of_view_deg > 0 && set_.field_of_view_deg <= 90)) {
            fault(
                fmt::format("its field of view is {} degrees", shortest(set_.field_of_view_deg)),
                "the half angle about the normal must be above 0 and at most 90", "");
        }
        if (!(set_.radius >= 0 && set_.radius <= kLargestCoordinate)) {
            fault(
                fmt::format("its radius is {}", shortest(set_.radius)), "it must be 0 or more", "");
        }
        const std::size_t cells = set_.counts[0] * set_.counts[1];
        if (cells != 0 && cells != set_.points.size()) {
            fault(
                fmt::format("it has {} points", set_.points.size()),
                fmt::format("an array of {} x {} has {}", set_.counts[0], set_.counts[1], cells),
                "");
        }
        complete_points(orientation);
    }

    void fault(std::string problem, std::string why, std::string suggestion) {
        const std::string name = fmt::format("sensors '{}'", set_.name);
        faults_.add(
            {set_.where.empty() ? name : set_.where + ": " + name, std::move(problem),
             std::move(why), std::move(suggestion)});
    }

  private:
    void complete_points(const Orientation& orientation) {
        std::size_t bad = 0, first = 0;
        for (std::size_t i = 0; i < set_.points.size(); ++i) {
            SensorPoint& point = set_.points[i];
            const double largest = std::max(
                {std::abs(point.position.x), std::abs(point.position.y),
                 std::abs(point.position.z)});
            const bool is_good = is_finite(point.position) && is_finite(point.facing) &&
                                 largest <= kLargestCoordinate;
            first = is_good || bad > 0 ? first : i + 1;
            bad += is_good ? 0 : 1;
            point.position = orientation.inward(point.position);
            point.facing = facing_of(point.facing, orientation);
            if (point.name.empty()) {
                point.name =
                    set_.points.size() == 1 ? set_.name : fmt::format("{} {}", set_.name, i + 1);
            }
        }
        if (bad > 0) {
            fault(
                fmt::format(
                    "{} of {} points have no position (first: {})", bad, set_.points.size(), first),
                "a coordinate is not finite, or too large", "");
        }
    }

    SensorSet& set_;
    Faults& faults_;
};

}  // namespace

std::vector<SensorSet> check_sensors(
    std::vector<SensorSet> sensors, const Orientation& orientation, Faults& faults) {
    std::set<std::string> names;
    for (SensorSet& set : sensors) {
        SetCheck check(set, faults);
        check.run(orientation);
        if (!names.insert(set.name).second) {
            check.fault(
                "other sensors have this name", "their results could not be distinguished",
                "give another name");
        }
    }
    return sensors;
}

std::size_t sensor_rows(const Scene& scene) {
    std::size_t rows = 0;
    for (const SensorSet& set : scene.sensors()) {
        rows += set.rows();
    }
    return rows;
}

std::vector<bool> spheres_of(const Scene& scene) {
    std::vector<bool> spheres;
    for (const SensorSet& set : scene.sensors()) {
        spheres.insert(spheres.end(), set.rows(), set.receiver == Receiver::sphere);
    }
    return spheres;
}

std::vector<Vec3> sensor_positions(const Scene& scene) {
    std::vector<Vec3> positions;
    for (const SensorSet& set : scene.sensors()) {
        Vec3 sum;
        for (const SensorPoint& point : set.points) {
            sum += point.position;
            if (!set.is_averaged) {
                positions.push_back(point.position);
            }
        }
        if (set.is_averaged) {
            positions.push_back(sum / static_cast<double>(set.points.size()));
        }
    }
    return positions;
}

}  // namespace quasimc
