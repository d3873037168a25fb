#pragma once

#include <string>
#include <vector>

#include "io/results/json.h"
#include "sources/source.h"

namespace quasimc {

/// Where the light of a time comes from, for the page in the browser. World, z up.
struct WindowLights {
    std::vector<Vec3> suns;   ///< unit vectors towards them, and towards other parallel light
    std::vector<Vec3> lamps;  ///< their places
    /// The radiance of the sky, all bands together, in cells of 10 degrees: nine rings from the
    /// horizon up, each of 36 cells from the x axis towards y. A digit of base64 each: 63 parts of
    /// the square root of the brightest. Empty without a sky.
    std::string sky;
};

[[nodiscard]] WindowLights window_lights(const Sources& sources);

/// Members "suns", "lamps" and "sky" of an object. @param middle  about which places are told
[[nodiscard]] Json json_lights(const WindowLights& lights, const Vec3& middle);

}  // namespace quasimc
