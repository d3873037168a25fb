#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"
#include "scene/scene.h"

// The checks of lint(). To add a warning, write a function like these and call it in
// lint_by_check().

namespace quasimc {

/// The warnings of one check.
struct LintFinding {
    std::string_view check;  ///< its name: "overlap"
    std::vector<Warning> warnings;
};
/// The warnings of lint() by check, without checks that have none.
[[nodiscard]] std::vector<LintFinding> lint_by_check(const Scene& scene);

/// The warnings of lint() except for black materials, whose zeros are given or were reported by a
/// reader.
[[nodiscard]] std::vector<Warning> lint_geometry(const Scene& scene);

/// A scene and the bounds of each of its organs.
struct Survey {
    const Scene& scene;
    std::vector<Bounds> organ_bounds;
    Bounds canopy;  ///< bounds of all organs but the ground; empty if there is only ground
};

[[nodiscard]] Survey survey_of(const Scene& scene);
/// The median diagonal of the organs, the ground left out; 0 if there are none.
[[nodiscard]] double median_size(const Survey& survey);
/// The ground of a scene, or null.
[[nodiscard]] const Organ* ground_of(const Scene& scene);

/// "organ 'leaf 7' (id 7)"
[[nodiscard]] std::string describe_organ(const Organ& organ);

/// Size of an organ relative to the scene.
[[nodiscard]] double part_of_scene(const Survey& survey, std::size_t organ);
/// Smallest relative size for single precision, which moves the corners of such an organ by 1 % of
/// its size.
inline constexpr double kSmallestPart = 5e-6;

/// Collects items with the same warning; names the first few and counts the others.
class WarningKind {
  public:
    /// @param one, many  singular and plural text for the items without names
    WarningKind(std::string_view one, std::string_view many) : one_(one), many_(many) {}
    void add(std::string where, std::string text);
    [[nodiscard]] std::vector<Warning> finish() &&;

  private:
    static constexpr std::size_t kMaxNamed = 3;

    std::string_view one_, many_;
    std::vector<Warning> named_;
    std::size_t count_ = 0;
};

/// Warns of sizes that suggest a wrong unit.
[[nodiscard]] std::vector<Warning> lint_unit(const Survey& survey);
/// Warns of organs too small for single precision relative to the scene.
[[nodiscard]] std::vector<Warning> lint_sizes(const Survey& survey);
/// Warns of materials that scatter no light.
[[nodiscard]] std::vector<Warning> lint_materials(const Survey& survey);
/// Warns of triangles and organs of zero area.
[[nodiscard]] std::vector<Warning> lint_areas(const Survey& survey);
/// Warns of organs so thin relative to the scene that single precision changes their shape.
[[nodiscard]] std::vector<Warning> lint_thin(const Survey& survey);
/// Warns of periodic cells that are small relative to the organs.
[[nodiscard]] std::vector<Warning> lint_cell(const Survey& survey);
/// Warns of a ground smaller than the canopy, and of organs below a horizontal ground.
[[nodiscard]] std::vector<Warning> lint_ground(const Survey& survey);
/// Warns of coplanar triangles that overlap.
[[nodiscard]] std::vector<Warning> lint_overlap(const Survey& survey);

/// Warns of sensors inside closed opaque organs, where they receive no light. Scenes and organs
/// that would take long are not checked.
[[nodiscard]] std::vector<Warning> lint_sensors(const Survey& survey);

/// Whether the area of a triangle is zero within rounding.
[[nodiscard]] bool is_degenerate(const Triangle& triangle);

}  // namespace quasimc
