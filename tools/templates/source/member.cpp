// @Words@: where its light comes from.
//
// What     Radiance sin^p(elevation) from above the horizon.
// Paper    Author (year), journal.
// Theory   docs/theory/@page@.md
//
// A source that is no sky is a class derived from Source (source.h): see lamp.cpp.

#include <cmath>
#include <memory>

#include "sources/catalogue.h"
#include "sources/sky.h"

namespace quasimc {

/// The kind `@name@` of the catalogue.
std::shared_ptr<const Source> make_@name@(const StatedSource& stated) {
    const double power = stated.numbers.at("power_of_sine");
    const SkyShape shape{
        .radiance = [power](const Vec3& to_light) { return std::pow(to_light.z, power); },
        .azimuths = {},
        .sines = {}};
    return make_sky(stated.name, shape, stated.spectrum);
}

}  // namespace quasimc
