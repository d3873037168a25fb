#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runfile/run_file.h"
#include "runfile/sweep.h"

namespace quasimc {

/// Dimensions of the points of a sweep: each swept key is a dimension, the last one varying
/// fastest; with combine = "zip" all points are one dimension, `point`.
class NetcdfSweep {
  public:
    /// @param run  run of a sweep; there are no dimensions for others
    explicit NetcdfSweep(const RunFile& run);

    struct Axis {
        std::string name;  ///< the key in [sweep], or "point"
        std::size_t size = 0;
    };
    /// The values of a key, along one of the axes.
    struct Key {
        std::string name;
        std::size_t axis = 0;
        std::vector<std::string> values;
    };

    [[nodiscard]] const std::vector<Axis>& axes() const { return axes_; }
    [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
    /// Index of a point along each axis.
    [[nodiscard]] std::vector<std::size_t> indices_of(std::size_t point) const;
    /// Whether the geometry of organs may differ between points.
    [[nodiscard]] bool changes_geometry() const { return changes_geometry_; }
    /// Whether times with light may be dark at other points.
    [[nodiscard]] bool changes_daylight() const { return changes_daylight_; }

  private:
    void add_keys(const SweepPlan& plan);

    std::vector<Axis> axes_;
    std::vector<Key> keys_;
    bool changes_geometry_ = false, changes_daylight_ = false;
};

}  // namespace quasimc
