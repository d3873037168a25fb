// A document read in two parts, as programs do that keep a scene and change the light on it.

#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "runfile/run_file.h"

namespace quasimc::test {
namespace {

constexpr std::string_view kBandsOfParts = "bands = [\"PAR\"]\n";
constexpr std::string_view kLightPart =
    "[run]\npaths = 512\n[[source]]\ntype = \"uniform_sky\"\nirradiance_horizontal = 10\n";
constexpr std::string_view kScenePart =
    "[[material]]\nname = \"leaf\"\nreflectance = 0.1\n[[organ]]\nmaterial = \"leaf\"\n"
    "shape = \"disk\"\ncenter = [0, 0, 1]\nnormal = [0, 0, 1]\nradius = 0.1\n";

class RunPartsTest : public ::testing::Test {
  protected:
    static Node document(std::string_view light, std::string_view bodies) {
        std::string text(kBandsOfParts);
        text += light;
        text += bodies;
        text += "[output]\ncsv = \"leaf.csv\"\n";
        return read_toml(text, "run.toml");
    }
    SceneOfRun scene_of(const Node& node) { return read_scene_document(node, "run.toml", files_); }

    InputFiles files_{"."};
};

TEST_F(RunPartsTest, GiveWhatTheWholeDocumentGives) {
    const Node both = document(kLightPart, kScenePart);
    const SceneOfRun bodies = scene_of(both);
    const LightOfRun light = read_light_document(both, "run.toml", files_, bodies.scene);
    const RunFile whole = read_run_document(both, "run.toml", files_);
    EXPECT_EQ(light.spec.paths, 512U);
    EXPECT_EQ(light.source_notes, whole.source_notes);
    const Result apart = run(bodies.scene, light.sources, light.spec);
    const Result together = run(whole.scene, whole.sources, whole.spec);
    EXPECT_EQ(
        apart.at(0, Quantity::absorbed_flux, 0).mean,
        together.at(0, Quantity::absorbed_flux, 0).mean);
    EXPECT_GT(apart.at(0, Quantity::absorbed_flux, 0).mean, 0);
}

TEST_F(RunPartsTest, PassOverTheFaultsOfEachOther) {
    const std::string bad_light = std::string(kLightPart) + "shine = 3\n";
    EXPECT_EQ(scene_of(document(bad_light, kScenePart)).scene.organs().size(), 1U);
    const Scene scene = scene_of(document(kLightPart, kScenePart)).scene;
    const Node bad_bodies = document(kLightPart, "[[material]]\nshine = 3\n");
    EXPECT_EQ(read_light_document(bad_bodies, "run.toml", files_, scene).sources.size(), 1U);
}

TEST_F(RunPartsTest, ReportTheirOwnFaultsWithTheirLines) {
    const Scene scene = scene_of(document(kLightPart, kScenePart)).scene;
    try {
        const std::string bad_light = std::string(kLightPart) + "shine = 3\n";
        static_cast<void>(
            read_light_document(document(bad_light, kScenePart), "run.toml", files_, scene));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().at(0).where, "run.toml:7");
    }
    EXPECT_THROW(
        static_cast<void>(scene_of(document(kLightPart, "[[material]]\nshine = 3\n"))), InputError);
}

TEST_F(RunPartsTest, TakeOrgansOfAProgram) {
    OrganSpec leaf;
    leaf.name = "given";
    leaf.parts.push_back({"leaf", make_triangle({0, 0, 2}, {1, 0, 2}, {0, 1, 2})});
    const auto add = [&](SceneBuilder& builder) { builder.add_organ(leaf); };
    const Node both = document(kLightPart, kScenePart);
    const Scene scene = read_scene_document(both, "run.toml", files_, add).scene;
    EXPECT_EQ(scene.organs().at(1).name, "given");
    SceneBuilder frame = read_frame_document(both, "run.toml", files_).builder;
    add(frame);
    EXPECT_EQ(std::move(frame).build().organs().size(), 2U);
}

}  // namespace
}  // namespace quasimc::test
