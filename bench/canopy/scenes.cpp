#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

#include "scene/scene.h"

namespace quasimc::bench {
namespace {

constexpr double kSide = 10;
constexpr double kLeafAreaIndex = 2.5;

Triangle random_leaf(double radius, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform;
    const Vec3 center{kSide * uniform(random), kSide * uniform(random), kSide * uniform(random)};
    const double z = 2 * uniform(random) - 1;
    const double around = 2 * std::numbers::pi * uniform(random);
    const double flat = std::sqrt(1 - z * z);
    const Frame frame = frame_about({flat * std::cos(around), flat * std::sin(around), z});
    const double turn = 2 * std::numbers::pi * uniform(random);
    Triangle leaf;
    for (std::size_t i = 0; i < 3; ++i) {
        const double angle = turn + 2 * std::numbers::pi * static_cast<double>(i) / 3;
        leaf[i] = center + radius * (std::cos(angle) * frame.s + std::sin(angle) * frame.t);
    }
    return leaf;
}

/// Transparent sensors along a diagonal of the cube.
void add_sensors(const Canopy& canopy, double side, SceneBuilder& builder) {
    MaterialSpec glass{.name = "sensor", .upper = {}, .lower = {}};
    SideOptics through;
    through.transmittance = 1;
    through.transmission_model = "mirror";
    glass.upper.assign(canopy.albedos.size(), through);
    glass.lower = glass.upper;
    builder.add_material(glass);
    for (std::uint32_t i = 0; i < canopy.sensors; ++i) {
        const double at = kSide * (i + 0.5) / canopy.sensors;
        OrganSpec organ;
        organ.parts.push_back(
            {"sensor", {{Vec3{at, at, at}, Vec3{at + side, at, at}, Vec3{at, at + side, at}}}});
        builder.add_organ(std::move(organ));
    }
}

}  // namespace

Scene make_canopy(const Canopy& canopy) {
    std::vector<Band> bands;
    MaterialSpec leaf{.name = "leaf", .upper = {}, .lower = {}};
    for (const double albedo : canopy.albedos) {
        bands.push_back({"band" + std::to_string(bands.size()), "W m-2"});
        SideOptics side;
        side.reflectance = side.transmittance = albedo / 2;
        if (canopy.phong_exponent > 0) {
            const bool is_mirror = std::isinf(canopy.phong_exponent);
            side.reflection_model = is_mirror ? "mirror" : "phong";
            side.reflection_parameters["exponent"] = is_mirror ? 0 : canopy.phong_exponent;
        }
        leaf.upper.push_back(side);
        leaf.lower.push_back(side);
    }
    SceneBuilder builder(bands);
    builder.add_material(leaf);
    // An equilateral triangle of circumradius r has the area 3 sqrt(3) / 4 r^2.
    const double radius =
        std::sqrt(kLeafAreaIndex * kSide * kSide / canopy.leaves / (3 * std::numbers::sqrt3 / 4));
    std::mt19937_64 random(canopy.seed);
    for (std::uint32_t i = 0; i < canopy.leaves; ++i) {
        OrganSpec organ;
        organ.parts.push_back({"leaf", {random_leaf(radius, random)}});
        organ.measured = canopy.sensors == 0 && (canopy.measured == 0 || i < canopy.measured);
        builder.add_organ(std::move(organ));
    }
    if (canopy.sensors > 0) {
        add_sensors(canopy, radius / 10, builder);
    }
    if (canopy.is_repeated) {
        builder.set_cell({.along_x = true, .along_y = true, .size_x = kSide, .size_y = kSide});
    }
    return std::move(builder).build();
}

Sources make_light(Light light, std::size_t bands) {
    std::vector<double> irradiance(bands, 1);
    if (light == Light::sun) {
        return {make_directional_source("sun", {0, 0, -1}, irradiance)};
    }
    if (light == Light::overcast) {
        return {make_sky("overcast", cie_overcast_shape(), irradiance)};
    }
    return {make_uniform_sky("sky", irradiance)};
}

double mean_variance(const Result& result) {
    double sum = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        const Estimate& density = result.at(i, Quantity::absorbed_flux_density, 0);
        if (density.mean > 0) {
            sum += density.standard_error * density.standard_error * result.replicates;
        }
    }
    return sum / static_cast<double>(result.organs());
}

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace quasimc::bench
