#include "regression/cases.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "quasimc/source.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"
#include "support/skies.h"

// To add a case: a function with its rationale and expected behaviour, and a row at the end. Then
// write the table anew (see write_expected.cpp). Cases stay small: each is run eight times.

namespace quasimc::test {
namespace {

constexpr std::uint64_t kPaths = 1U << 14U;
/// Neither this nor one less is a power of two: dividing by one hides the order of divisions.
constexpr std::uint32_t kFewReplicates = 7;

RunSpec spec_with(std::string sampler, std::uint64_t paths = kPaths) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.sampler = std::move(sampler);
    spec.paths = paths;
    spec.replicates = kFewReplicates;
    return spec;
}

/// A matt material of its own reflectance and transmittance in each band; the lower side reflects
/// one and a half times as much as the upper.
MaterialSpec leaf_of(std::string name, const std::vector<std::array<double, 2>>& rho_tau) {
    MaterialSpec spec{std::move(name), {}, {}};
    for (const auto& [rho, tau] : rho_tau) {
        spec.upper.push_back({.reflectance = rho, .transmittance = tau});
        spec.lower.push_back({.reflectance = 1.5 * rho, .transmittance = tau});
    }
    return spec;
}

/// Each leaf an organ of its own, materials in turn.
void add_leaves(
    SceneBuilder& builder,
    const std::vector<Triangle>& leaves,
    const std::vector<std::string>& materials) {
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        builder.add_organ(organ("", materials[i % materials.size()], {leaves[i]}));
    }
}

/// Rationale: the plainest of runs: leaves that absorb nearly all light, a single sun, no ground.
/// Expected: nearly all light absorbed is direct. The audit traces the scene a second time, by
/// plain Monte Carlo.
Case one_sun_par() {
    SceneBuilder builder({Band{"PAR", "umol m-2 s-1"}});
    builder.add_material(leaf_of("leaf", {{.06, .04}}));
    add_leaves(builder, random_leaves(500, .09, 1, 11), {"leaf"});
    RunSpec spec = spec_with("sobol");
    spec.replicates = 8;
    spec.audit = .25;
    return {std::move(builder).build(), {sun(35, {1800})}, spec};
}

/// Rationale: bands that share paths: two suns of different spectra, scattering from weak (red) to
/// strong (near infrared), ratios of bands.
/// Expected: red to far-red falls below that of the sources; near infrared is absorbed least.
Case two_suns_nir() {
    SceneBuilder builder = make_builder(3);
    builder.add_material(leaf_of("leaf", {{.05, .03}, {.25, .3}, {.3, .45}}));
    builder.add_material(diffuse("bark", .3, 0, 3));
    add_leaves(builder, random_leaves(150, .16, 1, 12), {"leaf", "leaf", "bark"});
    RunSpec spec = spec_with("korobov");
    spec.ratios = {"b0:b1", "b2:b0"};
    return {
        std::move(builder).build(),
        {sun(20, {1, .9, .7}), make_directional_source("second sun", {-.5, .6, -.4}, {.1, .3, .5})},
        spec};
}

/// Rationale: light from everywhere and a white scene, with a roulette that lets weights fall.
/// Expected: long paths; much light scattered more than once; no sunlit fraction.
Case uniform_sky() {
    SceneBuilder builder = make_builder();
    builder.add_material(leaf_of("leaf", {{.3, .4}}));
    add_leaves(builder, random_leaves(80, .2, 1, 13), {"leaf"});
    RunSpec spec = spec_with("halton");
    spec.roulette_threshold = .1;
    return {std::move(builder).build(), {sky({400})}, spec};
}

/// Rationale: skies of uneven radiance and a sun with an extent, each of its own integral and its
/// own draw of directions: CIE clear, Perez, a table, a disk.
/// Expected: the side towards the sun gets more; the disk is a sun (sunlit fraction between 0, 1).
Case clear_sky_and_sun_disk() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(leaf_of("leaf", {{.1, .05}, {.3, .4}}));
    add_leaves(builder, random_leaves(80, .2, 1, 14), {"leaf"});
    SkyState state;
    state.to_sun = sun_at(40);
    state.diffuse_horizontal = 180;
    state.direct_normal = 600;
    return {
        std::move(builder).build(),
        {make_sky("clear", cie_clear_shape(sun_at(40)), {40, 60}),
         make_sky("all weather", perez_shape(state), {80, 50}),
         make_sky("table", table_shape(uneven_table(5, 4)), {10, 20}),
         make_sun_disk("disk", sun_at(40), solar_radius_deg(1), {500, 450})},
        spec_with("faure")};
}

