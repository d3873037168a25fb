// The light of a stand on all shapes of a plant.

#include "coupling/plants/light_on_stand.h"

#include <bit>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/plants/plant_organs.h"
#include "coupling_testing.h"
#include "growth/plant.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

/// A small leaf above a large one, both flat, and queries for them and for a module without shapes.
const std::string kTwoLeaves =
    "Lsystem: 1\nderivation length: 2\n"
    "axiom: ?E(0)f(1)[^(90)?E(0,5)L]?E(7)f(1)[^(90)?E(0,5)U]?E(-1)U?E\n"
    "homomorphism\nL --> @o(4)\nU --> @o(2)\nendlsystem\n";

/// Black leaves without a ground.
SceneBuilder black_stand(UpAxis up = UpAxis::z) {
    SceneBuilder stand({{"PAR"}}, {up, up == UpAxis::z ? Vec3{0, 1, 0} : Vec3{1, 0, 0}});
    stand.add_material(lambertian("leaf", {0}));
    return stand;
}

StandLight zenith(std::size_t bands = 1) {
    return {
        {make_directional_source("zenith", {0, 0, -1}, std::vector<double>(bands, 100))},
        {.paths = 4096, .replicates = 4}};
}

/// A plant and what it needs.
class GrownOnStand {
  public:
    explicit GrownOnStand(PlantEnvironment& light, const std::string& text = kTwoLeaves)
        : plant_(
              PlantModel::read(folder_.write("model.l", text).string(), "", recorded_.notices),
              &light,
              recorded_.notices) {}

    /// The string after one more step.
    std::string next() {
        plant_.grow();
        return plant_.string().text();
    }
    [[nodiscard]] Plant& plant() { return plant_; }

  private:
    TemporaryFolder folder_;
    RecordedNotices recorded_;
    Plant plant_;
};

double absorbed_density(const LightOnStand& light, std::size_t query, std::size_t band = 0) {
    return light.result()
        ->at(light.queried()[query].value(), Quantity::absorbed_flux_density, band)
        .mean;
}

std::vector<std::uint64_t> bits_of(const Result& result) {
    std::vector<std::uint64_t> bits;
    for (const Estimate& e : result.values) {
        for (const double number : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
            bits.push_back(std::bit_cast<std::uint64_t>(number));
        }
    }
    return bits;
}

TEST(LightOnStand, AnswersWithTheLightOnTheNextModule) {
    LightOnStand light(black_stand(), zenith(), {});
    GrownOnStand grown(light);
    const std::string text = grown.next();
    for (const std::size_t query : {1U, 3U}) {
        const double density = absorbed_density(light, query);
        const std::string answer = fmt::format("?E({:g},5){}", density, query == 1 ? "L" : "U");
        EXPECT_NE(text.find(answer), std::string::npos) << text;
    }
    EXPECT_NE(text.find("?E(7)f(1)"), std::string::npos) << text;
    EXPECT_NE(text.find("?E(-1)U?E"), std::string::npos) << text;
    ASSERT_EQ(light.queried().size(), 6U);
    EXPECT_FALSE(light.queried()[0]);
    // The upper leaf has a quarter of the area of the lower one.
    EXPECT_NEAR(absorbed_density(light, 1), 75, 0.1);
    EXPECT_NEAR(absorbed_density(light, 3), 100, 0.05);
}

TEST(LightOnStand, HasTheBitsOfASceneOfTheSameOrgans) {
    for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
        LightOnStand light(black_stand(up), zenith(), {});
        GrownOnStand grown(light);
        grown.next();
        grown.next();
        MeshDrawing drawing(8);
        grown.plant().draw(drawing);
        SceneBuilder builder = black_stand(UpAxis::y);
        for (OrganSpec& organ : plant_organs(drawing, 1)) {
            for (OrganPart& part : organ.parts) {
                part.material = "leaf";
            }
            builder.add_organ(organ);
        }
        StandLight alone = zenith();
        alone.spec.seed += 1;
        const Result result = run(builder.build(), alone.sources, alone.spec);
        EXPECT_EQ(bits_of(result), bits_of(*light.result()));
        EXPECT_EQ(light.pass_step(), 1);
    }
}

