#include "crops.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <utility>

#include "files/input_files.h"
#include "runfile/run_file.h"
#include "scene/scene.h"

namespace quasimc::bench {
namespace {

/// Random numbers in [0, 1), equal with every standard library.
class Draws {
  public:
    double operator()() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * (*this)(); }

  private:
    std::mt19937_64 random_{1991};
};

/// Reflectance and transmittance of both sides in PAR and in NIR.
struct Optics {
    double par_rho, par_tau, nir_rho, nir_tau;
};

MaterialSpec material_of(const char* name, const Optics& optics) {
    SideOptics par;
    par.reflectance = optics.par_rho;
    par.transmittance = optics.par_tau;
    SideOptics nir;
    nir.reflectance = optics.nir_rho;
    nir.transmittance = optics.nir_tau;
    return {.name = name, .upper = {par, nir}, .lower = {par, nir}};
}

SceneBuilder builder_of_plants() {
    SceneBuilder builder({{"PAR", "W m-2"}, {"NIR", "W m-2"}});
    builder.add_material(material_of("leaf", {.08, .06, .45, .42}));
    builder.add_material(material_of("stem", {.1, 0, .45, 0}));
    builder.add_material(material_of("soil", {.12, 0, .2, 0}));
    return builder;
}

void add_organ(
    SceneBuilder& builder, const char* material, const std::vector<Triangle>& triangles) {
    OrganSpec organ;
    organ.name = material;
    organ.parts.push_back({material, triangles});
    builder.add_organ(std::move(organ));
}

/// A blade: a strip of 2 x `steps` triangles that rises and bends down.
struct Blade {
    Vec3 base;
    double azimuth = 0, length = 1, width = .1;
    double rise = .8;  ///< tangent of the initial angle
    int steps = 8;
};

std::vector<Triangle> strip_of(const Blade& blade) {
    const Vec3 out{std::cos(blade.azimuth), std::sin(blade.azimuth), 0};
    const Vec3 across{-out.y, out.x, 0};
    const auto edge = [&](int i, double side) {
        const double along = static_cast<double>(i) / blade.steps;
        const double half = .5 * blade.width * (1 - along * along * .95);
        const double z = blade.length * along * (blade.rise - 1.1 * along);
        return blade.base + .8 * blade.length * along * out + side * half * across + Vec3{0, 0, z};
    };
    std::vector<Triangle> strip;
    for (int i = 0; i < blade.steps; ++i) {
        strip.push_back({edge(i, -1), edge(i + 1, -1), edge(i + 1, 1)});
        strip.push_back({edge(i, -1), edge(i + 1, 1), edge(i, 1)});
    }
    return strip;
}

constexpr double kGoldenAngle = 2.39996;

/// Ten blades of 16 triangles in two ranks, and a stem of 28.
constexpr std::uint32_t kMaizeTriangles = 188;

void add_maize_plant(SceneBuilder& builder, const Vec3& foot, Draws& draws) {
    constexpr int kBlades = 10;
    add_organ(builder, "stem", make_cylinder(foot, {0, 0, 1.6}, .012, .006, 8, true));
    const double rank = draws.between(0, std::numbers::pi);
    for (int i = 0; i < kBlades; ++i) {
        add_organ(
            builder, "leaf",
            strip_of(
                {.base = foot + Vec3{0, 0, .25 + .13 * i},
                 .azimuth = rank + std::numbers::pi * i + draws.between(-.3, .3),
                 .length = draws.between(.5, .8),
                 .width = .09,
                 .rise = draws.between(.85, 1.2)}));
    }
}

Scene make_maize(std::uint32_t triangles) {
    SceneBuilder builder = builder_of_plants();
    Draws draws;
    const auto plants = std::max(1U, triangles / kMaizeTriangles);
    const auto rows = static_cast<std::uint32_t>(std::max(1., std::round(std::sqrt(plants / 4.))));
    for (std::uint32_t i = 0; i < plants; ++i) {
        const double x = .75 * (i % rows) + draws.between(-.02, .02);
        const std::uint32_t row = i / rows;
        const double y = .16 * row + draws.between(-.02, .02);
        add_maize_plant(builder, {x, y, 0}, draws);
    }
    builder.set_ground({.material = "soil"});
    return std::move(builder).build();
}

/// The parts of a tree: the trunk and its limbs, and tufts of a dozen leaves of 24 triangles, close
/// enough to intersect each other.
std::vector<OrganPart> parts_of_tree(std::uint32_t triangles) {
    constexpr int kSteps = 12, kInTuft = 12;
    constexpr double kRadius = 1.5, kLeafAreaIndex = 2.5;
    Draws draws;
    std::vector<OrganPart> parts;
    parts.push_back({"stem", make_cylinder({0, 0, 0}, {0, 0, 2}, .1, .06, 24, true)});
    const auto leaves = std::max<std::uint32_t>(kInTuft, triangles / (2 * kSteps));
    const double area = kLeafAreaIndex * std::numbers::pi * kRadius * kRadius / leaves;
    const double length = std::sqrt(3 * area);
    Vec3 tuft;
    for (std::uint32_t i = 0; i < leaves; ++i) {
        if (i % kInTuft == 0) {
            const double around = 2 * std::numbers::pi * draws();
            const double far = kRadius * std::cbrt(draws.between(.2, 1));
            const double z = draws.between(-1, 1);
            const double flat = far * std::sqrt(1 - z * z);
            tuft = {flat * std::cos(around), flat * std::sin(around), 2.5 + far * z};
            const Vec3 limb = tuft - Vec3{0, 0, 2};
            parts.push_back({"stem", make_cylinder({0, 0, 2}, limb, .01, .003, 4, true)});
        }
        const Vec3 shift{draws.between(-.3, .3), draws.between(-.3, .3), draws.between(-.3, .3)};
        parts.push_back(
            {"leaf", strip_of(
                         {.base = tuft + length * shift,
                          .azimuth = 2 * std::numbers::pi * draws(),
                          .length = length,
                          .width = length / 2,
                          .rise = draws.between(-.2, 1.2),
                          .steps = kSteps})});
    }
    return parts;
}

Scene make_tree(std::uint32_t triangles) {
    SceneBuilder builder = builder_of_plants();
    for (OrganPart& part : parts_of_tree(triangles)) {
        OrganSpec organ;
        organ.name = part.material;
        organ.parts.push_back(std::move(part));
        builder.add_organ(std::move(organ));
    }
    return std::move(builder).build();
}

Scene make_solid_tree(std::uint32_t triangles) {
    SceneBuilder builder = builder_of_plants();
    OrganSpec organ;
    organ.name = "tree";
    organ.parts = parts_of_tree(triangles);
    builder.add_organ(std::move(organ));
    return std::move(builder).build();
}

/// A stem of 20 triangles and 30 leaves of 2, a metre and a half high.
constexpr std::uint32_t kTallPlantTriangles = 80;

/// A stem with rhombic leaves at golden angles.
struct Bush {
    Vec3 foot;
    double height = 1;
    int leaves = 10;
    double leaf = .15;  ///< length
};

void add_bush(SceneBuilder& builder, const Bush& bush, Draws& draws) {
    add_organ(builder, "stem", make_cylinder(bush.foot, {0, 0, bush.height}, .008, .004, 6, true));
    for (int i = 0; i < bush.leaves; ++i) {
        const double around = kGoldenAngle * i + draws.between(-.2, .2);
        const Vec3 out =
            normalized(Vec3{std::cos(around), std::sin(around), draws.between(-.4, .6)});
        const Vec3 base =
            bush.foot + Vec3{0, 0, bush.height * (.15 + .85 * (i + 1) / bush.leaves)} + .01 * out;
        add_organ(builder, "leaf", make_rhombus(base, bush.leaf * out, {0, 0, 1}, .6 * bush.leaf));
    }
}

constexpr double kAisle = .8, kAlongRow = .4;

Scene make_greenhouse(std::uint32_t triangles) {
    SceneBuilder builder = builder_of_plants();
    builder.add_material(material_of("floor", {.7, 0, .7, 0}));
    Draws draws;
    const auto plants = std::max(1U, triangles / kTallPlantTriangles);
    const auto rows = static_cast<std::uint32_t>(std::max(1., std::round(std::sqrt(plants / 2.))));
    for (std::uint32_t i = 0; i < plants; ++i) {
        const std::uint32_t along = i / rows;
        const Vec3 foot{kAisle * (i % rows), kAlongRow * along, .3};
        add_bush(builder, {.foot = foot, .height = 1.5, .leaves = 30, .leaf = .25}, draws);
    }
    builder.set_ground({.material = "floor"});
    return std::move(builder).build();
}

/// Plants of a stem of 20 triangles and 24 leaves of 2 in two rows of a cell.
Scene make_row_crop(std::uint32_t triangles) {
    constexpr std::uint32_t kTriangles = 68;
    constexpr double kRow = .4, kPlant = .08;
    SceneBuilder builder = builder_of_plants();
    Draws draws;
    const std::uint32_t in_row = std::max(1U, triangles / (2 * kTriangles));
    for (std::uint32_t i = 0; i < 2 * in_row; ++i) {
        const std::uint32_t along = i / 2;
        const Vec3 foot{kRow * (.5 + i % 2) + draws.between(-.02, .02), kPlant * (.5 + along), 0};
        add_bush(builder, {.foot = foot, .height = .7, .leaves = 24, .leaf = .1}, draws);
    }
    builder.set_cell(
        {.along_x = true, .along_y = true, .size_x = 2 * kRow, .size_y = kPlant * in_row});
    builder.set_ground({.material = "soil"});
    return std::move(builder).build();
}

/// A run file that refers to flowers.obj.
constexpr const char* kFlowerRun = R"(
bands = ["PAR", "NIR"]
[[source]]
type = "uniform_sky"
irradiance_horizontal = 1
[[material]]
name = "petal"
reflectance = [0.4, 0.5]
transmittance = [0.2, 0.4]
[[material]]
name = "stalk"
reflectance = [0.1, 0.45]
[[geometry]]
file = "flowers.obj"
)";

