// Sensors near lamps and shiny leaves, traced from the sensors: means against light tracing, which
// treats these points like all others, how often the intervals contain the truth, and how wide they
// are. Light scattered next to a lamp is sampled there from points far from it; see
// docs/theory/light-tracing.md.

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/source.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

struct Setting {
    std::string name;
    Vec3 lamp{.5, .5, .05};
    Opening opening = {};
    bool has_lamp = true, has_sun = false;
    double floor = .6;          ///< its albedo
    double exponent = 0;        ///< of glossy leaves; 0: Lambertian ones
    std::vector<Vec3> sensors;  ///< their corners
    double side = .05;          ///< of a sensor
    double view_deg = 0;        ///< half of the view angle; 0: all
    std::size_t leaves = 0;
    double widest = .2;  ///< largest interval of the scattered light, relative to that light
};

std::vector<Setting> settings() {
    const Opening tube{.kind = Opening::Kind::line, .length = .2};
    return {
        {.name = "far_from_a_lit_spot", .sensors = {{.8, .5, .3}, {.1, .1, .6}}},
        {.name = "next_to_a_lamp",
         .lamp = {.5, .5, .02},
         .sensors = {{.53, .5, .03}},
         .widest = .4},
        {.name = "in_view_of_a_spot",
         .sensors = {{.48, .48, .6}},
         .side = .1,
         .view_deg = 30,
         .widest = .1},
        {.name = "facing_shiny_leaves",
         .has_lamp = false,
         .has_sun = true,
         .exponent = 200,
         .sensors = {{.4, .4, .9}, {.6, .3, .2}},
         .leaves = 20},
        {.name = "by_a_lamp_among_shiny_leaves",
         .lamp = {.5, .5, .5},
         .exponent = 200,
         .sensors = {{.1, .2, .2}, {.8, .8, .9}},
         .leaves = 20,
         .widest = .6},
        {.name = "in_a_bright_stand",
         .lamp = {.5, .5, .5},
         .floor = .9,
         .sensors = {{.1, .1, .1}, {.3, .3, .3}, {.7, .7, .7}},
         .leaves = 60,
         .widest = .9},
        {.name = "by_a_tube",
         .lamp = {.5, .5, .04},
         .opening = tube,
         .sensors = {{.8, .8, .2}, {.1, .1, .6}},
         .widest = .4},
    };
}

Scene scene_of(const Setting& setting) {
    SceneBuilder builder = make_builder();
    MaterialSpec leaf = diffuse("leaf", .5 * setting.floor, .3 * setting.floor);
    for (SideOptics* side : {&leaf.upper[0], &leaf.lower[0]}) {
        if (setting.exponent > 0) {
            side->reflection_model = "phong";
            side->reflection_parameters["exponent"] = setting.exponent;
        }
    }
    builder.add_material(leaf);
    builder.add_material(diffuse("floor", setting.floor, 0));
    builder.add_material(sensor("sensor"));
    for (const Vec3& c : setting.sensors) {
        OrganSpec eye =
            organ("eye", "sensor", floor_of(c.x, c.x + setting.side, c.y, c.y + setting.side, c.z));
        eye.field_of_view_deg = setting.view_deg > 0 ? setting.view_deg : eye.field_of_view_deg;
        builder.add_organ(eye);
    }
    for (const Triangle& t : random_leaves(setting.leaves, .25, 1, 5)) {
        OrganSpec one = organ("", "leaf", {t});
        one.measured = false;
        builder.add_organ(one);
    }
    OrganSpec floor = organ("floor", "floor", floor_of(-.2, 1.2, -.2, 1.2, -.01));
    floor.measured = false;
    builder.add_organ(floor);
    return std::move(builder).build();
}

Sources sources_of(const Setting& setting) {
    Sources sources;
    if (setting.has_sun) {
        sources.push_back(sun(20, {1}));
    }
    if (setting.has_lamp) {
        LampSpec spec;
        spec.name = "lamp";
        spec.position = setting.lamp;
        // A line runs along the first.
        spec.axes = lamp_axes({1, 0, 0}, {0, 0, 1});
        spec.opening = setting.opening;
        spec.pattern =
            setting.opening.kind == Opening::Kind::line ? tube_pattern() : isotropic_pattern();
        spec.flux = {1};
        sources.push_back(make_lamp(std::move(spec)));
    }
    return sources;
}

