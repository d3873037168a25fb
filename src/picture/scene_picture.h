#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture/legend.h"
#include "picture/render.h"
#include "picture/true_light.h"

namespace quasimc {

/// A picture of a scene with annotations.
struct ScenePicture {
    std::string title, subtitle;
    ViewSpec view;
    Bounds framed = {};  ///< box that the camera frames; empty: the shown part of the scene
    RenderSpec render;   ///< size and background are set here
    std::optional<TrueLightSpec>
        true_light;  ///< instead of colours; size, cuts and threads are set
    Legend legend;
    std::vector<Vec3> to_suns;    ///< unit, z up; drawn if there are few
    bool has_annotations = true;  ///< title, legend, scale bar, directions
    bool is_transparent = false;  ///< without a background
    std::size_t width = 1200, height = 900;
};

/// The bytes of a PNG file. Needs has_png().
/// @throws InputError  if cuts leave nothing of the scene
[[nodiscard]] std::string draw_scene(const Scene& scene, const ScenePicture& picture);

}  // namespace quasimc
