#pragma once

// [sweep]: the keys of a run file that take several values in turn.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run_file.h"
#include "text/document.h"
#include "text/table_reader.h"

namespace quasimc {

/// Largest number of points of a sweep.
inline constexpr std::size_t kMaxSweepPoints = 100000;

/// A key of [sweep] and its values.
struct SweptKey {
    std::string path;        ///< given path: "material.leaf.reflectance"
    std::uint32_t line = 0;  ///< 0: unknown
    Node::List values;       ///< one or more

    /// The full path, as options may be given by their key alone.
    [[nodiscard]] std::string from_top() const;
};

/// The runs of a file. Without [sweep] there is one point, which sets no key.
class SweepPlan {
  public:
    /// Plans the sweep of a document; reports faults of its [sweep].
    SweepPlan(const Node& document, Reporter& reporter);

    [[nodiscard]] const std::vector<SweptKey>& keys() const { return keys_; }
    [[nodiscard]] std::size_t points() const { return points_; }
    /// Whether all combinations of values are points (combine = "product"); otherwise the n-th
    /// values of all keys are a point ("zip"). A single key is a product.
    [[nodiscard]] bool is_product() const { return !is_zip_ || keys_.size() < 2; }
    /// Index of a key's value at a point. In a product the last key varies fastest.
    [[nodiscard]] std::size_t value_at(std::size_t key, std::size_t point) const;
    /// The values of a point.
    [[nodiscard]] std::vector<SweptValue> values_at(std::size_t point) const;
    /// The weight of a point in sums; 1 by default.
    [[nodiscard]] double weight_at(std::size_t point) const {
        return weights_.empty() ? 1 : weights_[point];
    }
    /// Whether no key changes organs, ground or cell, so that all points have the same triangles.
    [[nodiscard]] bool keeps_geometry() const;
    /// The document of a point, with its values and without [sweep]. Reports missing keys.
    [[nodiscard]] Node document_at(
        const Node& document, std::size_t point, Reporter& reporter) const;

  private:
    void read_keys(const Node& table, const std::string& prefix, Reporter& reporter);
    void read_combination(const Member& member, Reporter& reporter);
    void check_keys(Reporter& reporter) const;
    void count_points(const Node& table, std::size_t given, Reporter& reporter);

    std::vector<SweptKey> keys_;
    std::size_t points_ = 1;
    std::vector<double> weights_;  // by point
    bool is_zip_ = false;
};

/// A value as TOML: 0.1, [0.1, 0.4], "sobol".
[[nodiscard]] std::string node_text(const Node& node);

}  // namespace quasimc
