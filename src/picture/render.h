#pragma once

#include <vector>

#include "picture/camera.h"
#include "picture/camera_ray_caster.h"
#include "picture/image.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Options of a drawing.
struct RenderSpec {
    std::size_t width = 1, height = 1;
    std::vector<Rgb> colors;  ///< by organ
    /// Darkening of a surface that is seen edge-on: 0 none, 1 black.
    double shading = 0.25;
    std::vector<CutPlane> cuts = {};
    Rgb background{255, 255, 255};
    unsigned threads = 0;  ///< 0: all available; does not change the picture
};

/// The bounds of a clipped scene; empty if nothing is left.
[[nodiscard]] Bounds shown_bounds(const Scene& scene, const std::vector<CutPlane>& cuts);

/// Ray-traces a scene: one camera ray through the centre of a pixel, and four more where its
/// neighbours show something else. A periodic scene is reduced to one cell.
[[nodiscard]] Image render(const Scene& scene, const Camera& camera, const RenderSpec& spec);

}  // namespace quasimc
