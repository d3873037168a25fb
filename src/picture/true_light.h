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

/// How much of the light of each band is red, green and blue: by the part of the band that lies at
/// 600 to 700, 500 to 600 and 400 to 500 nm, per nm. A colour that no band reaches is the mean of
/// those that some reach. Empty if no band is visible: if none has known wavelengths there.
[[nodiscard]] std::vector<LinearRgb> colors_of_bands(const std::vector<Band>& bands);

/// A scene in the light of its sources.
struct TrueLightSpec {
    std::size_t width = 1, height = 1;
    const Sources* sources = nullptr;
    std::vector<LinearRgb> bands;  ///< of colors_of_bands(), not empty
    /// Scattered light that falls on both sides of an organ, per area: [organ * bands + band].
    std::vector<double> scattered;
    std::vector<CutPlane> cuts = {};
    Rgb background{255, 255, 255};
    unsigned threads = 0;  ///< 0: as many as there are; never changes a pixel
};

/// What an eye would see: light straight from the sources, by shadow rays, and light of other
/// surfaces as the mean over each organ. Surfaces are matt. White is what a white surface would
/// send back that faces all light (docs/guide/pictures.md).
[[nodiscard]] Image render_true_light(
    const Scene& scene, const Camera& camera, const TrueLightSpec& spec);

}  // namespace quasimc
