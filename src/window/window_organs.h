#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "resultio/read_rows.h"
#include "scene/scene.h"

namespace quasimc {

/// Everything that the page lists with numbers: the organs of a scene, then the results of its
/// sensors.
class WindowOrgans {
  public:
    /// @param scene  must outlive this
    explicit WindowOrgans(const Scene& scene);
    explicit WindowOrgans(Scene&& scene) = delete;

    [[nodiscard]] const std::vector<const Organ*>& all() const { return all_; }
    [[nodiscard]] std::size_t sensors() const { return spheres_.size(); }
    /// Whether each sensor is a sphere.
    [[nodiscard]] const std::vector<bool>& spheres() const { return spheres_; }
    /// Whether the list is longer than that of the organs from an index on.
    [[nodiscard]] bool is_sensor(std::size_t index) const {
        return index >= all_.size() - sensors();
    }
    /// "17", "sensor 3": unique in the scene.
    [[nodiscard]] std::string id_of(std::size_t index) const;

  private:
    std::vector<bool> spheres_;     // by sensor
    std::optional<Scene> sensors_;  // their names and labels, as organs
    std::vector<const Organ*> all_;
};

/// The organs of each point of a sweep.
using OrgansOfPoints = std::function<const WindowOrgans&(std::size_t point)>;

/// Reads the numbers of organs and of sensors as those of one list, as long as that of the organs
/// of their point; NaN where the result has none. As read_rows().
Node read_window_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const OrgansOfPoints& organs,
    const std::function<void(PlacedRows)>& take);
/// The same of a single result, or point.
inline Node read_window_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const WindowOrgans& organs,
    const std::function<void(PlacedRows)>& take) {
    return read_window_rows(
        text, path, query, [&](std::size_t) -> const WindowOrgans& { return organs; }, take);
}

}  // namespace quasimc
