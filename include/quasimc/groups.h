#pragma once

// Organs taken together: plants, kinds of organs, horizontal layers.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/run_spec.h"

namespace quasimc {

class Scene;

/// OrganGroup::by of the group of all organs, and of layers.
inline constexpr std::string_view kAllOrgans = "all", kLayer = "layer";

/// Which organs are taken together.
struct GroupSpec {
    /// Keys of labels: each value of "plant" is a group, each pair of values of "plant+kind".
    std::vector<std::string> labels = {};
    /// Layers of equal height, from the ground (or the lowest point of the organs) to the highest
    /// point of the organs; 0: none.
    std::uint32_t layers = 0;
    /// Instead: the heights between layers, ascending, at least two; scene units, up.
    std::vector<double> layer_heights = {};
};

/// The groups that a run is asked for.
[[nodiscard]] inline GroupSpec group_spec(const RunSpec& spec) {
    return {spec.groups, spec.layers, spec.layer_heights};
}

/// Organs whose light is summed. Only organs that are measured belong to groups, the ground to
/// none, and sensors to those of labels alone.
struct OrganGroup {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    std::string by;     ///< kAllOrgans, kLayer, or the key of labels as it was asked for
    std::string value;  ///< of the label ("1+leaf" of two); the number of the layer, from 1 below
    std::vector<std::uint32_t> organs = {};  ///< places in the scene's list, ascending
    double area = 0;                         ///< one-sided, of all its organs
    /// Of a layer: its lower and upper height. An organ belongs to the layer that holds the
    /// centroid of its area (the last layer, its upper height too).
    double low = kNone, high = kNone;
    /// Of a layer above a ground or in a cell that is periodic along both axes: one-sided area of
    /// its organs (leaf area, where all are leaves) per horizontal area; and that of the organs of
    /// this layer and those above.
    double plant_area_index = kNone, cumulative_plant_area_index = kNone;
};

/// The groups of a scene: all organs first, then those of labels in the order in which values first
/// appear, then layers from below.
/// @param spec  that check_groups() found no fault with
[[nodiscard]] std::vector<OrganGroup> make_groups(const Scene& scene, const GroupSpec& spec);

}  // namespace quasimc
