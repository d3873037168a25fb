// Light tracing, first hits and tracing from organs must give the same light on every organ, for
// every sampler, every model of every lobe, and every kind of source.
//
// Each combination compares totals (precise), each organ (coarse, but it detects light on the wrong
// organ), and the scatter of the organs' differences in units of their errors, whose square must be
// 1 on average: it detects a bias too small for any single organ.

#include <array>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "optics/catalogue.h"
#include "quasimc/source.h"
#include "samplers/catalogue.h"
#include "statistical/comparison.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kBands = 3;

/// Optics of leaves, with a name for the test.
struct Optics {
    std::string name;
    MaterialSpec leaf;
};

/// Sides and bands with different values for everything.
MaterialSpec uneven_leaf() {
    MaterialSpec leaf{"leaf", {}, {}};
    for (std::size_t b = 0; b < kBands; ++b) {
        const auto x = static_cast<double>(b);
        leaf.upper.push_back(
            {.reflectance = .1 + .2 * x,
             .transmittance = .3 - .1 * x,
             .reflection_parameters = {{"exponent", 3 + 8 * x}},
             .transmission_parameters = {{"exponent", 10 - 4 * x}}});
        leaf.lower.push_back(
            {.reflectance = .4 - .1 * x,
             .transmittance = .05 + .2 * x,
             .reflection_parameters = {{"exponent", 12 - 5 * x}},
             .transmission_parameters = {{"exponent", 2 + 4 * x}}});
    }
    return leaf;
}

/// The fields of SideOptics that define one of its lobes.
struct LobeFields {
    const char* words;
    std::string SideOptics::*model;
    BsdfParameters SideOptics::*parameters;
};
constexpr LobeFields kReflected{
    "reflected", &SideOptics::reflection_model, &SideOptics::reflection_parameters};
constexpr LobeFields kTransmitted{
    "transmitted", &SideOptics::transmission_model, &SideOptics::transmission_parameters};

/// A leaf whose reflection (or transmission) follows one model of the catalogue. A parameter other
/// than an exponent has its default value, or one from the middle of its domain.
Optics optics_of(const BsdfEntry& model, const LobeFields& lobe) {
    Optics optics{fmt::format("{}_{}", model.name, lobe.words), uneven_leaf()};
    for (auto* side : {&optics.leaf.upper, &optics.leaf.lower}) {
        for (SideOptics& band : *side) {
            band.*lobe.model = model.name;
            for (const BsdfParameter& p : model.parameters) {
                (band.*lobe.parameters).emplace(p.name, p.usual.value_or((p.low + p.high) / 2));
            }
        }
    }
    return optics;
}

Optics mixed_by_side() {
    Optics optics{"mixed_by_side", uneven_leaf()};
    for (std::size_t b = 0; b < kBands; ++b) {
        optics.leaf.upper[b].reflection_model = "blinn_phong";
        optics.leaf.upper[b].transmission_model = "phong";
        optics.leaf.lower[b].reflection_model = "mirror";
    }
    return optics;
}

Optics mixed_by_band() {
    Optics optics{"mixed_by_band", uneven_leaf()};
    optics.leaf.upper[0].reflection_model = "mirror";
    optics.leaf.upper[1].reflection_model = "phong";
    optics.leaf.lower[1].transmission_model = "mirror";
    optics.leaf.lower[2].reflection_model = "blinn_phong";
    return optics;
}

/// Every model of the catalogue, reflecting and transmitting; models mixed by side and by band.
std::vector<Optics> all_optics() {
    std::vector<Optics> all{{"lambertian", uneven_leaf()}};
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        if (entry.name != "lambertian") {
            all.push_back(optics_of(entry, kReflected));
            all.push_back(optics_of(entry, kTransmitted));
        }
    }
    all.push_back(mixed_by_side());
    all.push_back(mixed_by_band());
    return all;
}

struct Lighting {
    std::string name;
    Sources sources;
};

std::vector<Lighting> all_lighting() {
    const auto noon = sun(25, {1, .8, .5});
    const auto morning = make_directional_source("morning", {-.8, .3, -.5}, {.3, .5, 1});
    const auto evening = make_directional_source("evening", {.2, .9, -.4}, {.5, .5, .5});
    const auto dome = sky({.5, .7, 1});
    return {
        {"one sun", {noon}},
        {"three suns", {noon, morning, evening}},
        {"a sky", {dome}},
        {"sun and sky", {noon, dome}}};
}

