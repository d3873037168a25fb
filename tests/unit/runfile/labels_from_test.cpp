// Labels from the names in a geometry file.

#include <gtest/gtest.h>

#include "runfile/name_pattern.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Found = std::optional<Labels>;

TEST(NamePatterns, TakeKeysOutOfNames) {
    const NamePattern pattern("tree{tree}_layer{layer}");
    EXPECT_EQ(pattern.match("tree1_layer2"), Found(Labels{{"tree", "1"}, {"layer", "2"}}));
    EXPECT_EQ(pattern.match("tree1_layer2/leaf14"), pattern.match("tree1_layer2"));
    EXPECT_EQ(pattern.match("tree_layer2"), std::nullopt);
    EXPECT_EQ(pattern.match("a/tree1_layer2"), std::nullopt);
    EXPECT_EQ(pattern.match("tree1_layer"), std::nullopt);
}

TEST(NamePatterns, KeysEndAtTheNextTextOrPart) {
    EXPECT_EQ(NamePattern("{a}_{b}").match("1_2_3"), Found(Labels{{"a", "1"}, {"b", "2_3"}}));
    EXPECT_EQ(NamePattern("{a}_x").match("1_x_x"), Found(Labels{{"a", "1_x"}}));
    EXPECT_EQ(NamePattern("*/leaf{leaf}").match("tree/leaf7"), Found(Labels{{"leaf", "7"}}));
    EXPECT_EQ(NamePattern("*/leaf{leaf}").match("leaf7"), std::nullopt);
    EXPECT_EQ(NamePattern("*leaf{leaf}").match("leaf7"), Found(Labels{{"leaf", "7"}}));
    EXPECT_EQ(NamePattern("{plant}").match("p/q"), Found(Labels{{"plant", "p"}}));
    EXPECT_EQ(NamePattern("{a}/{b}").match("p/q/r"), Found(Labels{{"a", "p"}, {"b", "q"}}));
}

TEST(NamePatterns, RefuseWhatIsNotUnique) {
    for (const std::string text : {"{a}{b}", "{a}*", "*{a}", "{a}_{a}", "tree", "{}", "tree{"}) {
        EXPECT_THROW(NamePattern{text}, InputError) << text;
    }
}

const std::string kTrees =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "o tree01_layer1\ng leaf1\nf 1 2 3\ng leaf2\nf 1 2 4\n"
    "o tree02_layer2\n# label kind = shoot\ng leaf1\nf 1 3 4\n"
    "o post\nf 2 3 4\n";

RunText with_trees(const std::string& keys) {
    RunText text;
    text.organs = "[[geometry]]\nname = 'trees'\nmaterial = 'leaf'\nfile = 'trees.obj'\n" + keys;
    return text;
}

const FakeFiles kTreeFiles{
    {"trees.obj", kTrees},
    {"names.csv", "name,tree,kind\ntree01_layer1/leaf2,1,top\ntree01_layer1,1,leaf\npost,,post\n"},
    {"no_names.csv", "organ,tree\npost,1\n"}};

TEST(LabelsFrom, APatternLabelsOrgansByTheirNames) {
    const RunFile run =
        read_text(with_trees("labels_from = 'tree{tree}_layer{layer}'\n").text(), kTreeFiles);
    const auto& organs = run.scene.organs();
    ASSERT_EQ(organs.size(), 4U);
    // All values are whole numbers, so they are integers.
    EXPECT_EQ(organs[1].labels, (Labels{{"tree", "1"}, {"layer", "1"}}));
    EXPECT_EQ(organs[2].labels, (Labels{{"tree", "2"}, {"layer", "2"}, {"kind", "shoot"}}));
    EXPECT_TRUE(organs[3].labels.empty());
    ASSERT_EQ(run.warnings.size(), 1U);
    EXPECT_EQ(
        run.warnings[0].text,
        "geometry 'trees': 1 of 4 names do not fit labels_from and have no such labels (first: "
        "'post')");
}

