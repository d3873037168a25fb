#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/shapes/ear_cutter.h"

namespace quasimc {

/// The remaining corners of a polygon in a bounding volume hierarchy (split along the longer side
/// of each box): finds a corner in a triangle quickly.
class CornerTree {
  public:
    /// @param corners  must outlive the tree
    explicit CornerTree(const std::vector<FlatCorner>& corners);

    void remove(std::uint32_t corner);

    /// A remaining corner that blocks an ear (blocks_ear), if there is one.
    [[nodiscard]] std::optional<std::uint32_t> find_blocking(
        const std::array<FlatCorner, 3>& ear, Blocking blocking) const;

  private:
    struct Node {
        Point2 low, high;
        std::uint32_t first = 0, end = 0;  // range in order_
        std::uint32_t remaining = 0;       // corners that were not removed
        std::uint32_t parent = 0;
        std::uint32_t child = 0;  // the other one follows; 0: a leaf
    };

    void set_box(Node& node) const;
    /// Splits a node with many corners.
    void split(std::uint32_t index);
    [[nodiscard]] std::optional<std::uint32_t> find_in_leaf(
        const Node& leaf, const std::array<FlatCorner, 3>& ear, Blocking blocking) const;

    const std::vector<FlatCorner>& corners_;
    std::vector<std::uint32_t> order_;    // corners, grouped by node
    std::vector<std::uint32_t> leaf_of_;  // by corner
    std::vector<bool> is_removed_;
    std::vector<Node> nodes_;
};

}  // namespace quasimc
