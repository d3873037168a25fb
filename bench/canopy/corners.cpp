// Coverage of 95 % intervals in hard cases: few contributions, narrow views, lobes and lamps, by
// every method, at default settings. Each truth is a closed form.

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "methods.h"
#include "parts.h"
#include "quasimc/run.h"
#include "scene/scene.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr double kPi = std::numbers::pi;

/// One known value of the first organ.
struct Corner {
    std::string name;
    Scene scene;
    Sources sources;
    Quantity quantity = Quantity::incident_upper;
    double truth = 0;
};

MaterialSpec diffuse(const std::string& name, double rho) {
    const std::vector<SideOptics> side(1, {.reflectance = rho});
    return {name, side, side};
}

MaterialSpec shiny(
    const std::string& name, const std::string& model, const BsdfParameters& parameters) {
    const std::vector<SideOptics> side(
        1, {.reflectance = .5, .reflection_model = model, .reflection_parameters = parameters});
    return {name, side, side};
}

MaterialSpec sensor() {
    const std::vector<SideOptics> side(1, {.transmittance = 1, .transmission_model = "mirror"});
    return {"sensor", side, side};
}

std::vector<Triangle> plate(double x0, double x1, double y0, double y1, double z) {
    return make_parallelogram({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0});
}

SceneBuilder builder_of(std::vector<MaterialSpec> materials) {
    SceneBuilder builder({{"b0"}});
    for (MaterialSpec& material : materials) {
        builder.add_material(std::move(material));
    }
    return builder;
}

void add(SceneBuilder& builder, const std::string& material, std::vector<Triangle> triangles) {
    OrganSpec organ;
    organ.parts.push_back({material, std::move(triangles)});
    builder.add_organ(std::move(organ));
}

Sources sun_at(double zenith_deg) {
    const double zenith = zenith_deg * kPi / 180;
    return {make_directional_source("sun", {std::sin(zenith), 0, -std::cos(zenith)}, {1})};
}

Sources uniform_sky() {
    return {make_uniform_sky("sky", {1})};
}

/// A leaf below a roof with a slit of a thousandth of its width.
Corner deep_shade() {
    SceneBuilder builder = builder_of({diffuse("black", 0)});
    add(builder, "black", plate(0, 1, 0, 1, 0));
    add(builder, "black", plate(-.5, .4, -.5, 1.5, .1));
    add(builder, "black", plate(.401, 1.5, -.5, 1.5, .1));
    return {"deep shade", std::move(builder).build(), sun_at(0), Quantity::incident_upper, 1e-3};
}

/// The view factor of two equal parallel squares of side 1 at distance `height` (Howell, Menguc and
/// Siegel, C-11).
double opening_seen(double height) {
    const double x = 1 / height;
    const double root = std::sqrt(1 + x * x);
    return 2 / (kPi * x * x) *
           (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) + 2 * x * root * std::atan(x / root) -
            2 * x * std::atan(x));
}

Corner tube() {
    constexpr double kHeight = 5;
    SceneBuilder builder = builder_of({diffuse("black", 0)});
    add(builder, "black", plate(0, 1, 0, 1, 0));
    const std::array<Vec3, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    std::vector<Triangle> walls;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 side = corners[(i + 1) % corners.size()] - corners[i];
        for (const Triangle& t : make_parallelogram(corners[i], side, {0, 0, kHeight})) {
            walls.push_back(t);
        }
    }
    add(builder, "black", walls);
    return {
        "tube under a sky", std::move(builder).build(), uniform_sky(), Quantity::incident_upper,
        opening_seen(kHeight)};
}

/// A sensor of half-angle 25 degrees above leaves.
Corner narrow_sensor() {
    constexpr double kHalfView = 25;
    SceneBuilder builder = builder_of({sensor(), diffuse("black", 0)});
    OrganSpec eye;
    eye.parts.push_back({"sensor", plate(.2, .8, .2, .8, 1.1)});
    eye.field_of_view_deg = kHalfView;
    builder.add_organ(std::move(eye));
    for (int i = 0; i < 100; ++i) {
        const double x = .1 * (i % 10), y = .1 * (i / 10);
        add(builder, "black", plate(x, x + .08, y, y + .08, .01 * (i % 7)));
    }
    return {
        "narrow sensor", std::move(builder).build(), uniform_sky(), Quantity::incident_upper,
        std::pow(std::sin(kHalfView * kPi / 180), 2)};
}

