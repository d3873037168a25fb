#include "width_scenes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "geometry/shapes/shapes.h"
#include "light/daylight/hour_light.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGoldenAngle = 2.39996;

/// Random numbers in [0, 1), equal with every standard library.
class Draws {
  public:
    double operator()() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    /// A direction, uniform over the sphere.
    Vec3 direction() {
        const double z = between(-1, 1);
        const double around = between(0, 2 * kPi);
        const double flat = std::sqrt(1 - z * z);
        return {flat * std::cos(around), flat * std::sin(around), z};
    }

  private:
    std::mt19937_64 random_{4711};
};

/// Reflectances in PAR and NIR of the opaque materials.
struct Floors {
    std::array<double, 2> soil{.2, .2}, panel{.5, .6};
};

SceneBuilder builder_of(const MaterialSpec& leaf, const Floors& floors = {}) {
    SceneBuilder builder({{"PAR", "W m-2"}, {"NIR", "W m-2"}});
    builder.add_material(leaf);
    builder.add_material(lambertian("stem", {.1, .45}));
    builder.add_material(lambertian("soil", {floors.soil[0], floors.soil[1]}));
    builder.add_material(lambertian("wall", {floors.panel[0], floors.panel[1]}));
    builder.add_material(lambertian("panel", {floors.panel[0], floors.panel[1]}));
    return builder;
}

MaterialSpec green_leaf() {
    return lambertian("leaf", {.08, .45}, {.06, .45});
}

void add(
    SceneBuilder& builder,
    const char* material,
    std::vector<Triangle> triangles,
    const std::string& plant = "") {
    OrganSpec organ;
    organ.name = material;
    if (!plant.empty()) {
        organ.labels = {{"plant", plant}};
    }
    organ.parts.push_back({material, std::move(triangles)});
    builder.add_organ(std::move(organ));
}

Sources sun_and_sky(double elevation_deg, double sky) {
    const double high = elevation_deg * kPi / 180;
    return {
        make_directional_source("sun", {std::cos(high), 0, -std::sin(high)}, {1, 1}),
        make_uniform_sky("sky", {sky, sky})};
}

Sources only_sky() {
    return {make_uniform_sky("sky", {1, 1})};
}

/// A box in which points are drawn.
struct Box {
    Vec3 low, high;
};

/// Leaves whose directions are uniform over the sphere.
struct RandomLeaves {
    int count = 60;
    Box bases;
    double length = .3, width = .18;
    double start = 0;  ///< where the leaf starts along its length, from its point: -.5 centres it
};

void add_leaves(SceneBuilder& builder, const RandomLeaves& leaves, Draws& draws) {
    for (int i = 0; i < leaves.count; ++i) {
        const Box& box = leaves.bases;
        const double x = draws.between(box.low.x, box.high.x);
        const double y = draws.between(box.low.y, box.high.y);
        const double z = draws.between(box.low.z, box.high.z);
        const Vec3 axis = leaves.length * draws.direction();
        const Vec3 base = Vec3{x, y, z} + leaves.start * axis;
        add(builder, "leaf", make_rhombus(base, axis, draws.direction(), leaves.width));
    }
}

/// A closed hexagonal stem of rings of equal height.
std::vector<Triangle> stem_of(const Vec3& foot, double height, double radius, int rings) {
    constexpr int kSides = 6;
    const auto corner = [&](int ring, int side) {
        const double around = 2 * kPi * side / kSides;
        return foot +
               Vec3{radius * std::cos(around), radius * std::sin(around), height * ring / rings};
    };
    std::vector<Triangle> stem;
    for (int ring = 0; ring < rings; ++ring) {
        for (int side = 0; side < kSides; ++side) {
            const Vec3 a = corner(ring, side), b = corner(ring, side + 1);
            const Vec3 c = corner(ring + 1, side + 1), d = corner(ring + 1, side);
            stem.push_back({a, b, c});
            stem.push_back({a, c, d});
        }
    }
    for (int side = 1; side + 1 < kSides; ++side) {
        stem.push_back({corner(rings, 0), corner(rings, side), corner(rings, side + 1)});
        stem.push_back({corner(0, 0), corner(0, side + 1), corner(0, side)});
    }
    return stem;
}

