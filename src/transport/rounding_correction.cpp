#include "transport/rounding_correction.h"

#include <algorithm>

namespace quasimc {
namespace {

/// The smallest relative change of light that is corrected.
constexpr double kMinCorrected = 1e-4;

/// The cosine above which light is not corrected.
double grazing_cosine(const LocalMesh& mesh) {
    constexpr double kGrazing = 0.1;
    return mesh.instances.empty() ? std::min(kGrazing, mesh.most_turned / kMinCorrected) : kGrazing;
}

}  // namespace

RoundingCorrection::RoundingCorrection(const Scene& scene, const RayCaster& caster)
    : scene_(&scene),
      caster_(&caster),
      mesh_(&caster.mesh()),
      grazing_(grazing_cosine(caster.mesh())) {}

double RoundingCorrection::grazed_share(std::uint32_t mesh_triangle, const Vec3& direction) const {
    const double scale = mesh_->scale;
    const double exact = scale * scale * std::abs(dot(given_across(mesh_triangle), direction));
    const double rounded = std::abs(dot(mesh_->across(mesh_triangle), direction));
    return rounded > 0 && std::abs(exact - rounded) > kMinCorrected * rounded ? exact / rounded : 1;
}

bool RoundingCorrection::lights_as_given(std::uint32_t mesh_triangle, const Vec3& direction) const {
    const Vec3 across = given_across(mesh_triangle);
    return std::abs(dot(across, direction)) > kEdgeOn * length(across);
}

/// The normal of the given triangle, with twice its area as length.
Vec3 RoundingCorrection::given_across(std::uint32_t mesh_triangle) const {
    return area_vector(data_of(*scene_).triangles()[caster_->source(mesh_triangle)]);
}

}  // namespace quasimc
