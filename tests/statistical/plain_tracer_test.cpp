// Light by origin, of organs, groups and sensors, against a tracer that shares no code with the
// program, in three scenes: open, periodic, and a room with lamps.

#include "statistical/plain_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "options/options.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// One scene for both programs.
struct Both {
    SceneBuilder builder = make_builder();
    PlainScene plain;
    std::vector<std::string> plants;  ///< the value of a label, by organ

    /// @param optics  reflectance and transmittance of the upper, then of the lower side
    void add_organ(
        const std::vector<Triangle>& triangles,
        const std::array<double, 4>& optics,
        const std::string& plant) {
        const std::string material = fmt::format("m{}", plants.size());
        builder.add_material(
            {material,
             {{.reflectance = optics[0], .transmittance = optics[1]}},
             {{.reflectance = optics[2], .transmittance = optics[3]}}});
        builder.add_organ(labelled(organ("", material, triangles), {{"plant", plant}}));
        for (const Triangle& t : triangles) {
            plain.triangles.push_back(
                {t, plants.size(), {optics[0], optics[2]}, {optics[1], optics[3]}});
        }
        plants.push_back(plant);
    }
    void add_sensor(const Vec3& position, const Vec3& facing, double size, double view = 90) {
        SensorSet set{.name = fmt::format("s{}", plain.disks.size())};
        set.points.push_back({.position = position, .facing = facing});
        set.radius = size;
        set.field_of_view_deg = view;
        builder.add_sensors(std::move(set));
        plain.disks.push_back(
            {position, normalized(facing), size, std::cos(view * std::numbers::pi / 180)});
    }
};

/// A source for both programs.
struct BothSource {
    std::string origin;
    std::shared_ptr<const Source> source;
    PlainSource plain;
};

constexpr std::size_t kPlainPaths = 30000;

/// The light of one origin by the plain tracer: organs, sensors, then groups; a Measured for each
/// part.
using Reference = std::vector<std::array<Measured, kParts>>;

std::vector<std::vector<std::size_t>> members_of(const std::vector<std::string>& plants) {
    std::vector<std::vector<std::size_t>> groups;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < plants.size(); ++i) {
        const auto found = std::find(names.begin(), names.end(), plants[i]);
        const auto group = static_cast<std::size_t>(found - names.begin());
        if (found == names.end()) {
            names.push_back(plants[i]);
            groups.emplace_back();
        }
        groups[group].push_back(i);
    }
    return groups;
}

Reference reference_of(const Both& both, const PlainSource& source, std::uint64_t seed) {
    Random random(seed);
    const std::vector<std::vector<std::size_t>> groups = members_of(both.plants);
    std::vector<std::vector<PlainLight>> replicates;
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
        std::vector<PlainLight> light = trace_plainly(both.plain, source, kPlainPaths, random);
        for (const std::vector<std::size_t>& group : groups) {
            PlainLight sum{};
            for (const std::size_t organ : group) {
                for (std::size_t k = 0; k < kParts; ++k) {
                    sum.at(k) += light[organ].at(k);
                }
            }
            light.push_back(sum);
        }
        replicates.push_back(std::move(light));
    }
    Reference reference(replicates[0].size());
    for (std::size_t row = 0; row < reference.size(); ++row) {
        for (std::size_t k = 0; k < kParts; ++k) {
            std::vector<double> values;
            for (const std::vector<PlainLight>& light : replicates) {
                values.push_back(light[row].at(k));
            }
            reference[row].at(k) = measured(values);
        }
    }
    return reference;
}

constexpr std::array<Quantity, kParts> kQuantityOfPart = {
    Quantity::incident_upper, Quantity::incident_lower, Quantity::incident_direct,
    Quantity::incident_scattered, Quantity::absorbed_flux_density};

/// A number of the program.
struct Number {
    std::string what;
    Estimate density;
    double area = 0;
};

