#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

RunText with_organ(const std::string& keys) {
    RunText text;
    text.organs = "[[organ]]\nmaterial = 'leaf'\n" + keys;
    return text;
}

struct GoodShape {
    std::string keys;
    double area;
    double tolerance;
};

std::string flat_patch() {
    std::string text = "patches = [[";
    for (int i = 0; i < 16; ++i) {
        text += "[" + std::to_string(i / 4) + ", " + std::to_string(i % 4) + ", 1], ";
    }
    return text + "]]\n";
}

TEST(OrganKeys, EveryShapeHasItsArea) {
    const double half_turn = std::numbers::pi;
    const std::vector<GoodShape> table{
        {"shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1], [0, 2, 1]]\n", 2, 1e-12},
        {"shape = 'parallelogram'\ncorner = [0, 0, 1]\nedge_a = [2, 0, 0]\nedge_b = [1, 3, 0]\n", 6,
         1e-12},
        {"shape = 'rhombus'\nbase = [0, 0, 1]\nlength = [4, 0, 0]\nup = [0, 0, 1]\nwidth = 1\n", 2,
         1e-12},
        {"shape = 'polygon'\ncorners = [[0, 0, 1], [2, 0, 1], [2, 2, 1], [1, 0.5, 1], [0, 2, 1]]\n",
         2.5, 1e-12},
        {"shape = 'bezier'\n" + flat_patch(), 9, 1e-9},
        {"shape = 'bezier'\nflatness = 0.01\n" + flat_patch(), 9, 1e-9},
        {"shape = 'cylinder'\nbase = [0, 0, 0]\naxis = [0, 0, 2]\nradius = 0.5\n", 2 * half_turn,
         1e-9},
        {"shape = 'cylinder'\nbase = [0, 0, 0]\naxis = [0, 0, 2]\nradius = 0.5\nsides = "
         "500\ncapped = true\n",
         2.5 * half_turn, 1e-3},
        {"shape = 'disk'\ncenter = [0, 0, 1]\nnormal = [0, 0, 1]\nradius = 2\nsides = 5\n",
         4 * half_turn, 1e-9},
        {"shape = 'sphere'\ncenter = [0, 0, 1]\nradius = 0.5\nlevels = 2\n", half_turn, 1e-9},
        {"shape = 'mesh'\nvertices = [[0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1]]\nfaces = [[0, 1, "
         "2, 3]]\n",
         4, 1e-12},
    };
    for (const GoodShape& good : table) {
        const RunFile run = read_text(with_organ(good.keys).text());
        EXPECT_NEAR(run.scene.organs()[0].area, good.area, good.tolerance) << good.keys;
    }
}

TEST(OrganKeys, IdNameAndLabelsComeBack) {
    const RunFile run =
        read_text(with_organ("id = -7\nname = 'tip'\nlabels = { plant = 3, kind = 'leaf' }\n"
                             "shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1], [0, 2, 1]]\n")
                      .text());
    const Organ& organ = run.scene.organs()[0];
    EXPECT_EQ(organ.id, -7);
    EXPECT_EQ(organ.name, "tip");
    EXPECT_EQ(organ.labels, (Labels{{"plant", "3"}, {"kind", "leaf"}}));
}

TEST(OrganKeys, TransformScalesThenTurnsThenMoves) {
    const RunFile run =
        read_text(with_organ("shape = 'triangle'\ncorners = [[1, 0, 0], [2, 0, 0], [1, 1, 0]]\n"
                             "transform = { translate = [10, 20, 30], scale = 2, rotate = { axis = "
                             "[0, 0, 5], angle_deg = 90 } }\n")
                      .text());
    const Triangle& t = data_of(run.scene).triangles()[0];
    EXPECT_NEAR(t[0].x, 10, 1e-12);
    EXPECT_NEAR(t[0].y, 22, 1e-12);
    EXPECT_NEAR(t[0].z, 30, 1e-12);
    EXPECT_NEAR(t[1].y, 24, 1e-12);
    EXPECT_NEAR(t[2].x, 8, 1e-12);
}

