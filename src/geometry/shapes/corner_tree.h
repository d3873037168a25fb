#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/shapes/ear_cutter.h"

namespace quasimc {

/// The corners of a polygon that are left, halved again and again along the longer side of their
/// box: finds one in a triangle without a look at most of the others.
class CornerTree {
  public:
    /// @param corners  outlive the tree
    explicit CornerTree(const std::vector<FlatCorner>& corners);

    void remove(std::uint32_t corner);

    /// A corner that is left and in the way of an ear (blocks_ear), if there is one.
    [[nodiscard]] std::optional<std::uint32_t> find_blocking(
        const std::array<FlatCorner, 3>& ear, Blocking blocking) const;

  private:
    struct Node {
        Point2 low, high;
        std::uint32_t first = 0, end = 0;  // of order_
        std::uint32_t left_over = 0;       // corners that were not removed
        std::uint32_t parent = 0;
        std::uint32_t child = 0;  // the other one follows it; 0: it has none
    };

    void set_box(Node& node) const;
    /// Gives a node two children, if it has many corners.
    void split(std::uint32_t index);
    [[nodiscard]] std::optional<std::uint32_t> find_in_leaf(
        const Node& leaf, const std::array<FlatCorner, 3>& ear, Blocking blocking) const;

    const std::vector<FlatCorner>& corners_;
    std::vector<std::uint32_t> order_;    // corners, those of each node side by side
    std::vector<std::uint32_t> leaf_of_;  // by corner
    std::vector<bool> is_removed_;
    std::vector<Node> nodes_;
};

}  // namespace quasimc
