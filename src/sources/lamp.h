#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "sources/pattern.h"
#include "sources/source.h"

namespace quasimc {

/// The surface that a lamp's light comes from. Lengths in the scene's unit.
struct Opening {
    enum class Kind {
        point,
        line,       ///< along the lamp's z axis
        rectangle,  ///< across the z axis; `length` along x, `width` along y
        disk,       ///< across the z axis
        sphere      ///< the pattern is about the normal of each place of its surface
    };
    Kind kind = Kind::point;
    double length = 0, width = 0;  ///< of a line (length), or a rectangle
    double radius = 0;             ///< of a disk or a sphere
};

/// Where a lamp stands and how it shines. World coordinates, z up.
struct LampSpec {
    std::string name;
    Vec3 position;                                  ///< of the opening's center
    Frame axes{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};  ///< x, y, z of the lamp; it aims along z
    Opening opening;
    Pattern pattern = isotropic_pattern();  ///< every place of the opening shines alike
    std::vector<double> flux;               ///< per band, irradiance unit x square scene unit
};

/// A lamp. It is light and no body: it casts no shadow, and light passes through it. In a periodic
/// scene it repeats with the cell (and is then traced from the sources only).
///
/// Light tracing sends paths either by the lamp's pattern or into the cone that the scene's
/// bounding sphere fills, whichever wastes less; flux() of its sampler is the light that goes
/// there.
[[nodiscard]] std::shared_ptr<const Source> make_lamp(LampSpec spec);

/// The right-handed frame that aims along `aim` (not zero) with its x axis towards `along`, as far
/// as that is across `aim`; any if `along` is parallel to it.
[[nodiscard]] Frame lamp_axes(const Vec3& aim, const Vec3& along);

}  // namespace quasimc
