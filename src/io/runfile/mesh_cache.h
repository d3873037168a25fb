#pragma once

#include <map>
#include <string>
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
    using Key = std::pair<std::string, std::string>;  ///< the file as stated, and its format

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
