#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"
#include "scene/scene.h"

// What lint() is made of. To add a warning: write a function like these, and call it in
// lint_by_check().

namespace quasimc {

/// The warnings of one check.
struct LintFinding {
    std::string_view check;  ///< its name: "overlap"
    std::vector<Warning> warnings;
};
/// What lint() tells, check by check; without those that have found nothing.
[[nodiscard]] std::vector<LintFinding> lint_by_check(const Scene& scene);

/// What lint() finds but for black materials, where zeros are given or were reported when materials
/// were read.
[[nodiscard]] std::vector<Warning> lint_geometry(const Scene& scene);

/// A scene and the bounds of each of its organs.
struct Survey {
    const Scene& scene;
    std::vector<Bounds> organ_bounds;
    Bounds canopy;  ///< of all organs but the ground; empty if there is only ground
};

[[nodiscard]] Survey survey_of(const Scene& scene);
/// The median diagonal of the organs, the ground left out; 0 if there are none.
[[nodiscard]] double median_size(const Survey& survey);
/// The ground of a scene, or null.
[[nodiscard]] const Organ* ground_of(const Scene& scene);

/// "organ 'leaf 7' (id 7)"
[[nodiscard]] std::string words_for(const Organ& organ);

/// How large an organ is beside the whole scene.
[[nodiscard]] double part_of_scene(const Survey& survey, std::size_t organ);
/// Organs smaller than this are too small for single precision: it moves corners by 1 % of it.
inline constexpr double kSmallestPart = 5e-6;

/// Of many things that deserve the same warning only the first few are named, the rest is counted.
class WarningKind {
  public:
    /// @param one, many  what is said of one or several not named: "organs are below the ground"
    WarningKind(std::string_view one, std::string_view many) : one_(one), many_(many) {}
    void add(std::string where, std::string text);
    [[nodiscard]] std::vector<Warning> finish() &&;

  private:
    static constexpr std::size_t kMaxNamed = 3;

    std::string_view one_, many_;
    std::vector<Warning> named_;
    std::size_t count_ = 0;
};

/// Sizes that smell of a wrong unit.
[[nodiscard]] std::vector<Warning> lint_unit(const Survey& survey);
/// Organs too small beside the scene for single precision.
[[nodiscard]] std::vector<Warning> lint_sizes(const Survey& survey);
/// Materials that scatter nothing.
[[nodiscard]] std::vector<Warning> lint_materials(const Survey& survey);
/// Triangles and organs of no area.
[[nodiscard]] std::vector<Warning> lint_areas(const Survey& survey);
/// Organs so thin beside the scene that single precision changes their shape.
[[nodiscard]] std::vector<Warning> lint_thin(const Survey& survey);
/// Periodic cells that are small beside the organs.
[[nodiscard]] std::vector<Warning> lint_cell(const Survey& survey);
/// A ground that is smaller than the canopy; organs below a horizontal ground.
[[nodiscard]] std::vector<Warning> lint_ground(const Survey& survey);
/// Triangles that lie in one plane, one upon the other, or are the same.
[[nodiscard]] std::vector<Warning> lint_overlap(const Survey& survey);

/// Whether a triangle has no area but for rounding.
[[nodiscard]] bool is_degenerate(const Triangle& triangle);

}  // namespace quasimc