std::vector<Triangle> blade_of(
    const Vec3& base, double azimuth, double length, double width, double rise) {
    constexpr int kSteps = 8;
    const Vec3 out{std::cos(azimuth), std::sin(azimuth), 0};
    const Vec3 across{-out.y, out.x, 0};
    const auto edge = [&](int i, double side) {
        const double along = static_cast<double>(i) / kSteps;
        const double half = .5 * width * (1 - .95 * along * along);
        const double z = length * along * (rise - 1.1 * along);
        return base + .8 * length * along * out + side * half * across + Vec3{0, 0, z};
    };
    std::vector<Triangle> blade;
    for (int i = 0; i < kSteps; ++i) {
        blade.push_back({edge(i, -1), edge(i + 1, -1), edge(i + 1, 1)});
        blade.push_back({edge(i, -1), edge(i + 1, 1), edge(i, 1)});
    }
    return blade;
}

WidthScene leaves_under(const char* name, Light light, std::uint64_t truth_paths) {
    return {
        .name = name,
        .scene = make_canopy(Canopy{500, {.2, .9}}),
        .sources = make_light(light, 2),
        .groups = {.layers = 4},
        .ratios = {"band0:band1"},
        .truth_paths = truth_paths};
}

WidthScene leaves_sun() {
    return leaves_under("leaves_sun", Light::sun, 1 << 24);
}

WidthScene leaves_sky() {
    return leaves_under("leaves_sky", Light::sky, 1 << 24);
}

WidthScene clumped() {
    SceneBuilder builder = builder_of(green_leaf());
    Draws draws;
    constexpr double kHeight = .5;
    for (int plant = 0; plant < 6; ++plant) {
        const std::string label = std::to_string(plant + 1);
        const double x = .3 * (plant % 3) + draws.between(-.05, .05);
        const double y = .3 * (plant / 3) + draws.between(-.05, .05);
        add(builder, "stem", stem_of({x, y, 0}, kHeight, .004, 6), label);
        for (int i = 0; i < 20; ++i) {
            const double around = kGoldenAngle * i + draws.between(-.2, .2);
            const Vec3 out =
                normalized(Vec3{std::cos(around), std::sin(around), draws.between(-.3, .8)});
            const Vec3 base{x, y, kHeight * (.15 + .8 * (i + 1) / 20)};
            add(builder, "leaf", make_rhombus(base, .18 * out, {0, 0, 1}, .1), label);
        }
    }
    builder.set_ground({.material = "soil"});
    return {
        .name = "clumped",
        .scene = std::move(builder).build(),
        .sources = sun_and_sky(50, .3),
        .groups = {.labels = {"plant"}},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 23};
}

WidthScene maize() {
    SceneBuilder builder = builder_of(green_leaf());
    Draws draws;
    for (int plant = 0; plant < 4; ++plant) {
        const std::string label = std::to_string(plant + 1);
        const Vec3 foot{
            .375 + .75 * (plant % 2) + draws.between(-.02, .02),
            .125 + .25 * (plant / 2) + draws.between(-.02, .02), 0};
        add(builder, "stem", make_cylinder(foot, {0, 0, 1.6}, .012, .006, 8, true), label);
        const double rank = draws.between(0, kPi);
        for (int i = 0; i < 10; ++i) {
            const double azimuth = rank + kPi * i + draws.between(-.3, .3);
            const double length = draws.between(.5, .8);
            const Vec3 base = foot + Vec3{0, 0, .25 + .13 * i};
            add(builder, "leaf", blade_of(base, azimuth, length, .09, draws.between(.85, 1.2)),
                label);
        }
    }
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1.5, .size_y = .5});
    builder.set_ground({.material = "soil"});
    return {
        .name = "maize",
        .scene = std::move(builder).build(),
        .sources = sun_and_sky(50, .3),
        .groups = {.labels = {"plant"}},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 21};
}

