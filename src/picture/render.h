#pragma once

#include <vector>

#include "picture/camera.h"
#include "picture/camera_ray_caster.h"
#include "picture/image.h"
#include "quasimc/scene.h"

namespace quasimc {

/// How a scene is drawn.
struct RenderSpec {
    std::size_t width = 1, height = 1;
    std::vector<Rgb> colors;  ///< of each organ
    /// How much darker a surface is that is seen edge-on: 0 not at all, 1 black.
    double shading = 0.25;
    std::vector<CutPlane> cuts = {};
    Rgb background{255, 255, 255};
    unsigned threads = 0;  ///< 0: as many as there are; never changes a pixel
};

/// The part of a scene's bounds that cuts leave; empty if they leave none.
[[nodiscard]] Bounds shown_bounds(const Scene& scene, const std::vector<CutPlane>& cuts);

/// A scene, ray-traced: one line of sight through the middle of a pixel, and four more where its
/// neighbours show something else. Of a periodic scene one cell is shown.
[[nodiscard]] Image render(const Scene& scene, const Camera& camera, const RenderSpec& spec);

}  // namespace quasimc