TEST(OrganKeys, AYUpFileIsTurnedUpright) {
    RunText text = with_organ("shape = 'triangle'\ncorners = [[0, 5, 0], [0, 5, 1], [1, 5, 0]]\n");
    text.top += "up = 'y'\n";
    const Scene scene = read_text(text.text()).scene;
    EXPECT_EQ(data_of(scene).triangles()[0][0], (Vec3{0, 0, 5}));
    EXPECT_GT(area_vector(data_of(scene).triangles()[0]).z, 0);
}

struct BadOrgan {
    std::string keys, problem;
};

TEST(OrganKeys, RefuseWhatIsWrong) {
    const std::string triangle =
        "shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1], [0, 2, 1]]\n";
    const std::string cylinder = "shape = 'cylinder'\nbase = [0, 0, 0]\naxis = [0, 0, 2]\n";
    const std::vector<BadOrgan> table{
        {"", "shape is missing"},
        {"shape = 'cube'\n", "shape: 'cube' is not one of"},
        {"shape = 'triangel'\n", "did you mean 'triangle'?"},
        {"shape = 'triangle'\n", "corners is missing"},
        {"shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1]]\n", "2 corners"},
        {"shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1], [0, 2]]\n",
         "corners[2] is a list of 2"},
        {"shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1], [0, 2, nan]]\n",
         "corners[2] is nan"},
        {"shape = 'triangle'\ncorners = [[0, 0, 1], [2, 0, 1], [0, 2, '3']]\n",
         "corners[2] is a text"},
        {"shape = 'triangle'\ncorners = 3\n", "corners is an integer"},
        {"shape = 'triangle'\ncorners = [[0, 0, 1], [1e300, 1, 1], [2, 2, 1]]\n", "organ"},
        {triangle + "radius = 3\n", "unknown key 'radius'"},
        {triangle + "id = 1.5\n", "id is a number"},
        {triangle + "name = 3\n", "name is an integer"},
        {triangle + "labels = 'leaf'\n", "labels is a text"},
        {triangle + "labels = { plant = 1.5 }\n", "label plant is a number"},
        {triangle + "transform = { scale = 0 }\n", "scale is 0"},
        {triangle + "transform = { scale = -1 }\n", "scale is -1"},
        {triangle + "transform = { rotate = { axis = [0, 0, 0], angle_deg = 3 } }\n",
         "axis is [0, 0, 0]"},
        {triangle + "transform = { rotate = { axis = [0, 0, 1] } }\n", "angle_deg is missing"},
        {triangle + "transform = { move = [0, 0, 1] }\n", "unknown key 'move'"},
        {triangle + "transform = 3\n", "transform: is an integer"},
        {"shape = 'polygon'\ncorners = [[0, 0, 1], [2, 0, 1]]\n",
         "2 corners (a polygon has 3 to 1024)"},
        {"shape = 'rhombus'\nbase = [0, 0, 1]\nlength = [4, 0, 0]\nup = [1, 0, 0]\nwidth = 1\n",
         "up points along length"},
        {"shape = 'rhombus'\nbase = [0, 0, 1]\nlength = [4, 0, 0]\nup = [0, 0, 1]\nwidth = 0\n",
         "width is 0"},
        {"shape = 'bezier'\n", "patches is missing"},
        {"shape = 'bezier'\npatches = [[[0, 0, 0]]]\n", "patches[0] has 1 points"},
        {"shape = 'bezier'\npatches = [3]\n", "patches[0] is an integer"},
        {"shape = 'bezier'\nflatness = 0\n" + flat_patch(), "flatness is 0"},
        {cylinder, "radius is missing"},
        {cylinder + "radius = -1\n", "radius is -1"},
        {cylinder + "radius = 1\nsides = 2\n", "sides is 2"},
        {cylinder + "radius = 1\nsides = 1000000000\n", "sides is 1000000000"},
        {cylinder + "radius = 1\ncapped = 1\n", "capped is an integer"},
        {"shape = 'cylinder'\nbase = [0, 0, 0]\naxis = [0, 0, 0]\nradius = 1\n",
         "axis is [0, 0, 0]"},
        {"shape = 'disk'\ncenter = [0, 0, 0]\nnormal = [0, 0, 0]\nradius = 1\n",
         "normal is [0, 0, 0]"},
        {"shape = 'sphere'\ncenter = [0, 0, 0]\nradius = 1\nlevels = 50\n", "levels is 50"},
        {"shape = 'mesh'\nvertices = [[0, 0, 1], [2, 0, 1], [2, 2, 1]]\nfaces = []\n",
         "faces is missing or not a list"},
        {"shape = 'mesh'\nvertices = [[0, 0, 1], [2, 0, 1], [2, 2, 1]]\nfaces = [[0, 1]]\n",
         "faces[0]"},
        {"shape = 'mesh'\nvertices = [[0, 0, 1], [2, 0, 1], [2, 2, 1]]\nfaces = [[0, 1, 3]]\n",
         "refers to a vertex that does not exist"},
        {"shape = 'mesh'\nvertices = [[0, 0, 1], [2, 0, 1], [2, 2, 1]]\nfaces = [[0, 1, -1]]\n",
         "refers to a vertex"},
    };
    for (const BadOrgan& bad : table) {
        const auto faults = faults_of(with_organ(bad.keys).text());
        EXPECT_TRUE(mentions(faults, bad.problem)) << bad.problem << "\n"
                                                   << ::testing::PrintToString(faults);
        EXPECT_EQ(faults.size(), 1U) << bad.problem << "\n" << ::testing::PrintToString(faults);
    }
}