/// Rationale: an endless canopy: leaves that reach over the borders of the cell, rays that cross
/// them, a ground below.
/// Expected: all light that does not leave upwards is absorbed; ground and leaves share it.
Case periodic_canopy() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(leaf_of("leaf", {{.08, .04}, {.35, .4}}));
    builder.add_material(diffuse("soil", .2, 0, 2));
    add_leaves(builder, random_leaves(100, .2, 1, 15), {"leaf"});
    GroundSpec soil = ground("soil");
    soil.height = -.2;
    builder.set_ground(soil);
    builder.set_cell(
        {.along_x = true, .along_y = true, .low_x = .1, .low_y = -.05, .size_x = .8, .size_y = .9});
    return {std::move(builder).build(), {sun(50, {700, 500}), sky({200, 100})}, spec_with("sobol")};
}

/// Rationale: a row, periodic along x alone, on a ground of given extent; what falls on organs
/// straight from the sources is left out; plain random numbers.
/// Expected: only scattered light is counted, so all numbers are small; no incident direct light.
Case periodic_row_without_direct_light() {
    SceneBuilder builder = make_builder();
    builder.add_material(leaf_of("leaf", {{.3, .4}}));
    builder.add_material(diffuse("soil", .25, 0));
    add_leaves(builder, random_leaves(80, .2, 1, 16), {"leaf"});
    GroundSpec soil = ground("soil");
    soil.height = -.15;
    soil.extent = {{.0, -1, 1, 2}};
    builder.set_ground(soil);
    builder.set_cell({.along_x = true, .size_x = 1});
    RunSpec spec = spec_with("monte_carlo");
    spec.direct_light = DirectLight::excluded;
    return {std::move(builder).build(), {sun(40, {600}), sky({150})}, spec};
}

/// A lamp that aims down.
LampSpec lamp_at(const Vec3& position, std::vector<double> flux) {
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = position;
    lamp.flux = std::move(flux);
    return lamp;
}

/// Rationale: sources at a finite distance: a point, a disk, a rectangle with a measured pattern
/// that aims aside, a spherical one between the leaves.
/// Expected: organs near the lamps get most; no sunlit fraction; part of the light misses the
/// scene.
Case lamps() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(leaf_of("leaf", {{.1, .05}, {.3, .4}}));
    builder.add_material(diffuse("bench", .5, 0, 2));
    add_leaves(builder, random_leaves(60, .2, 1, 27), {"leaf"});
    builder.add_organ(organ("bench", "bench", floor_of(0, 1, 0, 1, -.2)));
    LampSpec disk = lamp_at({.2, .3, 1.5}, {30, 10});
    disk.opening = {.kind = Opening::Kind::disk, .radius = .1};
    disk.pattern = cosine_pattern();
    LampSpec panel = lamp_at({1.4, .5, 1.3}, {20, 20});
    panel.opening = {.kind = Opening::Kind::rectangle, .length = .4, .width = .2};
    panel.pattern = web_pattern({{0, 30, 60, 90}, {0, 90}, {100, 90, 40, 0, 100, 80, 70, 10}});
    panel.axes = lamp_axes({-1, 0, -1}, {0, 1, 0});
    LampSpec ball = lamp_at({.5, .5, .5}, {5, 5});
    ball.opening = {.kind = Opening::Kind::sphere, .radius = .05};
    ball.pattern = cosine_pattern();
    return {
        std::move(builder).build(),
        {make_lamp(lamp_at({.8, .8, 1.2}, {10, 30})), make_lamp(disk), make_lamp(panel),
         make_lamp(ball)},
        spec_with("korobov"),
        true};
}

/// Rationale: what counts light without changing it: sensors in and above a canopy, some of a
/// narrow field of view; rays are cast by the brute-force intersector, so that no other library has
/// a say.
/// Expected: sensors absorb nothing; the narrower the field of view, the less light they count.
Case sensors() {
    SceneBuilder builder = make_builder();
    builder.add_material(leaf_of("leaf", {{.2, .2}}));
    builder.add_material(sensor("sensor"));
    add_leaves(builder, random_leaves(40, .25, 1, 18), {"leaf"});
    const std::array<double, 4> views{90, 60, 45, 20};
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto x = .25 * static_cast<double>(i);
        OrganSpec level = organ("", "sensor", floor_of(x, x + .2, .3, .6, i == 0 ? 1.3 : .4));
        level.field_of_view_deg = views[i];
        builder.add_organ(level);
    }
    RunSpec spec = spec_with("halton", 1U << 11U);
    spec.accelerator = Accelerator::brute_force;
    return {std::move(builder).build(), {sun(30, {500}), sky({200})}, spec};
}

/// Rationale: every lobe model, reflected and transmitted, and sides that differ; paths are cut off
/// after a few hits; beams start in the disc around the scene.
/// Expected: in each way the same within the errors; some light is cut off.
Case glossy_leaves() {
    SceneBuilder builder = make_builder(2);
    const SideOptics waxy{.5, .2, "phong", {{"exponent", 20}}, "blinn_phong", {{"exponent", 5}}};
    const SideOptics plate{.8, 0, "mirror", {}, "lambertian", {}};
    const SideOptics dewy{.3, .4, "blinn_phong", {{"exponent", 30}}, "mirror", {}};
    const SideOptics dull{.2, .3};
    builder.add_material({"waxy", {waxy, dull}, {dull, dewy}});
    builder.add_material({"plate", {plate, plate}, {plate, dull}});
    builder.add_material({"dewy", {dewy, waxy}, {dull, dull}});
    add_leaves(builder, random_leaves(60, .25, 1, 19), {"waxy", "plate", "dewy"});
    RunSpec spec = spec_with("sobol");
    spec.max_depth = 4;
    spec.roulette_threshold = .3;
    spec.start_area = StartArea::bounding_sphere;
    return {std::move(builder).build(), {sun(25, {500, 400}), sky({200, 100})}, spec};
}