constexpr std::uint32_t kFlowerTriangles = 46;

Scene make_flowers(std::uint32_t triangles) {
    std::string obj = flowers_with_bad_faces(std::max(1U, triangles / kFlowerTriangles));
    InputFiles files(".", [&](const std::filesystem::path& /*path*/) { return obj; });
    return read_run_text(kFlowerRun, "flowers.toml", files).scene;
}

}  // namespace

std::string name_of(Crop crop) {
    switch (crop) {
        case Crop::maize:
            return "maize";
        case Crop::tree:
            return "tree";
        case Crop::greenhouse:
            return "greenhouse";
        case Crop::row_crop:
            return "row crop";
        case Crop::solid_tree:
            return "tree of one organ";
        case Crop::bad_faces:
            break;
    }
    return "bad faces";
}

std::uint32_t full_size(Crop crop) {
    switch (crop) {
        case Crop::maize:
            return 20'000;
        case Crop::tree:
            return 100'000;
        case Crop::greenhouse:
            return 7'200;
        case Crop::row_crop:
            return 2'400;
        case Crop::solid_tree:
            return 20'000;
        case Crop::bad_faces:
            break;
    }
    return 920;
}

Scene make_crop(Crop crop, std::uint32_t triangles) {
    switch (crop) {
        case Crop::maize:
            return make_maize(triangles);
        case Crop::tree:
            return make_tree(triangles);
        case Crop::greenhouse:
            return make_greenhouse(triangles);
        case Crop::row_crop:
            return make_row_crop(triangles);
        case Crop::solid_tree:
            return make_solid_tree(triangles);
        case Crop::bad_faces:
            break;
    }
    return make_flowers(triangles);
}

}  // namespace quasimc::bench