TEST(OrganKeys, RefuseTwoOrgansOfOneId) {
    RunText text;
    text.organs += "id = 4\n" + text.organs + "id = 4\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "4"));
}

RunText with_geometry(const std::string& keys) {
    RunText text;
    text.organs = "[[geometry]]\n" + keys;
    return text;
}

const std::string kTwoTriangles = "0 0 0 1 0 0 0 1 0\n# comment\n0 0 1 1 0 1 0 1 1\n";

TEST(GeometryKeys, EachTriangleIsAnOrgan) {
    const RunFile run = read_text(
        with_geometry("file = 'a.tri'\nmaterial = 'leaf'\nname = 'leaf'\nfirst_id = 10\n"
                      "labels = { kind = 'leaf' }\n")
            .text(),
        {{"a.tri", kTwoTriangles}});
    ASSERT_EQ(run.scene.organs().size(), 2U);
    EXPECT_EQ(run.scene.organs()[1].id, 11);
    EXPECT_EQ(run.scene.organs()[1].name, "leaf 2");
    EXPECT_EQ(run.scene.organs()[1].labels, (Labels{{"kind", "leaf"}}));
}

TEST(GeometryKeys, TheWholeFileMayBeOneOrgan) {
    const RunFile run = read_text(
        with_geometry("file = 'a.tri'\nmaterial = 'leaf'\norgans = 'one'\nname = 'tree'\n"
                      "transform = { scale = 2 }\n")
            .text(),
        {{"a.tri", kTwoTriangles}});
    ASSERT_EQ(run.scene.organs().size(), 1U);
    EXPECT_EQ(run.scene.organs()[0].name, "tree");
    EXPECT_DOUBLE_EQ(run.scene.organs()[0].area, 4);
}

TEST(GeometryKeys, CopiesStandWhereTheyAreToldTo) {
    const RunFile run = read_text(
        with_geometry("file = 'a.tri'\nmaterial = 'leaf'\norgans = 'one'\nname = 'tree'\n"
                      "at = [[5, 0, 0], [0, 5, 1, 90], [0, 0, 0, 180, 2]]\n")
            .text(),
        {{"a.tri", kTwoTriangles}});
    ASSERT_EQ(run.scene.organs().size(), 3U);
    EXPECT_EQ(run.scene.organs()[1].name, "tree 2");
    EXPECT_DOUBLE_EQ(run.scene.organs()[2].area, 4);
    const auto corner = [&](std::uint32_t organ) {
        return data_of(run.scene).triangles()[run.scene.organs()[organ].first_triangle][1];
    };
    // The second corner of the file is (1, 0, 0); a heading counts clockwise, as azimuths do.
    EXPECT_LT(length(corner(0) - Vec3{6, 0, 0}), 1e-15);
    EXPECT_LT(length(corner(1) - Vec3{0, 4, 1}), 1e-15);
    EXPECT_LT(length(corner(2) - Vec3{-2, 0, 0}), 1e-15);
}