struct SettingPilot {
    Setting setting;
    int seeds = 0;
    std::uint64_t paths = 0;  ///< of light tracing
    double resolution = 0;    ///< of the comparison with it
};

void PrintTo(const SettingPilot& pilot, std::ostream* out) {
    *out << pilot.setting.name;
}

std::vector<SettingPilot> pilots(int seeds, std::uint64_t paths, double resolution) {
    std::vector<SettingPilot> all;
    for (const Setting& setting : settings()) {
        all.push_back({setting, seeds, paths, resolution});
    }
    return all;
}

class NearLight : public ::testing::TestWithParam<SettingPilot> {};

/// The requirements for a sensor. With few contributions the rule of three is conservative, so that
/// the width shows whether intervals are too wide.
constexpr std::array kAskedOfSensors{
    Quantity::incident_upper, Quantity::incident_lower, Quantity::incident_scattered};

/// Number of a run's intervals that contain the truth, among those that are tested.
double part_held(const Result& result, const Result& truth, std::size_t sensors) {
    double right = 0;
    for (std::size_t i = 0; i < sensors; ++i) {
        for (const Quantity q : kAskedOfSensors) {
            const Estimate& e = result.at(i, q, 0);
            const double mean = truth.at(i, q, 0).mean;
            right += e.ci95_low <= mean && mean <= e.ci95_high ? 1 : 0;
        }
    }
    return right / static_cast<double>(sensors * kAskedOfSensors.size());
}

TEST_P(NearLight, IsKnownByTheSensorsThatSampleIt) {
    const auto& [setting, seeds, paths, resolution] = GetParam();
    const Scene scene = scene_of(setting);
    const Sources sources = sources_of(setting);
    const Result truth = run(scene, sources, spec_of(Method::from_organs, 1 << 15));
    const Result other = run(scene, sources, spec_of(Method::light_tracing, paths));
    const std::size_t sensors = setting.sensors.size();
    RunSpec pilot;
    pilot.method = Method::from_organs;
    pilot.threads = 1;
    pilot.paths = 1024 * sensors;
    std::vector<double> held, widths;
    for (int seed = 1; seed <= seeds; ++seed) {
        pilot.seed = static_cast<std::uint64_t>(seed);
        const Result result = run(scene, sources, pilot);
        held.push_back(part_held(result, truth, sensors));
        for (std::size_t i = 0; i < sensors; ++i) {
            const Estimate& e = result.at(i, Quantity::incident_scattered, 0);
            widths.push_back((e.ci95_high - e.ci95_low) / e.mean);
        }
    }
    const Estimate part = estimate_mean(held);
    EXPECT_GE(part.mean, .93) << part.standard_error;
    EXPECT_LE(estimate_mean(widths).mean, setting.widest);
    RecordProperty("coverage", std::to_string(part.mean));
    RecordProperty("width", std::to_string(estimate_mean(widths).mean));
    // Light from below or above alone may be missing.
    for (std::size_t i = 0; i < sensors; ++i) {
        for (const Quantity q : {Quantity::incident_direct, Quantity::incident_scattered}) {
            const Estimate& a = truth.at(i, q, 0);
            const Estimate& b = other.at(i, q, 0);
            EXPECT_TRUE(agrees(
                measured(a, kReplicates), measured(b, kReplicates), resolution * b.mean,
                sidak_level(kLevel, static_cast<unsigned>(2 * sensors))))
                << "sensor " << i << ", quantity " << static_cast<int>(q);
        }
    }
}

std::string name_of_setting(const ::testing::TestParamInfo<SettingPilot>& info) {
    return info.param.setting.name;
}
INSTANTIATE_TEST_SUITE_P(
    Quick, NearLight, ::testing::ValuesIn(pilots(40, 1 << 16, .6)), name_of_setting);
INSTANTIATE_TEST_SUITE_P(
    Long, NearLight, ::testing::ValuesIn(pilots(400, 1 << 22, .15)), name_of_setting);

}  // namespace
}  // namespace quasimc::test