/// The numbers of an origin, in the order of a Reference.
std::vector<std::array<Number, kParts>> numbers_of(
    const Both& both, const Result& result, std::size_t origin) {
    const Result& light = result.origins[origin].light;
    const Result& sensors = result.sensors->origins[origin].light;
    std::vector<std::array<Number, kParts>> rows;
    const auto add = [&](const std::string& name, double area, const auto& at) {
        std::array<Number, kParts> row;
        for (std::size_t k = 0; k < kParts; ++k) {
            row.at(k) = {fmt::format("{}, part {}", name, k), at(kQuantityOfPart.at(k)), area};
        }
        rows.push_back(std::move(row));
    };
    std::vector<double> areas(both.plants.size());
    for (const PlainTriangle& t : both.plain.triangles) {
        areas[t.organ] +=
            length(cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0])) / 2;
    }
    for (std::size_t i = 0; i < areas.size(); ++i) {
        add(fmt::format("organ {}", i), areas[i], [&](Quantity q) { return light.at(i, q, 0); });
    }
    for (std::size_t i = 0; i < both.plain.disks.size(); ++i) {
        const double radius = both.plain.disks[i].radius;
        add(fmt::format("sensor {}", i), std::numbers::pi * radius * radius, [&](Quantity q) {
            return q == Quantity::absorbed_flux_density ? Estimate{} : sensors.at(i, q, 0);
        });
    }
    for (std::size_t i = 1; i < light.groups.groups.size(); ++i) {  // the first has all organs
        const OrganGroup& group = light.groups.groups[i];
        add("plant " + group.value, group.area,
            [&](Quantity q) { return light.groups.at(i, q, 0); });
    }
    return rows;
}

Measured per_area(Measured flux, double area) {
    return {flux.mean / area, flux.standard_error / area, flux.replicates};
}

/// The comparison of two programs.
struct Outcome {
    std::vector<std::string> disagreements;
    double numbers = 0, squares = 0;  ///< differences squared, in units of their errors

    /// @param resolution  light per area, which every number must have
    void compare(
        const std::array<Number, kParts>& ours,
        const std::array<Measured, kParts>& plain,
        double resolution,
        double level) {
        for (std::size_t k = 0; k < kParts; ++k) {
            const Measured a = measured(ours.at(k).density, kReplicates);
            const Measured b = per_area(plain.at(k), ours.at(k).area);
            if (a.mean == 0 && b.mean == 0) {
                continue;  // no light comes there
            }
            const ::testing::AssertionResult result = agrees(a, b, resolution, level);
            if (!result) {
                disagreements.push_back(ours.at(k).what + ": " + result.message());
            }
            const double error = std::hypot(a.standard_error, b.standard_error);
            squares += std::pow((a.mean - b.mean) / error, 2);
            numbers += 1;
        }
    }
};

/// All numbers of all origins by one method.
/// @param references  by origin
Outcome compare(
    Both both,
    const std::vector<BothSource>& sources,
    const std::vector<Reference>& references,
    Method method,
    double resolution) {
    RunSpec spec = spec_of(method, 1U << 15U);
    spec.groups = {"plant"};
    Sources all;
    for (const BothSource& source : sources) {
        spec.origins.push_back(source.origin);
        all.push_back(source.source);
    }
    const Result result = run(std::move(both.builder).build(), all, spec);
    const std::size_t tests = sources.size() * references[0].size() * kParts;
    const double level = sidak_level(kLevel, static_cast<unsigned>(tests));
    Outcome outcome;
    for (std::size_t s = 0; s < sources.size(); ++s) {
        const auto rows = numbers_of(both, result, s);
        for (std::size_t row = 0; row < rows.size(); ++row) {
            outcome.compare(rows[row], references[s].at(row), resolution, level);
        }
    }
    return outcome;
}

std::vector<Reference> references_of(const Both& both, const std::vector<BothSource>& sources) {
    std::vector<Reference> references;
    for (const BothSource& source : sources) {
        references.push_back(reference_of(both, source.plain, 7 + references.size()));
    }
    return references;
}

/// By all methods: every number agrees, and the differences are of the size of their errors.
void expect_agreement(const Both& both, const std::vector<BothSource>& sources, double resolution) {
    const std::vector<Reference> references = references_of(both, sources);
    for (const Method method :
         {Method::light_tracing, Method::from_organs, Method::first_hits, Method::ray_bundles}) {
        const Outcome outcome = compare(both, sources, references, method, resolution);
        EXPECT_TRUE(outcome.disagreements.empty())
            << method_name(method) << "\n"
            << fmt::format("{}", fmt::join(outcome.disagreements, "\n"));
        EXPECT_GT(outcome.numbers, 200);
        EXPECT_LT(outcome.squares / outcome.numbers, 1.5) << method_name(method);
        EXPECT_GT(outcome.squares / outcome.numbers, .6) << method_name(method);
    }
}

constexpr std::array<double, 4> kLeaf = {.3, .2, .25, .3}, kSoil = {.4, 0, .1, 0};

Vec3 sun_direction(double zenith_deg) {
    const double angle = zenith_deg * std::numbers::pi / 180;
    return {std::sin(angle), 0, -std::cos(angle)};
}

std::shared_ptr<const Source> lamp(const std::string& name, const Vec3& position, double flux) {
    LampSpec spec;
    spec.name = name;
    spec.position = position;
    spec.flux = {flux};
    return make_lamp(std::move(spec));
}