TEST(GeometryKeys, CopiesTurnAboutTheAxisThatIsUp) {
    RunText text =
        with_geometry("file = 'a.tri'\nmaterial = 'leaf'\norgans = 'one'\nat = [[0, 0, 0, 90]]\n");
    text.top += "up = 'y'\n";
    const RunFile run = read_text(text.text(), {{"a.tri", kTwoTriangles}});
    // North is x; clockwise from it, seen from above, is z.
    const Vec3 corner = run.scene.orientation().outward(data_of(run.scene).triangles()[0][1]);
    EXPECT_LT(length(corner - Vec3{0, 0, 1}), 1e-15)
        << corner.x << " " << corner.y << " " << corner.z;
}

TEST(GeometryKeys, FaultyCopiesAreNamed) {
    for (const char* const at : {"[]", "5", "[5]", "[[1]]", "[[1, 2, 3, 4, 0]]", "[[1, 2, 'x']]"}) {
        const auto faults = faults_of(
            with_geometry(std::string("file = 'a.tri'\nmaterial = 'leaf'\nat = ") + at + "\n")
                .text(),
            {{"a.tri", kTwoTriangles}});
        EXPECT_EQ(faults.size(), 1U) << at << ::testing::PrintToString(faults);
    }
}

TEST(GeometryKeys, FaultsOfTheBuilderNameTheLineOfTheFile) {
    const auto faults = faults_of(
        with_geometry("file = 'a.tri'\nmaterial = 'leaf'\n").text(),
        {{"a.tri", "0 0 0 1 0 0 0 1 0\n\n0 0 0 1 0 0 2e40 0 0\n"}});
    EXPECT_TRUE(mentions(faults, "a.tri:3")) << ::testing::PrintToString(faults);
}

TEST(GeometryKeys, FaultsOfTheFileNameItsLine) {
    const auto faults = faults_of(
        with_geometry("file = 'a.tri'\nmaterial = 'leaf'\n").text(),
        {{"a.tri", "0 0 0 1 0 0 0 1 0\n0 0 0 1 0 0 2\n"}});
    EXPECT_EQ(
        faults, (std::vector<std::string>{
                    "a.tri:2: 7 numbers (a line contains nine numbers: x y z of three corners)"}));
}

std::vector<std::string> texts_of(const RunFile& run) {
    std::vector<std::string> texts;
    for (const Warning& warning : run.warnings) {
        texts.push_back(warning.text);
    }
    return texts;
}

const std::string kObj =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng one\nusemtl green\nf 1 2 3\ng two\nusemtl brown\nf "
    "1 3 2\n";
const std::string kMtl = "newmtl green\nKd 0.1 0.2 0.3\nnewmtl brown\nKd 0.3 0.2 0.1\n";

TEST(GeometryKeys, GroupsAreOrgans) {
    const RunFile run = read_text(
        with_geometry(
            "file = 'a.obj'\nname = 'tree'\nmaterials = { green = 'leaf', brown = 'leaf' }\n")
            .text(),
        {{"a.obj", kObj}, {"a.mtl", kMtl}});
    ASSERT_EQ(run.scene.organs().size(), 2U);
    EXPECT_EQ(run.scene.organs()[0].name, "tree one");
    EXPECT_TRUE(run.warnings.empty() || run.warnings[0].text.find("Kd") == std::string::npos);
}

TEST(GeometryKeys, AMaterialOfTheRunGoesBeforeTheLibrary) {
    RunText text = with_geometry("file = 'a.obj'\n");
    text.materials +=
        "[[material]]\nname = 'green'\nreflectance = 0.05\n[[material]]\nname = "
        "'brown'\nreflectance = 0.5\n";
    const RunFile run = read_text(text.text(), {{"a.obj", kObj}, {"a.mtl", kMtl}});
    EXPECT_DOUBLE_EQ(
        data_of(run.scene)
            .material(run.scene.regions()[0])
            .side(SurfaceSide::upper)
            .absorptance()[0],
        0.95);
}