/// A horizontal rectangle across the unit box, its upper side up.
std::vector<Triangle> shelf(double x0, double x1, double z) {
    return make_parallelogram({x0, 0, z}, {x1 - x0, 0, 0}, {0, 1, 0});
}

/// The four walls of the unit box, their lower sides inside.
void add_walls(SceneBuilder& builder, const char* material) {
    const std::array<Vec3, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 side = corners[(i + 1) % corners.size()] - corners[i];
        add(builder, material, make_parallelogram(corners[i], side, {0, 0, 1}));
    }
}

constexpr Box kInBox{{.15, .15, .1}, {.7, .7, .55}};

/// The unit box below a lid of equal panels, with a gap behind each.
WidthScene box_under(const char* name, int panels, double gap, std::uint64_t truth_paths) {
    SceneBuilder builder = builder_of(green_leaf());
    for (int i = 0; i < panels; ++i) {
        const double from = static_cast<double>(i) / panels;
        add(builder, "panel", shelf(from, from + 1. / panels - gap, 1));
    }
    add_walls(builder, "wall");
    Draws draws;
    add_leaves(builder, {.count = 60, .bases = kInBox}, draws);
    builder.set_ground({.material = "wall", .extent = std::array<double, 4>{0, 0, 1, 1}});
    return {
        .name = name,
        .scene = std::move(builder).build(),
        .sources = only_sky(),
        .groups = {.layers = 4},
        .ratios = {"PAR:NIR"},
        .truth_paths = truth_paths};
}

WidthScene slit() {
    return box_under("slit", 1, .01, 1 << 25);
}

WidthScene slats() {
    return box_under("slats", 10, .004, 1 << 25);
}

WidthScene through_ground() {
    SceneBuilder builder = builder_of(green_leaf());
    Draws draws;
    const Box box{{.1, .1, 0}, {.9, .9, 0}};
    add_leaves(
        builder, {.count = 60, .bases = box, .length = .2, .width = .12, .start = -.5}, draws);
    builder.set_ground({.material = "soil", .extent = std::array<double, 4>{0, 0, 1, 1}});
    return {
        .name = "through_ground",
        .scene = std::move(builder).build(),
        .sources = sun_and_sky(50, .3),
        .groups = {.layers = 2},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 24};
}

WidthScene rosettes() {
    SceneBuilder builder = builder_of(green_leaf());
    Draws draws;
    for (int plant = 0; plant < 9; ++plant) {
        const std::string label = std::to_string(plant + 1);
        const Vec3 heart{
            (plant % 3 + .5) / 3 + draws.between(-.03, .03),
            (plant / 3 + .5) / 3 + draws.between(-.03, .03), .03};
        for (int i = 0; i < 16; ++i) {
            const double around = kGoldenAngle * i;
            const double rise = std::tan(draws.between(.1, 1));
            const Vec3 out = normalized(Vec3{std::cos(around), std::sin(around), rise});
            add(builder, "leaf", make_rhombus(heart, .2 * out, {0, 0, 1}, .1), label);
        }
    }
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    builder.set_ground({.material = "soil"});
    return {
        .name = "rosettes",
        .scene = std::move(builder).build(),
        .sources = only_sky(),
        .groups = {.labels = {"plant"}},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 22};
}

WidthScene snow() {
    SceneBuilder builder =
        builder_of(lambertian("leaf", {.45, .45}, {.45, .45}), {.soil = {.9, .85}});
    Draws draws;
    const Box box{{.1, .1, .15}, {.9, .9, .6}};
    add_leaves(
        builder, {.count = 100, .bases = box, .length = .2, .width = .12, .start = -.5}, draws);
    builder.set_ground({.material = "soil"});
    return {
        .name = "snow",
        .scene = std::move(builder).build(),
        .sources = only_sky(),
        .groups = {.layers = 4},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 24};
}