/// Rationale: a file's own world: y is up, units are inches, coordinates those of a map; organs of
/// several parts of different materials, some of which are not measured, one without area.
/// Expected: from organs, what is not measured is NaN, so that the mean is that of fewer organs;
/// fluxes are large, being summed over square inches.
Case parts_far_from_the_origin() {
    const Orientation orientation(UpAxis::y, {0, 0, 1});
    SceneBuilder builder({Band{"PAR"}}, orientation);
    builder.set_length_unit("in");
    builder.add_material(leaf_of("blade", {{.2, .3}}));
    builder.add_material(diffuse("vein", .5, .1));
    builder.add_material(diffuse("soil", .2, 0));
    const Vec3 shift{1.7e7, 2.1e8, 1200};
    const auto placed = [&](Triangle t) {
        for (Vec3& corner : t) {
            corner = orientation.outward(39.37 * corner + shift);
        }
        return t;
    };
    const std::vector<Triangle> leaves = random_leaves(90, .25, 1, 20);
    for (std::size_t i = 0; i + 2 < leaves.size(); i += 3) {
        OrganSpec plant = organ("", "blade", {placed(leaves[i]), placed(leaves[i + 1])});
        plant.parts.push_back({"vein", {placed(leaves[i + 2])}});
        plant.measured = i % 4 != 1;
        builder.add_organ(plant);
    }
    builder.add_organ(organ("dot", "vein", {placed({{{.5, .5, .5}, {.5, .5, .5}, {.5, .5, .5}}})}));
    GroundSpec soil = ground("soil");
    for (const Triangle& t : floor_of(-.5, 1.5, -.5, 1.5, -.3)) {
        soil.triangles.push_back(placed(t));
    }
    builder.set_ground(soil);
    return {std::move(builder).build(), {sun(30, {1500}), sky({300})}, spec_with("sobol")};
}

/// Rationale: more numbers to sum than fit a private tally of each thread: one is shared.
/// Expected: the numbers that private tallies give.
Case shared_tallies() {
    SceneBuilder builder = make_builder(4);
    builder.add_material(leaf_of("leaf", {{.05, .03}, {.1, .1}, {.3, .3}, {.3, .45}}));
    builder.add_material(diffuse("soil", .2, 0, 4));
    add_leaves(builder, random_leaves(400, .1, 1, 21), {"leaf"});
    GroundSpec soil = ground("soil");
    soil.height = -.1;
    builder.set_ground(soil);
    RunSpec spec = spec_with("sobol");
    spec.tally_memory_mb = 0;
    return {std::move(builder).build(), {sun(35, {1, .8, .6, .9}), sky({.3, .4, .2, .1})}, spec};
}

/// Rationale: runs that decide for themselves when to stop: rounds follow each other until most
/// organs are known well enough; organs are few and of very different sizes.
/// Expected: several rounds; small leaves miss the target longest, so the planner starts from
/// organs.
Case rounds_to_a_target() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(leaf_of("leaf", {{.1, .1}, {.3, .4}}));
    builder.add_material(diffuse("soil", .2, 0, 2));
    add_leaves(builder, random_leaves(16, .15, 1, 22), {"leaf"});
    GroundSpec soil = ground("soil");
    soil.height = -.2;
    soil.extent = {{-2, -2, 3, 3}};
    builder.set_ground(soil);
    RunSpec spec = spec_with("sobol", 1U << 9U);
    spec.target_error = .015;
    spec.target_fraction = .8;
    spec.max_paths = 1U << 14U;
    spec.ratios = {"b1:b0"};
    return {std::move(builder).build(), {sun(40, {600, 500}), sky({200, 100})}, spec};
}

}  // namespace

const std::vector<CaseEntry>& all_cases() {
    static const std::vector<CaseEntry> cases{
        {"one_sun_par", one_sun_par},
        {"two_suns_nir", two_suns_nir},
        {"uniform_sky", uniform_sky},
        {"clear_sky_and_sun_disk", clear_sky_and_sun_disk},
        {"periodic_canopy", periodic_canopy},
        {"periodic_row_without_direct_light", periodic_row_without_direct_light},
        {"lamps", lamps},
        {"sensors", sensors},
        {"glossy_leaves", glossy_leaves},
        {"parts_far_from_the_origin", parts_far_from_the_origin},
        {"shared_tallies", shared_tallies},
        {"rounds_to_a_target", rounds_to_a_target}};
    return cases;
}

}  // namespace quasimc::test