/// Lamps above, beside and inside the stand, with light of the sun.
std::vector<Lighting> all_lamps() {
    const auto lamp = [](const Vec3& position, const Vec3& aim, Opening opening, Pattern pattern) {
        LampSpec spec;
        spec.name = "lamp";
        spec.position = position;
        spec.axes = lamp_axes(aim, {1, 0, 0});
        spec.opening = opening;
        spec.pattern = std::move(pattern);
        spec.flux = {1, .8, .5};
        return make_lamp(std::move(spec));
    };
    const Vec3 down{0, 0, -1};
    const auto panel = lamp(
        {.4, .5, 1.6}, {.1, 0, -1}, {.kind = Opening::Kind::rectangle, .length = 1, .width = .5},
        cosine_pattern());
    const auto tube = lamp(
        {.5, .2, 1.3}, {1, .3, 0}, {.kind = Opening::Kind::line, .length = 1.5}, tube_pattern());
    const auto disk =
        lamp({.5, .5, 2}, down, {.kind = Opening::Kind::disk, .radius = .3}, cosine_pattern());
    return {
        {"a point", {lamp({.5, .5, 1.8}, down, {}, isotropic_pattern())}},
        {"a far spot", {lamp({8, 3, 9}, {-8, -3, -9}, {}, spot_pattern(.02, .2))}},
        {"a panel", {panel}},
        {"a tube", {tube}},
        {"a sphere inside the canopy",
         {lamp(
             {.5, .5, .5}, down, {.kind = Opening::Kind::sphere, .radius = .1}, cosine_pattern())}},
        {"lamps and a sun", {panel, disk, sun(25, {1, .8, .5})}}};
}

/// Thirty leaves, three of them sensors on request, above a ground.
struct StandSpec {
    MaterialSpec leaf;
    Cell cell = {};
    std::size_t sensors = 0;
};

Scene make_stand(const StandSpec& spec) {
    SceneBuilder builder = make_builder(kBands);
    builder.add_material(spec.leaf);
    builder.add_material(diffuse("soil", .3, 0, kBands));
    builder.add_material(sensor("sensor", kBands));
    const std::vector<Triangle> leaves = random_leaves(30, .35, 1, 7);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        builder.add_organ(organ("", i < spec.sensors ? "sensor" : "leaf", {leaves[i]}));
    }
    GroundSpec soil = ground("soil");
    soil.height = -.2;
    builder.set_ground(soil);
    builder.set_cell(spec.cell);
    return std::move(builder).build();
}

/// The methods compared with tracing from organs.
constexpr std::array kForward{Method::light_tracing, Method::first_hits};

/// Traces forward and from the organs, with seeds of their own.
std::pair<Result, Result> trace_both_ways(
    const Scene& scene, const Sources& sources, RunSpec spec, Method from) {
    spec.method = from;
    const Result forward = run(scene, sources, spec);
    spec.method = Method::from_organs;
    spec.seed += 1000;
    return {forward, run(scene, sources, spec)};
}

constexpr double kTotals = .1;  // resolutions, see Comparison
constexpr double kOrgans = .8;

class ForwardAndBackward : public ::testing::TestWithParam<Optics> {};

TEST_P(ForwardAndBackward, AgreeWithEverySamplerAndSource) {
    const Scene scene = make_stand({GetParam().leaf});
    const auto lighting = all_lighting();
    const auto samplers = sampler_catalogue();
    Comparison comparison(
        static_cast<unsigned>(kForward.size() * lighting.size() * samplers.size()));
    RunSpec spec = spec_of({}, 1 << 12);
    for (const Method from : kForward) {
        for (const Lighting& lights : lighting) {
            for (const SamplerEntry& sampler : samplers) {
                SCOPED_TRACE(fmt::format("{}, {}", lights.name, sampler.name));
                spec.sampler = sampler.name;
                ++spec.seed;
                const auto [forward, backward] = trace_both_ways(scene, lights.sources, spec, from);
                EXPECT_TRUE(comparison.totals_agree(forward, backward));
                EXPECT_TRUE(comparison.organs_agree(forward, backward));
            }
        }
    }
    EXPECT_TRUE(comparison.are_sharp(kTotals, kOrgans));
    EXPECT_TRUE(comparison.scatter_is_that_of_errors(.5));
}

