#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/meshes/formats.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Geometry files that are parsed already, for points of a sweep that name the same.
class MeshCache {
  public:
    struct Parsed {
        MeshFile mesh;
        std::vector<Warning> warnings;
    };
    /// All that the result of reading depends on: the path as it is written, its format, and what
    /// FormatContext says of the scene.
    using Key = std::tuple<std::string, std::string, UpAxis, std::string, std::optional<double>>;

    /// Null if it was not added.
    [[nodiscard]] const Parsed* find(const Key& key) const {
        const auto known = parsed_.find(key);
        return known == parsed_.end() ? nullptr : &known->second;
    }
    void add(const Key& key, Parsed parsed) { parsed_[key] = std::move(parsed); }

  private:
    std::map<Key, Parsed> parsed_;
};

}  // namespace quasimc
