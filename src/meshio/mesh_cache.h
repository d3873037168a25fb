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

/// Parsed geometry files of the current and the previous point of a sweep.
class MeshCache {
  public:
    struct Parsed {
        MeshFile mesh;
        std::vector<Warning> warnings;
    };
    /// All inputs of a reader: the path as written, its format, and the scene's properties in
    /// FormatContext.
    using Key = std::tuple<std::string, std::string, UpAxis, std::string, std::optional<double>>;

    /// Drops the files that the last point did not use.
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
