#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "meshio/formats.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Geometry files that are parsed already, for points of a sweep that name the same: those of the
/// point that is read and of the one before.
class MeshCache {
  public:
    struct Parsed {
        MeshFile mesh;
        std::vector<Warning> warnings;
    };
    /// All that the result of reading depends on: the path as it is written, its format, and what
    /// FormatContext says of the scene.
    using Key = std::tuple<std::string, std::string, UpAxis, std::string, std::optional<double>>;

    /// Drops what the last point did not use.
    void start_point() {
        before_ = std::move(now_);
        now_.clear();
    }
    /// Null if neither point has used it.
    [[nodiscard]] std::shared_ptr<const Parsed> find(const Key& key) {
        if (const auto known = before_.find(key); known != before_.end()) {
            now_.insert(before_.extract(known));
        }
        const auto known = now_.find(key);
        return known == now_.end() ? nullptr : known->second;
    }
    void add(const Key& key, std::shared_ptr<const Parsed> parsed) {
        now_[key] = std::move(parsed);
    }

  private:
    std::map<Key, std::shared_ptr<const Parsed>> before_, now_;
};

}  // namespace quasimc