TEST(GeometryKeys, TheLibraryIsTheLastResortAndWarns) {
    const RunFile run = read_text(
        with_geometry("file = 'sub/a.obj'\n").text(), {{"sub/a.obj", kObj}, {"sub/a.mtl", kMtl}});
    EXPECT_NEAR(
        data_of(run.scene)
            .material(run.scene.regions()[0])
            .side(SurfaceSide::upper)
            .absorptance()[0],
        0.8, 1e-12);
    std::vector<std::string> warnings;
    for (const Warning& warning : run.warnings) {
        warnings.push_back(warning.text);
    }
    EXPECT_TRUE(mentions(warnings, "its diffuse colour gives reflectance 0.2"));
    EXPECT_EQ(run.inputs.size(), 2U);
}

TEST(GeometryKeys, TheMaterialKeyIsForWhatIsNotKnownAndWarns) {
    const FakeFiles files{{"a.obj", kObj}, {"a.mtl", kMtl}};
    const std::string keys = "file = 'a.obj'\nmaterial = 'leaf'\n";
    EXPECT_TRUE(mentions(
        texts_of(read_text(with_geometry(keys + "materials = { brown = 'leaf' }\n").text(), files)),
        "the scene has no material 'green' of a.obj; 'leaf' is used"));
    // Where the run file knows none of them, the one that it gives is for all.
    EXPECT_FALSE(mentions(texts_of(read_text(with_geometry(keys).text(), files)), "run file"));
}

/// Two files whose libraries give the material M different reflectances, in an order, and more
/// keys.
RunFile read_two_of_one_name(
    const std::string& first, const std::string& second, const std::string& materials = "") {
    RunText text = with_geometry("file = '" + first + "'\n[[geometry]]\nfile = '" + second + "'\n");
    text.materials += materials;
    const auto square = [](const std::string& library, int x) {
        return fmt::format(
            "mtllib {}\no {}\nusemtl M\nv {} 0 0\nv {} 0 0\nv {} 1 0\nf 1 2 3\n", library, library,
            x, x + 1, x);
    };
    return read_text(
        text.text(), {{"A.obj", square("a.mtl", 0)},
                      {"a.mtl", "newmtl M\nKd 0 0 0\n"},
                      {"B.obj", square("b.mtl", 2)},
                      {"b.mtl", "newmtl M\nKd .9 .9 .9\n"},
                      {"C.obj", square("b.mtl", 4)}});
}

/// "A.obj M 1": the material of each organ and what it absorbs.
std::vector<std::string> absorptances(const Scene& scene) {
    std::vector<std::string> all;
    for (const Region& region : scene.regions()) {
        all.push_back(fmt::format(
            "{} {:.3g}", scene.material_name(region),
            data_of(scene).material(region).side(SurfaceSide::upper).absorptance()[0]));
    }
    return all;
}

TEST(GeometryKeys, MaterialsBelongToTheFileThatDefinesThem) {
    const RunFile run = read_two_of_one_name("A.obj", "B.obj");
    EXPECT_EQ(absorptances(run.scene), (std::vector<std::string>{"A.obj M 1", "B.obj M 0.1"}));
    EXPECT_EQ(
        texts_of(run)[1],
        "the scene has no material 'M' of B.obj; its diffuse colour gives reflectance 0.9, "
        "transmittance 0 in every band; results call it 'B.obj ...', as other files have other "
        "materials of the same name");
    EXPECT_EQ(
        absorptances(read_two_of_one_name("B.obj", "A.obj").scene),
        (std::vector<std::string>{"B.obj M 0.1", "A.obj M 1"}));
    // Alike, and the same file twice: one material with its own name.
    EXPECT_EQ(
        absorptances(read_two_of_one_name("C.obj", "B.obj").scene),
        (std::vector<std::string>{"M 0.1", "M 0.1"}));
    EXPECT_EQ(
        absorptances(read_two_of_one_name("A.obj", "A.obj").scene),
        (std::vector<std::string>{"M 1", "M 1"}));
}

/// Whether other files have a material of the name does not matter.
TEST(GeometryKeys, AMaterialOfOneFileIsFoundWhereNoOtherFileHasTheName) {
    const std::string material = "[[material]]\nname = 'B.obj M'\nreflectance = 0.3\n";
    EXPECT_EQ(
        absorptances(read_two_of_one_name("B.obj", "B.obj", material).scene),
        (std::vector<std::string>{"B.obj M 0.7", "B.obj M 0.7"}));
    const std::string elsewhere = "[[material]]\nname = 'x/B.obj M'\nreflectance = 0.3\n";
    EXPECT_TRUE(mentions(
        texts_of(read_two_of_one_name("B.obj", "B.obj", elsewhere)),
        "no file of geometry has the material 'x/B.obj M'"));
    EXPECT_FALSE(mentions(texts_of(read_two_of_one_name("B.obj", "A.obj", material)), "no [["));
}

