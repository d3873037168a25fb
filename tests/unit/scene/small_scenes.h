#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace quasimc::test {

/// A material of one band.
[[nodiscard]] MaterialSpec lambertian(
    std::string name, double reflectance = 0.1, double transmittance = 0.05);

/// A builder with the band "PAR" and the materials "leaf" and "soil".
[[nodiscard]] SceneBuilder one_band_builder(const Orientation& orientation = {});

/// A right-angled triangle of legs 1, horizontal, upper side up, its corner at `p`.
[[nodiscard]] Triangle flat_triangle(const Vec3& p, double leg = 1);

/// An organ of one triangle and of material "leaf".
[[nodiscard]] OrganSpec one_triangle(std::string name, const Triangle& triangle);

/// An organ with an id, one flat triangle and a location for messages.
[[nodiscard]] OrganSpec with_id(std::int64_t id, std::string where);

/// The faults of building, each as it is printed; none if the scene is sound.
[[nodiscard]] std::vector<std::string> faults_of(SceneBuilder builder);

/// The warnings of a scene, each as "where: text".
[[nodiscard]] std::vector<std::string> warnings_of(SceneBuilder builder);

}  // namespace quasimc::test
