// Copies by `at`, in its four forms, of organs, files and lamps.

#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "light/models/source.h"
#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

const std::string kTriangle = "0 0 0 1 0 0 0 1 0\n";

RunText copied_file(const std::string& keys) {
    RunText text;
    text.organs = "[[geometry]]\nmaterial = 'leaf'\nfile = 'a.tri'\norgans = 'one'\n" + keys;
    return text;
}

RunText copied_organ(const std::string& keys) {
    RunText text;
    text.organs =
        "[[organ]]\nmaterial = 'leaf'\nshape = 'triangle'\n"
        "corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n" +
        keys;
    return text;
}

/// The corners of an organ's first triangle, file's axes.
Triangle corners_of(const Scene& scene, std::size_t organ) {
    Triangle triangle = scene.triangles_of(scene.organs().at(organ)).front();
    for (Vec3& corner : triangle) {
        corner = scene.orientation().outward(corner);
    }
    return triangle;
}

void expect_point(const Vec3& a, const Vec3& b) {
    EXPECT_LT(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(Copies, TwoNumbersAreHorizontal) {
    const Scene z_up = read_text(copied_organ("at = [[3, 4]]\n").text()).scene;
    expect_point(corners_of(z_up, 0)[0], {3, 4, 0});
    RunText text = copied_organ("at = [[3, 4]]\n");
    text.top += "up = 'y'\n";
    expect_point(corners_of(read_text(text.text()).scene, 0)[0], {3, 0, 4});
}

TEST(Copies, RowsAreTurnedAndLabelled) {
    const Scene scene =
        read_text(
            copied_organ("name = 'panel'\nlabels = { kind = 'panel', number = '{copy}' }\n"
                         "at = [{ x = 0, y = 1, tilt_deg = 30, heading_deg = 180, row = 7 },\n"
                         "{ x = 5, y = 0, z = 2, scale = 2, name = 'big', row = 8 }]\n")
                .text())
            .scene;
    ASSERT_EQ(scene.organs().size(), 2U);
    const Vec3 normal = normalized(area_vector(corners_of(scene, 0)));
    expect_point(normal, {0, -0.5, std::sqrt(3) / 2});  // faces south
    expect_point(corners_of(scene, 1)[1], {7, 0, 2});
    EXPECT_EQ(scene.organs()[0].name, "panel 1");
    EXPECT_EQ(scene.organs()[1].name, "big");
    EXPECT_EQ(scene.organs()[1].labels, (Labels{{"kind", "panel"}, {"number", "2"}, {"row", "8"}}));
}

/// Roll, then tilt towards north, then heading: checked on the images of the axes.
TEST(Copies, RollComesBeforeTiltAndHeading) {
    for (const std::string up : {"z", "y"}) {
        RunText text = copied_organ(
            "at = [{ x = 0, y = 0, z = 0, roll_deg = 90, tilt_deg = 90, heading_deg = 90 }]\n");
        text.top += "up = '" + up + "'\n";
        const Scene scene = read_text(text.text()).scene;
        const Triangle corners = corners_of(scene, 0);
        const auto world = [&](const Vec3& p) { return scene.orientation().inward(p); };
        const auto moved = [&](const Vec3& start) {
            // Clockwise by 90 degrees: north to east, east to south.
            const Vec3 rolled{start.y, -start.x, start.z};
            const Vec3 tilted{rolled.x, rolled.z, -rolled.y};  // up to north, north to down
            return Vec3{tilted.y, -tilted.x, tilted.z};
        };
        expect_point(world(corners[1]), moved(world({1, 0, 0})));
        expect_point(world(corners[2]), moved(world({0, 1, 0})));
    }
}

TEST(Copies, ATableOfCopiesNamesFilesAndLabels) {
    const std::string plot =
        "# a comment\neast;north;heading_deg;type;tree;species\n0;0;0;1;11;beech\n"
        "5;0;90;2;12;beech\n9;9;0;1;13;oak\n5;5;0;1;14;beech\n";
    RunText text;
    text.organs =
        "[[geometry]]\nmaterial = 'leaf'\nfile = 'tree{type}.tri'\norgans = 'one'\n"
        "name = '{species} {tree}'\n"
        "at = { file = 'plot.csv', where = \"species == 'beech'\", "
        "columns = { x = 'east', y = 'north' } }\n";
    const RunFile run = read_text(
        text.text(),
        {{"plot.csv", plot}, {"tree1.tri", kTriangle}, {"tree2.tri", "0 0 0 2 0 0 0 2 0\n"}});
    const auto& organs = run.scene.organs();
    ASSERT_EQ(organs.size(), 3U);
    EXPECT_EQ(organs[0].name, "beech 11");
    EXPECT_EQ(organs[1].labels, (Labels{{"tree", "12"}, {"species", "beech"}}));
    EXPECT_EQ(organs[0].area, 0.5);
    EXPECT_EQ(organs[1].area, 2);
    EXPECT_EQ(organs[2].area, 0.5);
    expect_point(corners_of(run.scene, 1)[1], {5, -2, 0});
    EXPECT_EQ(run.inputs.size(), 3U) << "each file is read once";
}

TEST(Copies, AnArrayHasCopiesInTheCentresOfItsParts) {
    const Scene scene = read_text(
                            copied_file("name = 'p'\nlabels = { row = '{j}', at = '{i}' }\n"
                                        "at = { start = [1, 0, 0], along = [8, 0, 0], "
                                        "across = [0, 6, 0], counts = [4, 3] }\n")
                                .text(),
                            {{"a.tri", kTriangle}})
                            .scene;
    ASSERT_EQ(scene.organs().size(), 12U);
    expect_point(corners_of(scene, 0)[0], {2, 1, 0});
    expect_point(corners_of(scene, 1)[0], {4, 1, 0});
    expect_point(corners_of(scene, 11)[0], {8, 5, 0});
    EXPECT_EQ(scene.organs()[5].labels, (Labels{{"row", "2"}, {"at", "2"}}));
    const Scene line =
        read_text(
            copied_file("at = { start = [0, 5, 0], along = [0, 0, 3], counts = 3 }\n").text(),
            {{"a.tri", kTriangle}})
            .scene;
    expect_point(corners_of(line, 2)[0], {0, 5, 2.5});
}

Scene spread_scene(const std::string& name, const std::string& run = "") {
    RunText text = copied_file(
        "name = '" + name +
        "'\nat = { start = [0, 0, 0], along = [1000, 0, 0], counts = 100, "
        "spread = { y = 0.5, heading_deg = 180 } }\n");
    text.run = run;
    return read_text(text.text(), {{"a.tri", kTriangle}}).scene;
}

TEST(Copies, SpreadDependsOnTheNameAndNotOnTheSeed) {
    const Scene scene = spread_scene("a");
    const Scene other_seed = spread_scene("a", "[run]\nseed = 9\n");
    const Scene other_name = spread_scene("b");
    double sum = 0, square = 0;
    std::set<double> values;
    for (std::size_t i = 0; i < 100; ++i) {
        const Vec3 p = corners_of(scene, i)[0];
        EXPECT_EQ(p, corners_of(other_seed, i)[0]);
        EXPECT_NE(p, corners_of(other_name, i)[0]);
        EXPECT_LE(std::abs(p.y), 0.5);
        EXPECT_NEAR(p.x, 10 * static_cast<double>(i) + 5, 1e-9);
        sum += p.y;
        square += p.y * p.y;
        values.insert(p.y);
    }
    EXPECT_EQ(values.size(), 100U);
    // Uniform in [-0.5, 0.5]: mean 0 +- 0.029, mean square 1/12 +- 0.0075; five sigma.
    EXPECT_NEAR(sum / 100, 0, 0.145);
    EXPECT_NEAR(square / 100, 1. / 12, 0.038);
}

TEST(Copies, HeightsCountFromTheGround) {
    RunText flat = copied_organ(
        "at = { start = [0, 0, 1], along = [2, 0, 0], counts = 2, above_ground = true }\n");
    flat.rest = "[ground]\nmaterial = 'leaf'\nheight = 3\nx = [-9, 9]\ny = [-9, 9]\n";
    expect_point(corners_of(read_text(flat.text()).scene, 1)[0], {1.5, 0, 4});
    RunText slope = flat;
    slope.rest = "[ground]\nmaterial = 'leaf'\nfile = 'slope.tri'\n";
    const FakeFiles files{{"slope.tri", "-9 -9 -9 9 -9 9 0 9 0\n"}};  // z = x
    expect_point(corners_of(read_text(slope.text(), files).scene, 1)[0], {1.5, 0, 2.5});
    const FakeFiles small{{"slope.tri", "-9 -9 -9 0 -9 0 0 9 0\n"}};
    EXPECT_TRUE(mentions(faults_of(slope.text(), small), "at: copy 1 is not above the ground"));
    flat.rest = "";
    EXPECT_TRUE(mentions(faults_of(flat.text()), "needs a ground"));
}

TEST(Copies, AnOrganKeepsItsMeshOnceAndCountsItsIds) {
    const Scene scene =
        read_text(copied_organ("id = 5\nmeasured = false\nat = [[0, 0], [3, 0]]\n").text()).scene;
    ASSERT_EQ(scene.organs().size(), 2U);
    EXPECT_EQ(scene.organs()[1].id, 6);
    EXPECT_FALSE(scene.organs()[1].measured);
}

TEST(Copies, GeometryAndGroundNeedNotBeMeasured) {
    RunText text = copied_file("measured = false\n");
    text.rest =
        "[ground]\nmaterial = 'leaf'\nmeasured = false\n[[organ]]\nmaterial = 'leaf'\n"
        "shape = 'disk'\ncenter = [0, 0, 2]\nnormal = [0, 0, 1]\nradius = 1\n";
    const Scene scene = read_text(text.text(), {{"a.tri", kTriangle}}).scene;
    ASSERT_EQ(scene.organs().size(), 3U);
    EXPECT_TRUE(scene.organs()[0].measured);
    EXPECT_FALSE(scene.organs()[1].measured);
    EXPECT_FALSE(scene.organs()[2].measured);
}

struct BadCopies {
    std::string keys, problem;
};

TEST(Copies, FaultsSayWhatToDo) {
    const std::vector<BadCopies> table{
        {"at = { start = [0, 0, 0], along = [1, 0, 0], counts = [4, 3] }",
         "counts has 2 numbers but there is no across; give across, or one number"},
        {"at = { start = [0, 0, 0], along = [1, 0, 0], across = [0, 1, 0], counts = 4 }",
         "counts is one number but there is across"},
        {"at = { start = [0, 0, 0], along = [1, 0, 0], counts = 0 }", "counts is 0"},
        {"at = { start = [0, 0, 0], along = [1, 0, 0], across = [0, 1, 0], counts = [1, 2, 3] }",
         "counts is not a number of copies"},
        {"at = { start = [0, 0, 0], counts = 2 }", "along is missing"},
        {"at = { start = [0, 0, 0], along = [1, 0, 0], counts = 2, spread = { scale = 1 } }",
         "scale is 1 (it must be 0 to 0.99)"},
        {"at = { start = [0, 0, 0], along = [1, 0, 0], counts = 2, spread = { turn = 1 } }",
         "unknown key 'turn'"},
        {"at = { start = [0, 0, 0], along = [1, 0, 0], count = 2 }", "unknown key 'count'"},
        {"at = [{ x = 1 }]", "y is missing"},
        {"at = [{ x = 1, y = 'a' }]", "y is a text"},
        {"at = [{ x = 1, y = 1, scale = 0 }]", "the scale of a copy is 0"},
        {"at = [{ x = 1, y = 1, row = [1] }]", "label row is a list"},
        {"name = 'tree {row}'\nat = [{ x = 1, y = 1, rov = 1 }]",
         "name: copy 1 has no 'row' (it has copy, rov); did you mean 'rov'?"},
        {"labels = { row = 1 }\nat = [{ x = 1, y = 1, row = 1 }]",
         "the label 'row' is in labels and in at; keep one"},
        {"at = { file = 'plot.csv' }",
         "plot.csv:1: there is no column 'x' (columns are X, Y, species, scale); say which: "
         "columns = { x = \"X\", y = \"Y\" }"},
        {"at = { file = 'plot.csv', columns = { x = 'X', y = 'YY' } }",
         "there is no column 'YY' (columns are X, Y, species, scale)"},
        {"at = { file = 'plot.csv', columns = { x = 'X', y = 'Y' } }",
         "plot.csv:3: scale is 0 (it must be above 0); a copy without a size can be left out by "
         "where"},
        {"at = { file = 'plot.csv', where = \"specis == 'oak'\", columns = { x = 'X', y = 'Y' } }",
         "where: unknown column 'specis' in \"specis == 'oak'\""},
        {"at = { file = 'plot.csv', where = \"species = 'oak'\", columns = { x = 'X', y = 'Y' } }",
         "'=' sets nothing here; compare with '=='"},
        {"at = { file = 'plot.csv', where = \"species == 'elm'\", columns = { x = 'X', y = 'Y' } }",
         "where fits no row of plot.csv"},
        {"at = { file = 'short.csv' }", "short.csv:2: 1 field (the header has 2)"},
        {"at = { file = 'twice.csv' }", "there are two columns 'x'"},
        {"at = { file = 'empty.csv' }", "it is empty"},
        {"at = { file = 'text.csv' }", "text.csv:2: y is 'a' (it must be a finite number)"},
        {"at = { file = 'none.csv' }", "file 'none.csv' can't be read"}};
    const FakeFiles files{
        {"a.tri", kTriangle},         {"plot.csv", "X,Y,species,scale\n0,0,oak,1\n1,1,beech,0\n"},
        {"short.csv", "x,y\n1\n"},    {"twice.csv", "x,x,y\n1,1,1\n"},
        {"empty.csv", "# nothing\n"}, {"text.csv", "x,y\n1,a\n"}};
    for (const BadCopies& bad : table) {
        const auto faults = faults_of(copied_file(bad.keys + "\n").text(), files);
        EXPECT_TRUE(mentions(faults, bad.problem)) << bad.keys << ::testing::PrintToString(faults);
    }
    const std::string without_empty =
        "at = { file = 'plot.csv', where = 'scale > 0', columns = { x = 'X', y = 'Y' } }\n";
    EXPECT_TRUE(faults_of(copied_file(without_empty).text(), files).empty());
}

TEST(Copies, AFaultInAtIsNoFaultOfFiles) {
    RunText text =
        copied_file("format = 'tri'\nat = [{ x = 0, y = 0, type = 1 }, { x = 1, y = 0 }]\n");
    text.organs.replace(text.organs.find("a.tri"), 5, "{type}.tri");
    const auto faults = faults_of(text.text(), {{"1.tri", kTriangle}});
    EXPECT_EQ(faults.size(), 1U) << ::testing::PrintToString(faults);
    EXPECT_TRUE(mentions(faults, "file: copy 2 has no 'type' (it has copy)"));
}

TEST(Copies, ACopyNeedsItsFile) {
    RunText text = copied_file("at = [{ x = 0, y = 0, type = 1 }, { x = 1, y = 0, type = 2 }]\n");
    text.organs.replace(text.organs.find("a.tri"), 5, "{type}.tri");
    EXPECT_TRUE(mentions(faults_of(text.text(), {{"1.tri", kTriangle}}), "file '2.tri'"));
}

// Lamps.

RunText with_copied_lamp(const std::string& keys) {
    RunText text;
    text.sources = "[[source]]\n" + keys;
    return text;
}

TEST(LampCopies, HaveNamesPositionsAndFluxesOfTheirOwn) {
    const RunFile run =
        read_text(with_copied_lamp("type = 'spot'\nname = 'hps'\ncone_deg = 60\npower = 10\n"
                                   "at = [{ x = 1, y = 2, z = 3, tilt_deg = 90 },\n"
                                   "{ x = 0, y = 0, z = 3, power = 20, name = 'bright' }]\n")
                      .text());
    ASSERT_EQ(run.sources.size(), 2U);
    EXPECT_EQ(run.sources[0]->name(), "hps 1");
    EXPECT_EQ(run.sources[1]->name(), "bright");
    EXPECT_EQ(run.sources[0]->spectrum()[0], 10);
    EXPECT_EQ(run.sources[1]->spectrum()[0], 20);
    // Down leans towards south when up leans towards north.
    EXPECT_EQ(
        run.source_notes[0],
        "hps 1: spot lamp at (1, 2, 3), aimed along (0, -1, 0); emits PAR 10 W");
}

TEST(LampCopies, AnArrayOfTubesIsMovedAsAWhole) {
    const RunFile run =
        read_text(with_copied_lamp("type = 'line'\nfrom = [-1, 0, 0]\nto = [1, 0, 0]\npower = 1\n"
                                   "at = { start = [0, 0, 2], along = [0, 4, 0], counts = 2 }\n")
                      .text());
    ASSERT_EQ(run.sources.size(), 2U);
    EXPECT_EQ(run.sources[1]->name(), "line 2");
    EXPECT_NE(run.source_notes[1].find("at (0, 3, 2)"), std::string::npos) << run.source_notes[1];
}

TEST(LampCopies, AFileOfLampsHasFluxesAsNumbers) {
    const RunFile run = read_text(
        with_copied_lamp("type = 'point'\npower = 1\nat = { file = 'lamps.csv' }\n").text(),
        {{"lamps.csv", "x,y,z,power,name\n0,0,2,30,left\n1,0,2,40,right\n"}});
    ASSERT_EQ(run.sources.size(), 2U);
    EXPECT_EQ(run.sources[1]->spectrum()[0], 40);
    EXPECT_EQ(run.sources[1]->name(), "right");
}

TEST(LampCopies, FaultsAreReportedOnce) {
    const std::string point = "type = 'point'\n";
    const std::vector<BadCopies> table{
        {point + "power = 1\nat = [{ x = 0, y = 0, row = 1 }]\n", "a copy of a lamp has no 'row'"},
        {point + "power = 1\nat = [{ x = 0, y = 0, scale = 2 }]\n", "the scale of copy 1 is 2"},
        {point + "power = -1\nat = [[0, 0], [1, 0], [2, 0]]\n", "power is -1"},
        {point + "power = 1\nat = []\n", "at is empty (there would be no copy)"},
        {"type = 'sun'\nazimuth_deg = 0\nelevation_deg = 9\nirradiance_facing = 1\nat = [[0, 0]]\n",
         "at is for lamps"}};
    for (const BadCopies& bad : table) {
        const auto faults = faults_of(with_copied_lamp(bad.keys).text());
        EXPECT_EQ(faults.size(), 1U) << ::testing::PrintToString(faults);
        EXPECT_TRUE(mentions(faults, bad.problem)) << ::testing::PrintToString(faults);
    }
}

}  // namespace
}  // namespace quasimc::test