TEST(GeometryKeys, AKeyThatTheFileDoesNotUseIsAWarning) {
    const FakeFiles files{{"a.obj", kObj}, {"a.mtl", kMtl}};
    const std::string keys = "file = 'a.obj'\nmaterials = { 'a.obj green' = 'leaf' }\n";
    EXPECT_TRUE(mentions(
        texts_of(read_text(with_geometry(keys).text(), files)),
        "materials contains 'a.obj green', which a.obj does not use"));
}

TEST(GeometryKeys, AMaterialOfTheRunIsForAllFilesOrForOne) {
    EXPECT_EQ(
        absorptances(
            read_two_of_one_name("A.obj", "B.obj", "[[material]]\nname = 'M'\nreflectance = 0.3\n")
                .scene),
        (std::vector<std::string>{"M 0.7", "M 0.7"}));
    EXPECT_EQ(
        absorptances(read_two_of_one_name(
                         "A.obj", "B.obj", "[[material]]\nname = 'B.obj M'\nreflectance = 0.3\n")
                         .scene),
        (std::vector<std::string>{"A.obj M 1", "B.obj M 0.7"}));
}

TEST(GeometryKeys, ManyMaterialsOfALibraryAreOneWarning) {
    std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", mtl;
    for (int i = 0; i < 5; ++i) {
        obj += fmt::format("usemtl m{}\nf 1 2 3\n", i);
        mtl += fmt::format("newmtl m{0}\nKd .{0} .{0} .{0}\n", i);
    }
    const auto warnings = texts_of(read_text(
        with_geometry("file = 'a.obj'\norgans = 'one'\n").text(),
        {{"a.obj", obj}, {"a.mtl", mtl}}));
    EXPECT_TRUE(mentions(
        warnings,
        "the scene lacks 5 materials of a.obj; of 'm0' its diffuse colour gives "
        "reflectance 0, transmittance 0 in every band; of 'm1' its"))
        << ::testing::PrintToString(warnings);
    EXPECT_TRUE(mentions(warnings, "; and 2 more"));
}

TEST(GeometryKeys, WarningsOfOneKindAreOneOfThemWithTheirNumber) {
    std::string keys;
    FakeFiles files{{"a.mtl", "newmtl green\nKd .5 .5 .5\n"}};
    for (int i = 0; i < 100; ++i) {
        const std::string file = fmt::format("plant{}.obj", i);
        keys += fmt::format("{}file = '{}'\n", i == 0 ? "" : "[[geometry]]\n", file);
        files[file] = fmt::format(
            "mtllib a.mtl\nusemtl green\nv {0} 0 0\nv {0} 1 0\nv {0} 1 1\nf 1 2 3\n", i);
    }
    const RunFile run = read_text(with_geometry(keys).text(), files);
    ASSERT_EQ(run.warnings.size(), 1U);
    EXPECT_EQ(
        run.warnings[0].text,
        "the scene has no material 'green' of plant0.obj; its diffuse colour gives "
        "reflectance 0.5, transmittance 0 in every band (100 warnings of this kind)");
    EXPECT_NE(run.warnings[0].where.find(" and others"), std::string::npos);
}

