#pragma once

#include <array>
#include <vector>

#include "picture/camera.h"
#include "picture/image.h"
#include "picture/render.h"
#include "quasimc/scene.h"
#include "quasimc/source.h"

namespace quasimc {

/// Red, green and blue light, linear.
using LinearRgb = std::array<double, 3>;

/// Contribution of each band to red, green and blue: by the part of the band in 600 to 700, 500 to
/// 600 and 400 to 500 nm, per nm. A colour without any band is the mean of the others. Empty if no
/// band is visible, or none has known wavelengths there.
[[nodiscard]] std::vector<LinearRgb> colors_of_bands(const std::vector<Band>& bands);

/// A scene in the light of its sources.
struct TrueLightSpec {
    std::size_t width = 1, height = 1;
    const Sources* sources = nullptr;
    std::vector<LinearRgb> bands;  ///< from colors_of_bands(), not empty
    /// Colours by which the light of organs is multiplied, by organ; empty: none.
    std::vector<LinearRgb> tints = {};
    /// Scattered light on both sides of an organ, per area: [organ * bands + band].
    std::vector<double> scattered;
    std::vector<CutPlane> cuts = {};
    Rgb background{255, 255, 255};
    unsigned threads = 0;  ///< 0: all available; does not change the picture
};

/// A realistic picture: direct light by shadow rays, and light from other surfaces as the mean over
/// each organ. Surfaces are Lambertian. White is a white surface facing all light
/// (docs/guide/pictures.md).
[[nodiscard]] Image render_true_light(
    const Scene& scene, const Camera& camera, const TrueLightSpec& spec);

}  // namespace quasimc
