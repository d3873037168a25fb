#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "crops.h"
#include "quasimc/source.h"

namespace quasimc::bench {
namespace {

/// Lamps in a row above the aisles, together as bright as the sun at 30 degrees.
Sources lamps_of_greenhouse() {
    constexpr int kLamps = 4;
    Sources lamps;
    for (int i = 0; i < kLamps; ++i) {
        const int row = i / 2;
        LampSpec lamp;
        lamp.name = "lamp " + std::to_string(i + 1);
        lamp.position = {.4 + 1.6 * (i % 2), .5 + 2. * row, 2.6};
        lamp.opening = {.kind = Opening::Kind::rectangle, .length = .3, .width = .2};
        lamp.pattern = cosine_pattern();
        lamp.flux = {400, 100};
        lamps.push_back(make_lamp(std::move(lamp)));
    }
    return lamps;
}

}  // namespace

std::vector<CropLight> suns_and_sky() {
    std::vector<CropLight> lights;
    for (const char* elevation_deg : {"90", "30", "5", "1", ".1", ".02"}) {
        const double angle = std::stod(elevation_deg) * std::numbers::pi / 180;
        // Not along the rows.
        const Vec3 travel{.6 * std::cos(angle), .8 * std::cos(angle), -std::sin(angle)};
        lights.push_back(
            {std::string("sun at ") + elevation_deg,
             {make_directional_source("sun", normalized(travel), {1, .8})}});
    }
    lights.push_back({"sky", {make_uniform_sky("sky", {.5, .3})}});
    return lights;
}

std::vector<CropLight> lights_of(Crop crop) {
    std::vector<CropLight> lights = suns_and_sky();
    if (crop == Crop::greenhouse) {
        const Sources lamps = lamps_of_greenhouse();
        Sources both = lamps;
        both.push_back(make_directional_source("sun", {.8660254037844386, 0, -.5}, {100, 80}));
        lights.push_back({"lamps", lamps});
        lights.push_back({"lamps and sun", both});
    }
    return lights;
}

}  // namespace quasimc::bench