TEST(GeometryKeys, WarnsOfMasksAndOfWhatIsTransparentWithTheAreas) {
    const std::string obj =
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 2 0\nusemtl leaf\nf 1 2 3\n"
        "usemtl air\nf 1 4 5\nusemtl wood\nf 2 3 4\n";
    const auto warnings = [&](const std::string& mtl) {
        return texts_of(read_text(
            with_geometry("file = 'a.obj'\nmaterial = 'leaf'\norgans = 'one'\n").text(),
            {{"a.obj", obj}, {"a.mtl", mtl}}));
    };
    const auto some = warnings(
        "newmtl leaf\nmap_Kd a.png\nmap_d -s 1 1 a.png\nnewmtl air\nd 0\nnewmtl wood\n"
        "map_Kd bark.jpg\nd 1\nTr 1\n");
    EXPECT_TRUE(mentions(
        some,
        "1 material has textures that may mask parts of a face (map_d): masks are not read; faces "
        "are opaque, 0.5 of the area of 3"))
        << ::testing::PrintToString(some);
    EXPECT_TRUE(mentions(
        some,
        "1 material has an opacity below 1 (d 0): opacity is not read; faces are opaque, 2 of the "
        "area of 3"))
        << ::testing::PrintToString(some);
    EXPECT_TRUE(mentions(
        warnings("newmtl leaf\nmap_Kd a.png\nnewmtl wood\nTr 1\nmap_d w.png\n"),
        "2 materials have textures that may mask parts of a face (map_Kd, map_d): masks"));
    EXPECT_FALSE(mentions(warnings("newmtl leaf\nKd 1 1 1\nTr 0\nd 1.0\n"), "opacity"));
}

TEST(GeometryKeys, PlantUnitIsThatOfThePlantsOfAScene) {
    const std::string opf = R"(<opf><meshBDD><mesh Id="0"><points>0 0 1 1 0 1 0 1 1</points>
<faces><face>0 1 2</face></faces></mesh></meshBDD><shapeBDD><shape Id="0"><meshIndex>0</meshIndex>
</shape></shapeBDD><topology class="Plant" id="1"><geometry><shapeIndex>0</shapeIndex>
<mat>1 0 0 0 0 1 0 0 0 0 1 0</mat></geometry></topology></opf>)";
    const FakeFiles files{
        {"a.ops", "1 1 a.opf 0 0 0 1 0 0 0\n1 2 a.opf 3 0 0 1 0 0 0\n"}, {"a.opf", opf}};
    const auto read = [&](const std::string& key, const std::string& top = "") {
        RunText text = with_geometry("file = 'a.ops'\nmaterial = 'leaf'\n" + key);
        text.top += top;
        return read_text(text.text(), files);
    };
    EXPECT_NEAR(read("").scene.organs()[1].area, 0.5e-4, 1e-14);
    EXPECT_TRUE(mentions(texts_of(read("")), "plants are read in centimetres"));
    for (const auto& [key, unit] : {std::pair{"'m'", 1.0}, {"'cm'", 0.01}, {"1e-4", 1e-4}}) {
        const RunFile run = read(fmt::format("plant_unit = {}\n", key));
        EXPECT_NEAR(run.scene.organs()[1].area, 0.5 * unit * unit, 1e-9 * unit * unit) << key;
        EXPECT_FALSE(mentions(texts_of(run), "centimetres")) << key;
    }
    EXPECT_TRUE(mentions(
        texts_of(read("transform = { scale = 1e-2 }\n")),
        "transform scales the plants and positions of a.ops again"));
    EXPECT_FALSE(
        mentions(texts_of(read("transform = { scale = 1e-2 }\nplant_unit = 'm'\n")), " again: "));
    EXPECT_FALSE(mentions(
        texts_of(read("transform = { rotate = { axis = [1, 0, 1], angle_deg = 30 } }\n")),
        " again: "));
    // A scene in centimetres: plants as they are, positions times 100.
    const RunFile in_cm = read("", "length_unit = 'cm'\n");
    EXPECT_NEAR(in_cm.scene.organs()[1].area, 0.5, 1e-12);
    EXPECT_NEAR(in_cm.scene.bounds().high.x, 301, 1e-9);
    EXPECT_TRUE(mentions(
        faults_of(with_geometry("file = 'a.ops'\nplant_unit = 'ell'\n").text(), files),
        "plant_unit is 'ell' (no such unit of length)"));
    EXPECT_TRUE(mentions(
        faults_of(with_geometry("file = 'a.opf'\nplant_unit = 'cm'\n").text(), files),
        "plant_unit is given (it is for the plants that a scene (.ops) names)"));
}

TEST(Materials, WarnOfBlackOnlyWhereTheReflectanceIsNotGiven) {
    RunText text;
    EXPECT_EQ(texts_of(read_text(text.text())), std::vector<std::string>{});
    text.materials = "[[material]]\nname = 'leaf'\ntransmittance = 0\n";
    EXPECT_EQ(
        texts_of(read_text(text.text())),
        std::vector<std::string>{
            "material 'leaf' is black in every band: its reflectance is missing and 0 is used"});
}