WidthScene chamber() {
    SceneBuilder builder = builder_of(green_leaf(), {.panel = {.9, .85}});
    add(builder, "panel", shelf(0, 1, 1));
    add(builder, "wall", shelf(0, 1, 0));
    add_walls(builder, "panel");
    Draws draws;
    add_leaves(builder, {.count = 40, .bases = kInBox, .length = .25, .width = .15}, draws);
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = {.5, .5, .99};
    lamp.opening = {.kind = Opening::Kind::disk, .radius = .1};
    lamp.pattern = cosine_pattern();
    lamp.flux = {1, 1};
    return {
        .name = "chamber",
        .scene = std::move(builder).build(),
        .sources = {make_lamp(std::move(lamp))},
        .groups = {.layers = 4},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 21};
}

WidthScene five_bands() {
    return {
        .name = "five_bands",
        .scene = make_canopy(Canopy{200, {0, .2, .6, .9, 1}}),
        .sources = make_light(Light::sun, 5),
        .groups = {.layers = 4},
        .ratios = {"band1:band3"},
        .truth_paths = 1 << 24};
}

WidthScene zenith_stems() {
    SceneBuilder builder = builder_of(green_leaf());
    Draws draws;
    for (int i = 0; i < 12; ++i) {
        const double x = (i % 4 + draws.between(.3, .7)) / 4;
        const double y = (i / 4 + draws.between(.3, .7)) / 3;
        add(builder, "stem", stem_of({x, y, 0}, .6, .01, 1));
    }
    const Box box{{.1, .1, .15}, {.9, .9, .6}};
    add_leaves(
        builder, {.count = 60, .bases = box, .length = .2, .width = .12, .start = -.5}, draws);
    builder.set_ground({.material = "soil"});
    return {
        .name = "zenith_stems",
        .scene = std::move(builder).build(),
        .sources = {make_directional_source("sun", {0, 0, -1}, {1, 1})},
        .groups = {.layers = 3},
        .ratios = {"PAR:NIR"},
        .truth_paths = 1 << 23};
}

/// 21 June at 52 degrees north without clouds, hour by hour.
WidthScene season() {
    constexpr double kHour = 3600;
    constexpr int kFirstHour = 4, kLastHour = 21;
    const Site site{.latitude_deg = 51.97, .longitude_deg = 5.67};
    DaylightSources how;
    how.bands = {{400, 700}, {700, 1100}};
    WidthScene day{
        .name = "season", .scene = make_canopy(Canopy{200, {.2, .85}, 7}), .truth_paths = 1 << 18};
    for (int hour = kFirstHour; hour < kLastHour; ++hour) {
        const SunPath path = sun_path(site, {2024, 6, 21, hour, 0, 0, 1}, kHour, 300);
        HourSources light = make_hour_sources(make_hour_parts(path, clear_light(path, {}), how));
        if (!light.sources.empty()) {
            day.hours.push_back(
                {"hour", std::move(light.sources), std::move(light.directional_key), kHour, 0});
        }
    }
    return day;
}

}  // namespace

const std::vector<WidthCase>& width_cases() {
    static const std::vector<WidthCase> cases{
        {"leaves_sun", leaves_sun},
        {"leaves_sky", leaves_sky},
        {"clumped", clumped},
        {"maize", maize},
        {"slit", slit},
        {"slats", slats},
        {"through_ground", through_ground},
        {"rosettes", rosettes},
        {"snow", snow},
        {"chamber", chamber},
        {"five_bands", five_bands},
        {"zenith_stems", zenith_stems},
        {"season", season}};
    return cases;
}

}  // namespace quasimc::bench
