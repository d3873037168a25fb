#pragma once

// [sweep]: the keys of a run file that take several values, one after the other.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run_file.h"
#include "text/document.h"
#include "text/table_reader.h"

namespace quasimc {

/// The most points that a sweep may have.
inline constexpr std::size_t kMaxSweepPoints = 100000;

/// A key of [sweep] and its values.
struct SweptKey {
    std::string path;        ///< as stated: "material.leaf.reflectance"
    std::uint32_t line = 0;  ///< 0: not known
    Node::List values;       ///< one or more

    /// The path from the top of the file: options may be stated by their key alone.
    [[nodiscard]] std::string from_top() const;
};

/// Which runs a file asks for. Without [sweep] there is one point, which sets nothing.
class SweepPlan {
  public:
    /// Of a document; reports what is wrong with its [sweep].
    SweepPlan(const Node& document, Reporter& reporter);

    [[nodiscard]] const std::vector<SweptKey>& keys() const { return keys_; }
    [[nodiscard]] std::size_t points() const { return points_; }
    /// Whether every value of a key is combined with those of the others, or else the first values
    /// of all keys are a point, and so on. A single key is a product.
    [[nodiscard]] bool is_product() const { return !is_zip_ || keys_.size() < 2; }
    /// Which of its values a key has at a point. Of a product the last key varies fastest.
    [[nodiscard]] std::size_t value_at(std::size_t key, std::size_t point) const;
    /// What a point sets.
    [[nodiscard]] std::vector<SweptValue> values_at(std::size_t point) const;
    /// Whether no key is of organs, ground or cell: all points have the same triangles.
    [[nodiscard]] bool keeps_geometry() const;
    /// The document of a point: with its values, and without [sweep]. Reports keys that there are
    /// not.
    [[nodiscard]] Node document_at(
        const Node& document, std::size_t point, Reporter& reporter) const;

  private:
    void read_keys(const Node& table, const std::string& prefix, Reporter& reporter);
    void read_combination(const Member& member, Reporter& reporter);
    void check_keys(Reporter& reporter) const;
    void count_points(const Node& table, std::size_t given, Reporter& reporter);

    std::vector<SweptKey> keys_;
    std::size_t points_ = 1;
    bool is_zip_ = false;
};

/// A value as TOML: 0.1, [0.1, 0.4], "sobol".
[[nodiscard]] std::string node_text(const Node& node);

}  // namespace quasimc