TEST(GeometryKeys, RefuseWhatIsWrong) {
    const FakeFiles files{
        {"a.tri", kTwoTriangles},
        {"b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n"},
        {"empty.tri", ""},
        {"a.dat", kTwoTriangles}};
    const std::vector<BadOrgan> table{
        {"material = 'leaf'\n", "file is missing"},
        {"file = 3\nmaterial = 'leaf'\n", "file is an integer"},
        {"file = ''\nmaterial = 'leaf'\n", "file is empty"},
        {"file = 'none.tri'\nmaterial = 'leaf'\n",
         "file 'none.tri' can't be read (No such file or directory)"},
        {"file = 'a.dat'\nmaterial = 'leaf'\n",
         "the format of 'a.dat' is unclear from its name (supported formats are tri, obj, ply, "
         "stl, can, opf, gwa, ops, fasttracer, def, glb, gltf, vgx)"},
        {"file = 'a.tri'\nformat = 'xyz'\nmaterial = 'leaf'\n", "format: 'xyz' is not one of"},
        {"file = 'a.tri'\n", "a.tri has triangles without a material; add material"},
        {"file = 'a.tri'\nmaterial = 'wood'\n", "wood"},
        {"file = 'a.tri'\nmaterial = 3\n", "material is an integer"},
        {"file = 'a.tri'\nmaterial = 'leaf'\norgans = 'all'\n", "organs: 'all' is not one of"},
        {"file = 'a.tri'\nmaterial = 'leaf'\nfirst_id = 'a'\n", "first_id is a text"},
        {"file = 'a.tri'\nmaterial = 'leaf'\nscale = 3\n", "unknown key 'scale'"},
        {"file = 'empty.tri'\nmaterial = 'leaf'\n", "file 'empty.tri' contains no triangle"},
        {"file = 'b.obj'\n", "the scene has no material 'wood' of b.obj"},
        {"file = 'b.obj'\nmaterials = 'leaf'\n", "materials is a text"},
        {"file = 'b.obj'\nmaterials = { wood = 3 }\n", "materials.wood is an integer"},
    };
    for (const BadOrgan& bad : table) {
        const auto faults = faults_of(with_geometry(bad.keys).text(), files);
        EXPECT_TRUE(mentions(faults, bad.problem)) << bad.problem << "\n"
                                                   << ::testing::PrintToString(faults);
        EXPECT_EQ(faults.size(), 1U) << bad.problem << "\n" << ::testing::PrintToString(faults);
    }
}

TEST(GroundAndCellKeys, RefuseWhatIsWrong) {
    const std::vector<BadOrgan> table{
        {"[ground]\n", "material is missing"},
        {"[ground]\nmaterial = 'soil'\n", "soil"},
        {"[ground]\nmaterial = 'leaf'\nheight = inf\n", "height is inf"},
        {"[ground]\nmaterial = 'leaf'\nx = [0, 1]\n", "y is missing"},
        {"[ground]\nmaterial = 'leaf'\nx = [1, 0]\ny = [0, 1]\n",
         "the first must be less than the second"},
        {"[ground]\nmaterial = 'leaf'\nfile = 'x.tri'\n", "can't be read"},
        {"[ground]\nmaterial = 'leaf'\nfile = 'x.tri'\nheight = 3\n", "unknown key 'height'"},
        {"[cell]\n", "it is not periodic along any axis"},
        {"[cell]\nx = [0, 0]\n", "the first must be less than the second"},
        {"[cell]\nx = 3\n", "x is not a pair of numbers"},
        {"[cell]\nx = [0, nan]\n", "x is nan"},
        {"[cell]\nz = [0, 1]\nx = [0, 1]\n", "unknown key 'z'"},
        {"cell = 3\n", ""},
    };
    for (const BadOrgan& bad : table) {
        RunText text;
        text.rest = bad.keys;
        const auto faults = faults_of(text.text());
        EXPECT_TRUE(mentions(faults, bad.problem)) << bad.problem << "\n"
                                                   << ::testing::PrintToString(faults);
        EXPECT_FALSE(faults.empty()) << bad.keys;
    }
}

}  // namespace
}  // namespace quasimc::test
