#include "solvers/direct/projection_input.h"

namespace quasimc {
namespace {

/// By triangle; none if all are opaque.
std::vector<VisibilityRole> roles_in(const PreparedScene& prepared) {
    const RayCaster& caster = prepared.caster();
    const std::uint32_t triangles = caster.mesh().triangle_count();
    const bool repeats = prepared.scene().cell().periodic();
    std::vector<VisibilityRole> roles;
    for (std::uint32_t i = 0; (prepared.optics().has_transparent || repeats) && i < triangles;
         ++i) {
        const bool image = repeats && i > 0 && caster.source(i) == caster.source(i - 1);
        const bool sensor = prepared.material(prepared.region(i)).is_transparent();
        roles.push_back(
            image ? VisibilityRole::omitted
                  : (sensor ? VisibilityRole::sensor : VisibilityRole::opaque));
    }
    return roles;
}

}  // namespace

ProjectionInput::ProjectionInput(const PreparedScene& prepared, const std::stop_token* stop)
    : roles_(roles_in(prepared)),
      projected_{
          &prepared.caster().mesh(), prepared.projection().cell(), roles_,
          prepared.projection().outline(), stop} {}

void ProjectionInput::store_blocks() {
    blocks_ = stored_blocks(projected_);
    projected_.blocks = blocks_;
}

}  // namespace quasimc