TEST(LightOnStand, LabelsOrgansAndKeepsThoseOfTheStand) {
    SceneBuilder stand = black_stand();
    stand.add_organ({.id = 3, .parts = {{"leaf", {{Vec3{9, 9, 9}, {10, 9, 9}, {9, 10, 9}}}}}});
    stand.set_ground({.material = "leaf", .extent = {{-20, -20, 20, 20}}});
    LightOnStand light(std::move(stand), zenith(), {});
    GrownOnStand grown(light);
    grown.next();
    grown.next();
    const std::vector<Organ>& organs = light.scene()->organs();
    ASSERT_EQ(organs.size(), 5U);
    EXPECT_EQ(organs[0].id, 3);
    const Organ& lower = organs[light.queried()[1].value()];
    EXPECT_EQ(lower.id, 3 + 8);
    EXPECT_EQ(lower.name, "L 8");
    const Labels labels{{"module", "L"}, {"step", "1"}, {"branch", "1"}, {"order", "1"}};
    EXPECT_EQ(lower.labels, labels);
    EXPECT_NEAR(absorbed_density(light, 1), 75, 0.2);
}

TEST(LightOnStand, GivesModulesTheirMaterialsAndBandsTheirParameters) {
    SceneBuilder stand({{"R"}, {"FR"}});
    stand.add_material(lambertian("first", {0, 0}));
    stand.add_material(lambertian("U", {0.5, 0.25}));
    stand.add_material(lambertian("given", {0.75, 0}));
    LightOnStand light(
        std::move(stand), zenith(2),
        {.materials = {{'L', "given"}}, .quantity = Quantity::absorbed_flux_density});
    GrownOnStand grown(light);
    grown.next();
    std::map<std::string, std::string> materials;
    for (const Organ& organ : light.scene()->organs()) {
        materials[organ.name.substr(0, 1)] =
            light.scene()->material_name(light.scene()->regions()[organ.first_region]);
    }
    const std::map<std::string, std::string> expected{{"L", "given"}, {"U", "U"}};
    EXPECT_EQ(materials, expected);
    EXPECT_NEAR(absorbed_density(light, 3, 1), 75, 1);
}

TEST(LightOnStand, RefusesMaterialsThatTheStandLacks) {
    EXPECT_THROW(LightOnStand(SceneBuilder({{"PAR"}}), zenith(), {}), InputError);
    try {
        const LightOnStand light(
            black_stand(), zenith(), {.materials = {{'L', "lief"}}, .default_material = "stem"});
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().size(), 2U);
    }
}

TEST(LightOnStand, HasNoLightWithoutShapes) {
    LightOnStand light(black_stand(), zenith(), {});
    GrownOnStand grown(
        light,
        "Lsystem: 1\nderivation length: 3\naxiom: ?E(3)f(1)\nf(x) --> f(x)F(1)\nendlsystem\n");
    EXPECT_EQ(grown.next(), "?E(3)f(1)F(1)");
    EXPECT_EQ(light.scene(), nullptr);
    EXPECT_TRUE(light.warnings().empty());
    grown.next();
    ASSERT_NE(light.scene(), nullptr);
    EXPECT_EQ(light.scene()->organs().size(), 1U);
}

TEST(LightOnStand, StopsWithTheRun) {
    std::stop_source stop;
    stop.request_stop();
    LightOnStand light(
        black_stand(), zenith(), {.control = [&] { return RunControl{.stop = stop.get_token()}; }});
    GrownOnStand grown(light);
    EXPECT_THROW(grown.next(), Stopped);
}

}  // namespace
}  // namespace quasimc::test