/// Leaves of four plants over a soil.
Both open_scene(const std::array<double, 4>& leaf) {
    Both both;
    const std::vector<Triangle> leaves = random_leaves(16, .5, 1, 11);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        both.add_organ({leaves[i]}, leaf, std::to_string(i / 4));
    }
    both.add_organ(floor_of(-.5, 1.5, -.5, 1.5, -.4), kSoil, "soil");
    both.add_sensor({.5, .5, 1.5}, {0, 0, 1}, .2);
    both.add_sensor({.5, .4, -.35}, {0, 0, 1}, .2);
    both.add_sensor({1.3, .3, .2}, {1, .5, 1}, .15);
    both.add_sensor({-.2, 1, .6}, {0, -1, 0}, .2, 50);
    return both;
}

std::vector<BothSource> sources_of_open_scene() {
    const Ball ball{{.5, .5, .4}, 1.8};
    const Vec3 position{.3, .9, 1.9};
    return {
        {"sun", sun(35, {1}), plain_sun(ball, sun_direction(35), 1)},
        {"sky", sky({1}), plain_sky(ball, 1)},
        {"lamp", lamp("lamp", position, 10), plain_lamp(position, 10)}};
}

TEST(PlainTracer, AgreesOnAnOpenScene) {
    expect_agreement(open_scene(kLeaf), sources_of_open_scene(), .18);
}

/// A control: leaves of the plain tracer that are half as reflective again.
TEST(PlainTracer, DisagreesOnOtherLeaves) {
    constexpr std::array<double, 4> kOther = {.45, .2, .375, .3};
    const std::vector<BothSource> sources = sources_of_open_scene();
    const std::vector<Reference> others = references_of(open_scene(kOther), sources);
    const Outcome outcome = compare(open_scene(kLeaf), sources, others, Method::first_hits, 1);
    EXPECT_FALSE(outcome.disagreements.empty());
    EXPECT_GT(outcome.squares / outcome.numbers, 1.5);
}

/// Rationale: a periodic stand, whose light passes through many copies of the cell.
TEST(PlainTracer, AgreesOnAPeriodicScene) {
    Both both;
    both.builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    both.plain.cell = 1;
    std::vector<Triangle> leaves = random_leaves(16, .3, .6, 5);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        for (Vec3& corner : leaves[i]) {
            corner += Vec3{.2, .2, .1};
        }
        both.add_organ({leaves[i]}, kLeaf, std::to_string(i / 4));
    }
    both.add_organ(floor_of(0, 1, 0, 1, -.2), kSoil, "soil");
    both.add_sensor({.5, .5, 1.2}, {0, 0, 1}, .2);
    both.add_sensor({.5, .5, -.15}, {0, 0, 1}, .2);
    both.add_sensor({.3, .7, .4}, {1, 0, 1}, .15);
    expect_agreement(
        both,
        {{"sun", sun(50, {1}), plain_sun_over(1, 2, sun_direction(50), 1)},
         {"sky", sky({1}), plain_sky_over(1, 2, 1)}},
        .15);
}

/// Rationale: most light of a bright room has been scattered several times.
TEST(PlainTracer, AgreesOnARoomWithLamps) {
    Both both;
    constexpr std::array<double, 4> kWall = {.7, 0, .3, 0};
    both.add_organ(floor_of(0, 2, 0, 2, 0), kSoil, "room");
    const std::array<Vec3, 4> corners = {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 a = corners.at(i), b = corners.at((i + 1) % 4), up{0, 0, 1.5};
        both.add_organ({{b, a, a + up}, {b, a + up, b + up}}, kWall, "room");
    }
    const std::vector<Triangle> leaves = random_leaves(8, .4, .8, 3);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        Triangle leaf = leaves[i];
        for (Vec3& corner : leaf) {
            corner += Vec3{.6, .6, .35};
        }
        both.add_organ({leaf}, kLeaf, std::to_string(i / 4));
    }
    both.add_sensor({1, 1, .05}, {0, 0, 1}, .2);
    both.add_sensor({.3, 1.6, .8}, {1, 1, 0}, .2);
    const Vec3 left{.4, .5, 1.45}, right{1.6, 1.5, 1.45};
    expect_agreement(
        both,
        {{"left", lamp("left", left, 4), plain_lamp(left, 4)},
         {"right", lamp("right", right, 2), plain_lamp(right, 2)},
         {"sky", sky({1}), plain_sky({{1, 1, .75}, 1.7}, 1)}},
        .15);
}

}  // namespace
}  // namespace quasimc::test
