#include "stands.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "geometry/shapes/shapes.h"
#include "scene/scene.h"

namespace quasimc::bench {
namespace {

constexpr double kSide = 1;
constexpr double kLeafAreaIndex = 2;

/// Random numbers in [0, 1), equal with every standard library.
class Numbers {
  public:
    double operator()() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    Vec3 point() { return {kSide * (*this)(), kSide * (*this)(), kSide * (*this)()}; }
    /// A direction, uniform over the sphere.
    Vec3 direction() {
        const double z = between(-1, 1);
        const double around = between(0, 2 * std::numbers::pi);
        const double flat = std::sqrt(1 - z * z);
        return {flat * std::cos(around), flat * std::sin(around), z};
    }

  private:
    std::mt19937_64 random_{2024};
};

/// One side in PAR and in NIR.
std::vector<SideOptics> side(double par, double nir) {
    SideOptics dark;
    dark.reflectance = dark.transmittance = par / 2;
    SideOptics bright;
    bright.reflectance = bright.transmittance = nir / 2;
    return {dark, bright};
}

MaterialSpec leaf_of(std::string name) {
    return {.name = std::move(name), .upper = side(.15, .85), .lower = side(.2, .9)};
}

MaterialSpec shiny(std::string name, const std::string& model, double exponent) {
    MaterialSpec leaf = leaf_of(std::move(name));
    for (SideOptics& band : leaf.upper) {
        band.reflection_model = model;
        band.reflection_parameters["exponent"] = exponent;
    }
    return leaf;
}

MaterialSpec opaque(std::string name, double par, double nir) {
    SideOptics dark;
    dark.reflectance = par;
    SideOptics bright;
    bright.reflectance = nir;
    return {.name = std::move(name), .upper = {dark, bright}, .lower = {dark, bright}};
}

double leaf_area(std::uint32_t leaves) {
    return kLeafAreaIndex * kSide * kSide / leaves;
}

void add(SceneBuilder& builder, std::string material, const std::vector<Triangle>& triangles) {
    OrganSpec organ;
    organ.parts.push_back({std::move(material), triangles});
    builder.add_organ(std::move(organ));
}

/// Equilateral triangles uniformly distributed in the cube, with random orientation.
std::vector<Triangle> random_leaf(std::uint32_t leaves, Numbers& numbers) {
    const double radius = std::sqrt(leaf_area(leaves) / (3 * std::numbers::sqrt3 / 4));
    const Vec3 center = numbers.point();
    const Frame frame = frame_about(numbers.direction());
    Triangle leaf;
    for (std::size_t i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 3;
        leaf[i] = center + radius * (std::cos(angle) * frame.s + std::sin(angle) * frame.t);
    }
    return {leaf};
}

/// A stem of three internodes with leaves at golden angles.
void add_plant(SceneBuilder& builder, const Vec3& foot, std::uint32_t leaves, Numbers& numbers) {
    const double height = kSide * numbers.between(.6, .9);
    for (int i = 0; i < 3; ++i) {
        const Vec3 base = foot + Vec3{0, 0, height * i / 3};
        const double radius = .012 * (1 - .25 * i);
        add(builder, "stem",
            make_cylinder(base, {0, 0, height / 3}, radius, .75 * radius, 8, i == 2));
    }
    const double length = std::sqrt(leaf_area(9 * leaves) * 4);
    for (std::uint32_t i = 0; i < leaves; ++i) {
        const double around = 2.39996 * i;
        const double rise = numbers.between(-.3, .8);
        const Vec3 out = normalized(Vec3{std::cos(around), std::sin(around), rise});
        const Vec3 base = foot + Vec3{0, 0, height * (.15 + .85 * (i + 1) / leaves)};
        add(builder, "leaf", make_rhombus(base + .013 * out, length * out, {0, 0, 1}, length / 2));
    }
}

/// A strip that bends down and is cupped.
std::vector<Triangle> curved_leaf(std::uint32_t leaves, Numbers& numbers) {
    const double length = std::sqrt(leaf_area(leaves) * 3);
    const double width = length / 3;
    const Vec3 base = numbers.point();
    const double around = numbers.between(0, 2 * std::numbers::pi);
    const Vec3 out{std::cos(around), std::sin(around), 0};
    const Vec3 across{-out.y, out.x, 0};
    const double rise = numbers.between(.2, .6);
    BezierPatch patch;
    for (std::size_t i = 0; i < 4; ++i) {
        const double along = static_cast<double>(i) / 3;
        const double z = length * (rise * along - .9 * along * along * along);
        const double half = width * (i == 0 ? .2 : i == 3 ? .1 : .6);
        for (std::size_t j = 0; j < 4; ++j) {
            const double aside = 2 * static_cast<double>(j) / 3 - 1;
            patch[4 * i + j] = base + length * along * out + half * aside * across +
                               Vec3{0, 0, z + .3 * half * aside * aside};
        }
    }
    return make_bezier_surface(std::vector<BezierPatch>{patch}, {.tolerance = 1e-3});
}

void add_random_leaves(SceneBuilder& builder, std::uint32_t leaves) {
    Numbers numbers;
    for (std::uint32_t i = 0; i < leaves; ++i) {
        add(builder, "leaf", random_leaf(leaves, numbers));
    }
}

void add_plants(SceneBuilder& builder, std::uint32_t leaves) {
    Numbers numbers;
    builder.add_material(opaque("stem", .1, .5));
    for (int i = 0; i < 9; ++i) {
        const int column = i % 3;
        const int row = i / 3;
        const Vec3 foot{
            kSide * (column + numbers.between(.3, .7)) / 3,
            kSide * (row + numbers.between(.3, .7)) / 3, 0};
        add_plant(builder, foot, (leaves + 8) / 9, numbers);
    }
}

void add_shiny_leaves(SceneBuilder& builder, std::uint32_t leaves) {
    Numbers numbers;
    builder.add_material(shiny("phong", "phong", 12));
    builder.add_material(shiny("blinn", "blinn_phong", 40));
    builder.add_material(shiny("wet", "mirror", 0));
    for (std::uint32_t i = 0; i < leaves; ++i) {
        const char* material = i % 10 == 0 ? "wet" : i % 2 == 0 ? "phong" : "blinn";
        add(builder, material, random_leaf(leaves, numbers));
    }
}

}  // namespace

std::string name_of(StandKind kind) {
    switch (kind) {
        case StandKind::clumped_plants:
            return "clumped plants with stems";
        case StandKind::curved_leaves:
            return "curved leaves";
        case StandKind::shiny_leaves:
            return "shiny leaves";
        case StandKind::over_ground:
            return "leaves over ground";
        case StandKind::random_leaves:
            break;
    }
    return "random leaves";
}

Scene make_stand(StandKind kind, std::uint32_t leaves) {
    SceneBuilder builder({{"PAR", "W m-2"}, {"NIR", "W m-2"}});
    builder.add_material(leaf_of("leaf"));
    Numbers numbers;
    switch (kind) {
        case StandKind::clumped_plants:
            add_plants(builder, leaves);
            break;
        case StandKind::curved_leaves:
            for (std::uint32_t i = 0; i < leaves; ++i) {
                add(builder, "leaf", curved_leaf(leaves, numbers));
            }
            break;
        case StandKind::shiny_leaves:
            add_shiny_leaves(builder, leaves);
            break;
        case StandKind::over_ground:
            builder.add_material(opaque("soil", .1, .25));
            builder.set_ground({.material = "soil", .height = -.2});
            [[fallthrough]];
        case StandKind::random_leaves:
            add_random_leaves(builder, leaves);
            break;
    }
    return std::move(builder).build();
}

Sources light_of_stands() {
    const double zenith = 35 * std::numbers::pi / 180;
    return {
        make_directional_source("sun", {std::sin(zenith), 0, -std::cos(zenith)}, {1, .8}),
        make_uniform_sky("sky", {.3, .2})};
}

}  // namespace quasimc::bench