/// A small sensor above infinite ground that reflects half of the sun's light.
Corner above_ground(const std::string& name, const MaterialSpec& ground, double zenith_deg) {
    SceneBuilder builder = builder_of({sensor(), ground});
    add(builder, "sensor", plate(.4, .43, .4, .43, .3));
    GroundSpec below;
    below.material = ground.name;
    builder.set_ground(std::move(below));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    return {
        name, std::move(builder).build(), sun_at(zenith_deg), Quantity::incident_lower,
        .5 * std::cos(zenith_deg * kPi / 180)};
}

/// A lamp above a leaf at a tenth of its width: the solid angle of a square from above its centre.
Corner close_lamp() {
    constexpr double kHalf = .05, kHeight = .01;
    SceneBuilder builder = builder_of({diffuse("black", 0)});
    add(builder, "black", plate(-kHalf, kHalf, -kHalf, kHalf, 0));
    add(builder, "black", plate(-1, 1, -1, 1, -1));
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = {0, 0, kHeight};
    lamp.flux = {1};
    const double square = kHalf * kHalf;
    const double solid_angle = 4 * std::asin(square / (square + kHeight * kHeight));
    return {
        "close lamp",
        std::move(builder).build(),
        {make_lamp(std::move(lamp))},
        Quantity::incident_upper,
        solid_angle / (4 * kPi) / (4 * square)};
}

Corner needle() {
    constexpr double kZenith = 20, kWidth = 1e-6;
    SceneBuilder builder = builder_of({diffuse("black", 0)});
    add(builder, "black", plate(.3, .6, .4, .4 + kWidth, .2));
    add(builder, "black", plate(0, 1, 0, 1, 0));
    return {
        "needle of 1e-6", std::move(builder).build(), sun_at(kZenith), Quantity::incident_upper,
        std::cos(kZenith * kPi / 180)};
}

/// Fraction of the runs' intervals that contain the truth, and mean half-width relative to it.
struct Coverage {
    double part = 0, width = 0;
};

Coverage coverage_of(const Corner& corner, Method method, std::uint32_t runs) {
    constexpr double kRounding = 5e-6;  // of corners, to single precision
    RunSpec spec;
    spec.method = method;
    Coverage coverage;
    for (std::uint32_t seed = 1; seed <= runs; ++seed) {
        spec.seed = seed;
        const Estimate e = run(corner.scene, corner.sources, spec).at(0, corner.quantity, 0);
        const double slack = kRounding * corner.truth;
        coverage.part +=
            e.ci95_low - slack <= corner.truth && corner.truth <= e.ci95_high + slack ? 1 : 0;
        coverage.width += (e.ci95_high - e.ci95_low) / 2 / corner.truth;
    }
    return {coverage.part / runs, coverage.width / runs};
}

}  // namespace

void print_corners(const Effort& effort) {
    std::printf(
        "\n== Corners: %% of the 95 %% intervals of %u runs at default settings that contain the "
        "truth (half their width, %% of it)\n  %-22s%-18s%-18s%-18s%-18s\n",
        effort.corner_runs, "", "light_tracing", "first_hits", "from_organs", "ray_bundles");
    const std::vector<Corner> corners{
        deep_shade(),
        tube(),
        narrow_sensor(),
        above_ground("few hits", diffuse("soil", .5), 0),
        above_ground("mirror", shiny("water", "mirror", {}), 30),
        above_ground("Phong, exponent 1000", shiny("wax", "phong", {{"exponent", 1000}}), 0),
        close_lamp(),
        needle()};
    for (const Corner& corner : corners) {
        std::printf("  %-22s", corner.name.c_str());
        for (const Method method : kMethods) {
            if (!can_run(method, corner.scene)) {
                std::printf("%-18s", "not Lambertian");
                continue;
            }
            const Coverage coverage = coverage_of(corner, method, effort.corner_runs);
            const std::string cell =
                fmt::format("{:.1f} ({:.2g})", 100 * coverage.part, 100 * coverage.width);
            std::printf("%-18s", cell.c_str());
        }
        std::printf("\n");
    }
}

}  // namespace quasimc::bench
