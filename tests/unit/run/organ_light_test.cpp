#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "quasimc/quasimc.h"

namespace quasimc::test {
namespace {

SceneBuilder builder_of_leaves() {
    SceneBuilder builder({{.name = "PAR"}, {.name = "NIR"}});
    builder.add_material(lambertian("leaf", {.1, .4}, {.05, .4}));
    for (const std::int64_t id : {3, 8}) {
        const double low = id == 3 ? 0 : .5;
        builder.add_organ(
            {.id = id,
             .name = id == 3 ? "lower leaf" : "upper leaf",
             .parts = {
                 {.material = "leaf",
                  .triangles = make_parallelogram({0, 0, low}, {1, 0, 0}, {0, 1, 0})}}});
    }
    return builder;
}

Result light_of(const Scene& scene) {
    return run(
        scene,
        {make_uniform_sky("sky", {100, 50}), make_directional_source("sun", {0, 0, -1}, {9, 8})},
        {.paths = 256});
}

/// The bits of an estimate, which are equal where it is NaN too.
std::array<std::uint64_t, 4> bits(const Estimate& e) {
    return std::bit_cast<std::array<std::uint64_t, 4>>(
        std::array{e.mean, e.standard_error, e.ci95_low, e.ci95_high});
}

std::string error_of(const auto& ask) {
    try {
        static_cast<void>(ask());
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(OrganLight, IsFoundByNameByIdAndByIndex) {
    const Result result = light_of(builder_of_leaves().build());
    const auto upper = bits(result.at(1, Quantity::absorbed_flux, 1));
    EXPECT_EQ(bits(result["upper leaf"].absorbed_flux("NIR")), upper);
    EXPECT_EQ(bits(result["upper leaf"].absorbed_flux(1)), upper);
    EXPECT_EQ(bits(result.organ(8).absorbed_flux(std::string("NIR"))), upper);
    EXPECT_EQ(bits(result[1].absorbed_flux("NIR")), upper);
    const OrganLight lower = result["lower leaf"];
    EXPECT_EQ(bits(result[0].absorbed_flux(0)), bits(lower.absorbed_flux("PAR")));
    for (const QuantityEntry& entry : quantity_table()) {
        EXPECT_EQ(bits(lower.at(entry.quantity, "PAR")), bits(result.at(0, entry.quantity, 0)))
            << entry.name;
    }
    EXPECT_EQ(bits(lower.incident_upper(0)), bits(result.at(0, Quantity::incident_upper, 0)));
    EXPECT_EQ(bits(lower.incident_lower(0)), bits(result.at(0, Quantity::incident_lower, 0)));
    EXPECT_EQ(bits(lower.incident_direct(0)), bits(result.at(0, Quantity::incident_direct, 0)));
    EXPECT_EQ(
        bits(lower.incident_scattered(0)), bits(result.at(0, Quantity::incident_scattered, 0)));
    EXPECT_EQ(
        bits(lower.absorbed_flux_density(0)),
        bits(result.at(0, Quantity::absorbed_flux_density, 0)));
    EXPECT_EQ(bits(lower.sunlit_fraction()), bits(result.sunlit_fraction[0]));
}

TEST(OrganLight, AnUnknownNameIsAnsweredWithThoseThatThereAre) {
    const Result result = light_of(builder_of_leaves().build());
    EXPECT_EQ(
        error_of([&] { return result["uper leaf"]; }),
        "organ 'uper leaf': no organ of the scene has this name; did you mean 'upper leaf'?");
    EXPECT_EQ(
        error_of([&] { return result["x"]; }),
        "organ 'x': no organ of the scene has this name; organs are 'lower leaf', 'upper leaf'");
    EXPECT_EQ(
        error_of([&] { return result["upper leaf"].absorbed_flux("UV"); }),
        "band 'UV': no band of the scene has this name; bands are 'PAR', 'NIR'");
    EXPECT_NE(error_of([&] { return result["upper leaf"].absorbed_flux(2); }), "");
    EXPECT_NE(error_of([&] { return result.organ(4); }), "");
    EXPECT_EQ(
        error_of([&] { return result[2]; }),
        "organ 2: no organ of the scene has this index; it has 2, counted from 0");
    const Result nameless;
    EXPECT_NE(error_of([&] { return nameless["upper leaf"]; }), "");
}

TEST(OrganLight, ANameOfSeveralOrgansIsRefused) {
    SceneBuilder builder = builder_of_leaves();
    builder.add_organ(
        {.id = 9,
         .name = "upper leaf",
         .parts = {{.material = "leaf", .triangles = make_disk({5, 5, 5}, {0, 0, 1}, 1, 8)}}});
    const Result result = light_of(builder.build());
    EXPECT_EQ(
        error_of([&] { return result["upper leaf"]; }),
        "organ 'upper leaf': several organs have this name; use the organ's id");
    EXPECT_GT(result.organ(9).absorbed_flux("PAR").mean, 0);
}

TEST(OrganLight, NamesOutliveTheSceneAndAreKeptOnce) {
    auto scene = std::make_unique<const Scene>(builder_of_leaves().build());
    const Result first = light_of(*scene), second = light_of(*scene);
    EXPECT_EQ(first.names, second.names);
    scene.reset();
    EXPECT_GT(first["lower leaf"].absorbed_flux("PAR").mean, 0);
}

TEST(SceneBuilder, CanBeBuiltAndUsedOn) {
    SceneBuilder builder = builder_of_leaves();
    EXPECT_EQ(builder.build().organs().size(), 2U);
    builder.set_ground({.material = "leaf"});
    EXPECT_EQ(builder.build().organs().size(), 3U);
}

TEST(Lambertian, NeedsATransmittanceOfEachBandOrNone) {
    EXPECT_EQ(lambertian("a", {.1, .2}), lambertian("a", {.1, .2}, {0, 0}));
    EXPECT_EQ(lambertian("a", {.1}, {.3}).upper, lambertian("b", {.1}, {.3}).lower);
    EXPECT_NE(error_of([] { return lambertian("a", {.1, .2}, {.1}); }), "");
}

TEST(Run, TakesItsDefaultsInAnyForm) {
    const Scene scene = builder_of_leaves().build();
    const Sources sources{make_uniform_sky("sky", {100, 50})};
    const RunSpec spec{.paths = 64};
    EXPECT_EQ(spec.method, Method::automatic);
    const Result result = run(scene, sources, spec, {});
    EXPECT_EQ(
        bits(run(scene, sources, spec).at(0, Quantity::absorbed_flux, 0)),
        bits(result.at(0, Quantity::absorbed_flux, 0)));
}

}  // namespace
}  // namespace quasimc::test