TEST(LabelsFrom, TheFirstPatternThatFitsCounts) {
    const RunFile run = read_text(
        with_trees("labels_from = ['tree{tree}_*/leaf{leaf}', '{kind}']\norgans = 'each'\n"
                   "labels = { plot = 'A' }\n")
            .text(),
        kTreeFiles);
    const auto& organs = run.scene.organs();
    ASSERT_EQ(organs.size(), 4U);
    EXPECT_EQ(organs[0].labels, (Labels{{"plot", "A"}, {"tree", "1"}, {"leaf", "1"}}));
    EXPECT_EQ(organs[3].labels, (Labels{{"plot", "A"}, {"kind", "post"}}));
    EXPECT_TRUE(run.warnings.empty());
}

TEST(LabelsFrom, ATableHasWholeNamesOrTheirFirstParts) {
    const RunFile run =
        read_text(with_trees("labels_from = { file = 'names.csv' }\n").text(), kTreeFiles);
    const auto& organs = run.scene.organs();
    ASSERT_EQ(organs.size(), 4U);
    EXPECT_EQ(organs[0].labels, (Labels{{"tree", "1"}, {"kind", "leaf"}}));
    EXPECT_EQ(organs[1].labels, (Labels{{"tree", "1"}, {"kind", "top"}}));
    EXPECT_EQ(organs[2].labels, (Labels{{"kind", "shoot"}}));
    EXPECT_EQ(organs[3].labels, (Labels{{"kind", "post"}}));
}

TEST(LabelsFrom, NodesOfGltfHavePaths) {
    const std::string gltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"tree7","children":[1]},{"name":"leaf3","mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    RunText text;
    text.organs =
        "[[geometry]]\nmaterial = 'leaf'\nfile = 'a.gltf'\nlabels_from = 'tree{tree}/leaf{leaf}'\n";
    const RunFile run = read_text(text.text(), {{"a.gltf", gltf}});
    const Labels& labels = run.scene.organs()[0].labels;
    ASSERT_GE(labels.size(), 2U);
    EXPECT_EQ(labels[0].second, "7");
    EXPECT_EQ(labels[1].second, "3");
}

TEST(LabelsFrom, FaultsSayWhatToDo) {
    const std::vector<std::pair<std::string, std::string>> table{
        {"labels_from = 'oak{tree}'",
         "run.toml:13: geometry 'trees': labels_from 'oak{tree}' fits none of 4 names (first: "
         "'tree01_layer1/leaf1', 'tree01_layer1/leaf2', 'tree02_layer2/leaf1'); patterns are "
         "compared from the start"},
        {"labels_from = '{a}{b}'",
         "geometry 'trees': labels_from: '{a}{b}' has nothing between two keys; put the text that "
         "parts them"},
        {"labels = { tree = 1 }\nlabels_from = 'tree{tree}_*'",
         "geometry 'trees': the label 'tree' is in labels and in labels_from; keep one"},
        {"at = [{ x = 0, y = 0, tree = 1 }]\nlabels_from = 'tree{tree}_*'",
         "the label 'tree' is in at and in labels_from; keep one"},
        {"organs = 'one'\nlabels_from = 'tree{tree}_*'", "labels_from with organs = \"one\""},
        {"labels_from = 3", "labels_from has an integer"},
        {"labels_from = []", "labels_from has no pattern"},
        {"labels_from = ['tree{tree}_*', 3]", "labels_from has an integer"},
        {"labels_from = { file = 'no_names.csv' }",
         "no_names.csv:1: there is no column 'name' (columns are organ, tree)"},
        {"labels_from = { table = 'names.csv' }", "file is missing"}};
    for (const auto& [keys, problem] : table) {
        const auto faults = faults_of(with_trees(keys + "\n").text(), kTreeFiles);
        EXPECT_TRUE(mentions(faults, problem)) << keys << ::testing::PrintToString(faults);
    }
}

}  // namespace
}  // namespace quasimc::test