/// The ordinary run's part of that: every lobe with every sampler, and either of them under every
/// light and with every way of tracing forward, but not every combination of the four.
TEST(ForwardAndBackward, AgreeForEveryPairOfLobeSamplerAndSource) {
    const auto optics = all_optics();
    const auto lighting = all_lighting();
    const auto samplers = sampler_catalogue();
    Comparison comparison(static_cast<unsigned>(optics.size() * samplers.size()));
    RunSpec spec = spec_of({}, 1 << 12);
    for (std::size_t i = 0; i < optics.size(); ++i) {
        const Scene scene = make_stand({optics[i].leaf});
        for (std::size_t j = 0; j < samplers.size(); ++j) {
            const Lighting& lights = lighting[(i + j) % lighting.size()];
            const Method from = kForward[(i / lighting.size() + j) % kForward.size()];
            SCOPED_TRACE(fmt::format("{}, {}, {}", optics[i].name, lights.name, samplers[j].name));
            spec.sampler = samplers[j].name;
            ++spec.seed;
            const auto [forward, backward] = trace_both_ways(scene, lights.sources, spec, from);
            EXPECT_TRUE(comparison.totals_agree(forward, backward));
            EXPECT_TRUE(comparison.organs_agree(forward, backward));
        }
    }
    EXPECT_TRUE(comparison.are_sharp(kTotals, kOrgans));
    EXPECT_TRUE(comparison.scatter_is_that_of_errors(.5));
}

/// One scene under several kinds of light.
void expect_agreement(
    const StandSpec& stand,
    const RunSpec& spec,
    const std::vector<Lighting>& lighting = all_lighting()) {
    const Scene scene = make_stand(stand);
    Comparison comparison(static_cast<unsigned>(kForward.size() * lighting.size()));
    for (const Method from : kForward) {
        for (const Lighting& lights : lighting) {
            SCOPED_TRACE(lights.name);
            const auto [forward, backward] = trace_both_ways(scene, lights.sources, spec, from);
            EXPECT_TRUE(comparison.totals_agree(forward, backward));
            EXPECT_TRUE(comparison.organs_agree(forward, backward));
        }
    }
    EXPECT_TRUE(comparison.are_sharp(kTotals, kOrgans));
}

TEST(ForwardAndBackward, AgreeInAPeriodicCell) {
    const Cell both{.along_x = true, .along_y = true, .size_x = .8, .size_y = 1.1};
    const Cell row{.along_y = true, .size_y = .7};
    for (const Cell& cell : {both, row}) {
        expect_agreement({mixed_by_side().leaf, cell}, spec_of({}, 1 << 12));
    }
}

TEST(ForwardAndBackward, AgreeUnderLightFromTheSideAndFromBelow) {
    const std::vector<double> spectrum{1, .8, .5};
    const std::vector<Lighting> lighting{
        {"horizontal along x", {make_directional_source("x", {1, 0, 0}, spectrum)}},
        {"horizontal", {make_directional_source("side", {.6, -.8, 0}, spectrum)}},
        {"from below", {make_directional_source("below", {.1, .2, .9}, spectrum)}},
        {"from both", {sun(20, spectrum), make_directional_source("up", {0, 0, 1}, spectrum)}}};
    expect_agreement({mixed_by_side().leaf}, spec_of({}, 1 << 12), lighting);
}

TEST(ForwardAndBackward, AgreeOnPathsThatAreCutOff) {
    for (const std::uint32_t depth : {1U, 2U, 3U}) {
        SCOPED_TRACE(depth);
        RunSpec spec = spec_of({}, 1 << 12);
        spec.max_depth = depth;
        expect_agreement({optics_of(*find_bsdf("mirror"), kReflected).leaf}, spec);
    }
}

TEST(ForwardAndBackward, AgreeAroundAndOnSensors) {
    expect_agreement({mixed_by_band().leaf, {}, 6}, spec_of({}, 1 << 12));
}

TEST(ForwardAndBackward, AgreeUnderLamps) {
    expect_agreement({uneven_leaf()}, spec_of({}, 1 << 13), all_lamps());
    expect_agreement({mixed_by_side().leaf, {}, 6}, spec_of({}, 1 << 13), all_lamps());
}

/// A control: leaves that reflect and transmit a tenth more must be noticed.
TEST(ForwardAndBackward, DisagreeWhenOneSeesBrighterLeaves) {
    MaterialSpec brighter = uneven_leaf();
    for (auto side : {&MaterialSpec::upper, &MaterialSpec::lower}) {
        for (SideOptics& band : brighter.*side) {
            band.reflectance *= 1.1;
            band.transmittance *= 1.1;
        }
    }
    const Sources sources = all_lighting().back().sources;
    const Result forward =
        run(make_stand({uneven_leaf()}), sources, spec_of(Method::light_tracing, 1 << 12));
    const Result backward =
        run(make_stand({brighter}), sources, spec_of(Method::from_organs, 1 << 12));
    EXPECT_FALSE(Comparison(1).totals_agree(forward, backward));
}

INSTANTIATE_TEST_SUITE_P(
    Long, ForwardAndBackward, ::testing::ValuesIn(all_optics()), [](const auto& optics) {
        return optics.param.name;
    });

}  // namespace
}  // namespace quasimc::test
