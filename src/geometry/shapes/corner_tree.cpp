#include "geometry/shapes/corner_tree.h"

#include <algorithm>
#include <numeric>

namespace quasimc {
namespace {

constexpr std::uint32_t kMaxInLeaf = 8;
constexpr std::size_t kDeepest = 64;  // every level halves the corners

/// Whether no point of a box is to the left of a line or on it, according to turn(): rounding
/// preserves the order of its results, so that one corner of the box gives the largest.
bool is_right_of(const Point2& a, const Point2& b, const Point2& low, const Point2& high) {
    const Point2 leftmost{b.t > a.t ? low.s : high.s, b.s > a.s ? high.t : low.t};
    return turn(a, b, leftmost) < 0;
}

}  // namespace

CornerTree::CornerTree(const std::vector<FlatCorner>& corners)
    : corners_(corners),
      order_(corners.size()),
      leaf_of_(corners.size()),
      is_removed_(corners.size()) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.push_back({{}, {}, 0, n, n, 0, 0});
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        set_box(nodes_[i]);
        split(i);
    }
}

void CornerTree::set_box(Node& node) const {
    node.low = node.high = corners_[order_[node.first]];
    for (std::uint32_t k = node.first; k < node.end; ++k) {
        const FlatCorner& p = corners_[order_[k]];
        node.low = {std::min(node.low.s, p.s), std::min(node.low.t, p.t)};
        node.high = {std::max(node.high.s, p.s), std::max(node.high.t, p.t)};
    }
}

void CornerTree::split(std::uint32_t index) {
    const Node node = nodes_[index];
    if (node.end - node.first <= kMaxInLeaf) {
        for (std::uint32_t k = node.first; k < node.end; ++k) {
            leaf_of_[order_[k]] = index;
        }
        return;
    }
    const bool along_s = node.high.s - node.low.s > node.high.t - node.low.t;
    const std::uint32_t middle = node.first + (node.end - node.first) / 2;
    const auto position = [&](std::uint32_t k) { return order_.begin() + k; };
    std::nth_element(
        position(node.first), position(middle), position(node.end),
        [&](std::uint32_t a, std::uint32_t b) {
            return along_s ? corners_[a].s < corners_[b].s : corners_[a].t < corners_[b].t;
        });
    nodes_[index].child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, {}, node.first, middle, middle - node.first, index, 0});
    nodes_.push_back({{}, {}, middle, node.end, node.end - middle, index, 0});
}

void CornerTree::remove(std::uint32_t corner) {
    is_removed_[corner] = true;
    std::uint32_t i = leaf_of_[corner];
    for (; i != 0; i = nodes_[i].parent) {
        --nodes_[i].remaining;
    }
    --nodes_.front().remaining;
}

std::optional<std::uint32_t> CornerTree::find_blocking(
    const std::array<FlatCorner, 3>& ear, Blocking blocking) const {
    const auto& [a, b, c] = ear;
    std::array<std::uint32_t, kDeepest> stack{};
    std::size_t size = 1;  // the root
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        const bool is_outside = node.remaining == 0 || is_right_of(a, b, node.low, node.high) ||
                                is_right_of(b, c, node.low, node.high) ||
                                is_right_of(c, a, node.low, node.high);
        if (is_outside) {
            continue;
        }
        if (node.child != 0) {
            stack[size++] = node.child;
            stack[size++] = node.child + 1;
        } else if (const auto found = find_in_leaf(node, ear, blocking)) {
            return found;
        }
    }
    return std::nullopt;
}

std::optional<std::uint32_t> CornerTree::find_in_leaf(
    const Node& leaf, const std::array<FlatCorner, 3>& ear, Blocking blocking) const {
    for (std::uint32_t k = leaf.first; k < leaf.end; ++k) {
        const std::uint32_t i = order_[k];
        if (!is_removed_[i] && blocks_ear(ear[0], ear[1], ear[2], corners_[i], blocking)) {
            return i;
        }
    }
    return std::nullopt;
}

}  // namespace quasimc
