#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "text/table_reader.h"

namespace quasimc {

/// The numbers of a plant's line.
struct OpsNumbers {
    Vec3 position;  ///< metres
    double scale = 1;
    /// Azimuth and angle of the inclination, twist about the stem; radians.
    double azimuth = 0, angle = 0, twist = 0;
};

/// The transform of a plant: twist, scale, inclination towards the azimuth and shift, as in
/// PlantGeom.jl. @param unit  scene units per unit of positions; @param size  per unit of the plant
[[nodiscard]] Affine ops_transform(const OpsNumbers& numbers, double unit, double size);

/// The fields of a line, between tabs if there are any: names of files may hold blanks.
[[nodiscard]] std::vector<std::string_view> ops_fields(std::string_view line);

/// Columns of a table of plants.
class OpsColumns {
  public:
    /// Reads from the comment with the names of columns whether one is the scale.
    void read_comment(std::string_view line);
    /// The numbers of a line; empty after a fault. Lines of the old layout have no scale, and may
    /// end with an unused field. A line with scale 0 has the old layout, unless a comment names a
    /// column of scales.
    std::optional<OpsNumbers> numbers_of(
        const std::vector<std::string_view>& fields, std::uint32_t line, Reporter& reporter);
    /// Warns of assumptions.
    void warn(Reporter& reporter) const;

  private:
    /// Number of lines of a kind, and the first one.
    struct Notes {
        std::size_t count = 0;
        std::uint32_t first = 0;

        void add(std::uint32_t line) { first = count++ == 0 ? line : first; }
        void warn(std::string_view text, Reporter& reporter) const;
    };

    OpsNumbers arrange(const std::vector<double>& numbers, std::uint32_t line);

    std::optional<bool> has_scale_;  // from the comment
    Notes old_, unscaled_, turned_;
};

}  // namespace quasimc
