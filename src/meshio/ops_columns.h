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
    double azimuth = 0, angle = 0, twist = 0;  ///< of the inclination; about the stem; radians
};

/// Where a line puts its plant: turned by its twist, scaled, inclined towards the azimuth and
/// shifted, as PlantGeom.jl does it.
/// @param unit  of the scene, in one of the positions; @param size  in one of the plant
[[nodiscard]] Affine ops_transform(const OpsNumbers& numbers, double unit, double size);

/// The fields of a line, between tabs if there are any: names of files may hold blanks.
[[nodiscard]] std::vector<std::string_view> ops_fields(std::string_view line);

/// Knows which column of a table of plants is which.
class OpsColumns {
  public:
    /// The comment that names the columns tells whether one of them is the scale.
    void read_comment(std::string_view line);
    /// The numbers of a line; nothing after a fault. Lines of the old layout have no scale, and may
    /// end with a field that is not used. No plant has the scale 0: such a line is an old one,
    /// unless a comment names a column of scales.
    std::optional<OpsNumbers> numbers_of(
        const std::vector<std::string_view>& fields, std::uint32_t line, Reporter& reporter);
    /// Warns of what was assumed.
    void warn(Reporter& reporter) const;

  private:
    /// How many lines are of a kind, and the first.
    struct Notes {
        std::size_t count = 0;
        std::uint32_t first = 0;

        void add(std::uint32_t line) { first = count++ == 0 ? line : first; }
        void warn(std::string_view text, Reporter& reporter) const;
    };

    OpsNumbers arrange(const std::vector<double>& numbers, std::uint32_t line);

    std::optional<bool> has_scale_;  // what the comment says
    Notes old_, unscaled_, turned_;
};

}  // namespace quasimc
