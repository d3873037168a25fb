#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runfile/run_file.h"
#include "runfile/sweep.h"

namespace quasimc {

/// How the points of a sweep stand in a file: each swept key is a dimension, the last one varying
/// fastest, or all points are one dimension, `point`, where keys vary together.
class NetcdfSweep {
  public:
    /// @param run  one of a sweep or not; then there are no dimensions
    explicit NetcdfSweep(const RunFile& run);

    struct Axis {
        std::string name;  ///< as [sweep] states the key; "point"
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
    /// Where a point stands, along each axis.
    [[nodiscard]] std::vector<std::size_t> indices_of(std::size_t point) const;
    /// Whether organs may change from point to point, though they stay the same organs.
    [[nodiscard]] bool changes_geometry() const { return changes_geometry_; }
    /// Whether times with light may have none at other points.
    [[nodiscard]] bool changes_daylight() const { return changes_daylight_; }

  private:
    void add_keys(const SweepPlan& plan);

    std::vector<Axis> axes_;
    std::vector<Key> keys_;
    bool changes_geometry_ = false, changes_daylight_ = false;
};

}  // namespace quasimc
