#include <limits>

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

SceneBuilder builder_of_a_leaf() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    return builder;
}

/// What building a scene with such detectors says.
std::string faults_of_building(std::vector<DetectorSpec> detectors) {
    SceneBuilder builder = builder_of_a_leaf();
    for (DetectorSpec& detector : detectors) {
        builder.add_detector(std::move(detector));
    }
    try {
        static_cast<void>(std::move(builder).build());
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

DetectorSpec rings_named(double rings, std::string name = {}) {
    return {.type = "escaped_by_zenith", .name = std::move(name), .parameters = {{"rings", rings}}};
}

testing::AssertionResult mentions(const std::string& text, const std::string& part) {
    return (text.find(part) != std::string::npos ? testing::AssertionSuccess()
                                                 : testing::AssertionFailure())
           << "'" << part << "' in: " << text;
}

TEST(CheckDetectors, FindsNothingInGoodOnes) {
    EXPECT_EQ(
        faults_of_building(
            {rings_named(1, "a"), rings_named(180, "b"), {.type = "escaped_by_zenith"}}),
        "");
}

TEST(CheckDetectors, NamesADetectorByItsType) {
    SceneBuilder builder = builder_of_a_leaf();
    builder.add_detector({.type = "escaped_by_zenith"});
    const Scene scene = std::move(builder).build();
    ASSERT_EQ(scene.detectors().size(), 1U);
    EXPECT_EQ(scene.detectors()[0].name, "escaped_by_zenith");
}

TEST(CheckDetectors, FindsEachFaultAndSaysWhere) {
    EXPECT_TRUE(mentions(
        faults_of_building({{.type = "escaped_by_zenit", .where = "run.toml:7"}}),
        "run.toml:7: no detector 'escaped_by_zenit'; did you mean 'escaped_by_zenith'?"));
    EXPECT_TRUE(mentions(
        faults_of_building({{.type = "escaped_by_zenith", .parameters = {{"rigs", 3}}}}),
        "detector 'escaped_by_zenith': escaped_by_zenith takes no 'rigs'; did you mean 'rings'?"));
    for (const double wrong : {0.0, 181.0, 2.5, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_TRUE(mentions(faults_of_building({rings_named(wrong)}), "rings is ")) << wrong;
    }
    EXPECT_TRUE(mentions(
        faults_of_building({rings_named(3, "a"), rings_named(4, "a")}),
        "detector 'a' exists already"));
}

}  // namespace
}  // namespace quasimc::test
