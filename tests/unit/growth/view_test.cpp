#include "growth/view/view.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "growth/view/view_lines.h"

namespace quasimc::test {
namespace {

const char* const kBumps =
    "range: 0.0 1.0\npoints: 5\n0.0 0.0\n0.25 1.0\n0.5 0.2\n0.75 0.9\n1.0 0.4\n";

const char* const kFunctionSet =
    "funcgalleryver 1 1\nitems: 2\n"
    "fver 1 1\nname: slope\nsamples: 3\nflip: off\npoints: 4\n"
    "0.0 0.0\n0.3 0.3\n0.6 0.6\n1.0 1.0\n"
    "fver 1 1\nname: hill\nsamples: 3\nflip: off\npoints: 4\n"
    "0.0 0.0\n0.3 1.5\n0.7 1.5\n1.0 0.0\n";

/// Two patches, with a contact point and a frame of their own.
const char* const kLeaf =
    "-12.00 12.00   0.00 30.00   -10.00 10.00\n"
    "PRECISION S: 2 T: 3\n"
    "CONTACT POINT  X: 0.00 Y: 1.00 Z: -1.00\n"
    "END POINT  X: 1.00 Y: 28.00 Z: -5.00\n"
    "HEADING  X: 0.00 Y: 0.60 Z: -0.80\n"
    "UP  X: 0.00 Y: 0.80 Z: 0.60\n"
    "SIZE: 30.000000\n"
    "Left\n"
    "TOP COLOR: 3 DIFFUSE: 0.50 BOTTOM COLOR: 3 DIFFUSE: 0.50\n"
    "AL: ~ A: ~ AR: ~ \nL: ~ R: ~ \nBL: ~ B: Right BR: ~ \n"
    "-12.00 0.00 1.07  -10.80 10.00 2.40  -7.20 20.00 1.07  -1.20 30.00 -2.93  \n"
    "-8.00 0.00 0.27  -7.20 10.00 1.60  -4.80 20.00 3.27  -0.80 30.00 -3.73  \n"
    "-4.00 0.00 -0.53  -3.60 10.00 0.80  -2.40 20.00 -0.53  -0.40 30.00 -4.53  \n"
    "0.00 0.00 -1.33  0.00 10.00 0.00  0.00 20.00 -1.33  0.00 30.00 -5.33  \n"
    "Right\n"
    "TOP COLOR: 3 DIFFUSE: 0.50 BOTTOM COLOR: 3 DIFFUSE: 0.50\n"
    "AL: ~ A: Left AR: ~ \nL: ~ R: ~ \nBL: ~ B: ~ BR: ~ \n"
    "0.00 0.00 -1.33  0.00 10.00 0.00  0.00 20.00 -1.33  0.00 30.00 -5.33  \n"
    "4.00 0.00 -0.53  3.60 10.00 0.80  2.40 20.00 2.47  0.40 30.00 -4.53  \n"
    "8.00 0.00 0.27  7.20 10.00 1.60  4.80 20.00 0.27  0.80 30.00 -3.73  \n"
    "12.00 0.00 1.07  10.80 10.00 2.40  7.20 20.00 1.07  1.20 30.00 -2.93  \n";

/// A straight contour or curve of points at distances of 1.
std::string straight_points(const std::string& first_line, int count) {
    std::string text = fmt::format("{}\nname: straight\npoints: {}\ntype: or\n", first_line, count);
    for (int i = 0; i < count; ++i) {
        text += fmt::format("{} 0 0 1\n", i);
    }
    return text;
}

/// Reads views, with files in memory, and records the notices.
class ViewFiles {
  public:
    View read(const std::string& text) {
        InputFiles files("/models/plants", [this](const std::filesystem::path& path) {
            const auto found = files_.find(path.string());
            if (found == files_.end()) {
                throw InputError({{path.string(), "can't be read", "no such file", ""}});
            }
            return found->second;
        });
        Notices notices([this](const std::string& notice) { notices_.push_back(notice); });
        PreprocessedText view{text, {}, {"tree.v"}};
        for (std::size_t i = 0; i <= text.size(); ++i) {
            view.lines.push_back({0, static_cast<std::uint32_t>(i + 1)});
        }
        return read_view(view, files, notices);
    }
    /// Adds a file beside the view file.
    void add(const std::string& name, const std::string& text) {
        files_["/models/plants/" + name] = text;
    }
    [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }

    /// The text of the errors of a view.
    std::string errors(const std::string& text) {
        try {
            static_cast<void>(read(text));
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }

  private:
    std::map<std::string, std::string> files_;
    std::vector<std::string> notices_;
};

std::string six_digits(double value) {
    return fmt::format("{:g}", value);
}

std::string six_digits(const Vec3& p) {
    return fmt::format("{:g} {:g} {:g}", p.x, p.y, p.z);
}

BezierSurface leaf_surface(const std::string& text, PatchDivisions divisions) {
    Notices notices([](const std::string&) {});
    return read_surface_file({"leaf.s", text}, 2, divisions, notices).value();
}

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
    return text.replace(text.find(old_part), old_part.size(), new_part);
}

TEST(PlantFunctions, HaveTheValuesOfCpfg) {
    const PlantFunction f = read_function_file({"f1.func", kBumps}, 0);
    EXPECT_EQ(six_digits(f.value(0)), "0.00292568");
    EXPECT_EQ(six_digits(f.value(0.25)), "0.642742");
    EXPECT_EQ(six_digits(f.value(0.5)), "0.575");
    EXPECT_EQ(six_digits(f.value(0.9)), "0.567228");
    EXPECT_EQ(six_digits(f.value(1)), "0.401462");
    EXPECT_EQ(six_digits(f.value(-1)), "0.00292568");
    EXPECT_EQ(six_digits(f.value(2)), "0.401462");
}

TEST(PlantFunctions, AreInterpolatedBetweenSamples) {
    const PlantFunction f = read_function_file({"f2.func", kBumps}, 50);
    EXPECT_EQ(six_digits(f.value(0)), "0.00292568");
    EXPECT_EQ(six_digits(f.value(0.3)), "0.672085");
    EXPECT_EQ(six_digits(f.value(0.5)), "0.57581");
    EXPECT_EQ(six_digits(f.value(1)), "0.401462");
}

TEST(PlantFunctions, OfASetHaveTheValuesOfCpfg) {
    const auto set = read_function_set_file({"set.fset", kFunctionSet});
    ASSERT_EQ(set.size(), 2U);
    EXPECT_EQ(six_digits(set[0].value(0)), "0.000878906");
    EXPECT_EQ(six_digits(set[0].value(0.2)), "0.200856");
    EXPECT_EQ(six_digits(set[0].value(0.77)), "0.770061");
    EXPECT_EQ(six_digits(set[1].value(0.2)), "0.452634");
    EXPECT_EQ(six_digits(set[1].value(0.5)), "1.125");
    EXPECT_EQ(six_digits(set[1].value(0.77)), "0.519871");
    EXPECT_EQ(six_digits(set[1].value(1)), "0.00439024");
}

TEST(PlantFunctions, RepeatPointsByTheirMultiplicity) {
    const PlantFunction f =
        read_function_file({"f.func", "fver 1 1\nsamples: 0\npoints: 2\n0 1 2\n1 3 2\n"}, 0);
    EXPECT_EQ(f.x, (std::vector<double>{0, 0, 1, 1}));
    EXPECT_EQ(f.y, (std::vector<double>{1, 1, 3, 3}));
    EXPECT_EQ(f.value(0.5), 2);
}

TEST(PlantFunctions, OfArgumentsThatAreNoNumbersAreThoseOfZero) {
    const PlantFunction f = read_function_file({"f1.func", kBumps}, 50);
    EXPECT_EQ(f.value(std::nan("")), f.value(0));
    EXPECT_EQ(PlantFunction{}.value(0.5), 0);
}

TEST(PlantCurves, RunAlongTheirLength) {
    const PlantCurve curve = read_curve_file({"c.crv", straight_points("version: 1.4", 6)}, 100);
    EXPECT_NEAR(curve.length, 3, 2e-6);
    EXPECT_NEAR(curve.at(0).x, 1, 1e-9);
    EXPECT_NEAR(curve.at(0.25).x, 1.75, 2e-6);
    EXPECT_NEAR(curve.at(1).x, 4, 2e-6);
    EXPECT_NEAR(curve.at(7).x, 4, 2e-6);
    EXPECT_NEAR(curve.at(-7).x, 1, 1e-9);
}

TEST(PlantCurves, AreUniformSplines) {
    const PlantCurve curve = read_curve_file(
        {"c.crv", "version: 1.4\npoints: 4\ntype: x\n6 0 0 1\n0 6 0 1\n0 0 6 1\n0 0 0 1\n"}, 2);
    EXPECT_EQ(six_digits(curve.at(0)), "1 4 1");
    EXPECT_NEAR(curve.at(1).y, 1, 1e-5);
    EXPECT_NEAR(curve.at(1).z, 4, 1e-5);
}

TEST(PlantCurves, OfContoursAreEmpty) {
    const PlantCurve curve = read_curve_file({"c.con", straight_points("cver 1 3", 6)}, 100);
    EXPECT_EQ(curve.length, 0);
    EXPECT_EQ(curve.at(0.5), Vec3{});
}

TEST(Contours, AreDividedIntoEqualLengths) {
    const Contour contour = read_contour_file({"c.con", straight_points("cver 1 3", 6)});
    EXPECT_TRUE(contour.is_open);
    const auto corners = contour.divided(4);
    ASSERT_EQ(corners.size(), 5U);
    // The last tenth of the last span is not used, as in cpfg.
    for (int k = 0; k <= 4; ++k) {
        EXPECT_NEAR(corners[static_cast<std::size_t>(k)].x, 1 + 2.9 * k / 4, 1e-12) << k;
    }
}

TEST(Contours, BeginAtAPointOfMultiplicityThree) {
    const Contour contour = read_contour_file(
        {"c.con", "cver 1 3\nname: c\npoints: 2 6\ntype: or\nsamples: 4\n1 2 0 3\n3 5 0 3\n"});
    EXPECT_EQ(contour.points.size(), 6U);
    EXPECT_NEAR(contour.divided(3)[0].x, 1, 1e-12);
    EXPECT_NEAR(contour.divided(3)[0].y, 2, 1e-12);
}

TEST(Contours, ReturnToTheirStartIfTheyAreClosed) {
    const Contour contour = read_contour_file(
        {"c.con", "cver 1 3\nname: c\npoints: 3 3\ntype: cr\n0 0 0 1\n1 0 0 1\n0 1 0 1\n"});
    const auto corners = contour.divided(5);
    EXPECT_NEAR(corners.front().x, corners.back().x, 1e-12);
    EXPECT_NEAR(corners.front().y, corners.back().y, 1e-12);
}

TEST(PredefinedSurfaces, HaveTheTrianglesOfCpfg) {
    const BezierSurface leaf = leaf_surface(kLeaf, {1, 1});
    ASSERT_EQ(leaf.mesh->size(), 4U);
    const std::vector<std::vector<std::string>> expected{
        {"-0.8 0.0704 0.136133", "-0.08 1.05707 -1.62387", "0 -0.0576 0.0401333"},
        {"0 -0.0576 0.0401333", "-0.08 1.05707 -1.62387", "0 0.929067 -1.71987"},
        {"0 -0.0576 0.0401333", "0 0.929067 -1.71987", "0.8 0.0704 0.136133"},
        {"0.8 0.0704 0.136133", "0 0.929067 -1.71987", "0.08 1.05707 -1.62387"}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const Triangle triangle = (*leaf.mesh)[i];
        for (std::size_t j = 0; j < 3; ++j) {
            EXPECT_EQ(six_digits(triangle[j]), expected[i][j]) << i << ' ' << j;
        }
    }
}

TEST(PredefinedSurfaces, ShareVerticesWithinPatches) {
    const BezierSurface leaf = leaf_surface(kLeaf, {2, 3});
    EXPECT_EQ(leaf.mesh->vertices.size(), 24U);
    EXPECT_EQ(leaf.mesh->size(), 24U);
}

TEST(PredefinedSurfaces, UseTheFirstPrecisionInBothDirections) {
    EXPECT_EQ(leaf_surface(kLeaf, {}).mesh->size(), 16U);
    EXPECT_EQ(leaf_surface(kLeaf, {3, 0}).mesh->size(), 16U);
}

TEST(PredefinedSurfaces, HaveAnEndPointInTheirFrame) {
    std::string text = replaced(kLeaf, "Y: 1.00 Z: -1.00", "Y: 0 Z: 0");
    text = replaced(text, "X: 0.00 Y: 0.60 Z: -0.80", "X: 0 Y: 1 Z: 0");
    text = replaced(text, "X: 0.00 Y: 0.80 Z: 0.60", "X: 0 Y: 0 Z: 1");
    text = replaced(text, "X: 1.00 Y: 28.00 Z: -5.00", "X: 2 Y: 22 Z: -3");
    text = replaced(text, "SIZE: 30", "SIZE: 24");
    EXPECT_EQ(six_digits(leaf_surface(text, {1, 1}).end_point), "0.166667 1.83333 -0.25");
}

TEST(PredefinedSurfaces, WithNeighboursOfOneSideAreIgnored) {
    ViewFiles files;
    files.add("leaf.s", replaced(kLeaf, "A: Left", "A: ~"));
    const View view = files.read("surface: l leaf.s 1\n");
    EXPECT_TRUE(view.surfaces.empty());
    EXPECT_EQ(
        files.notices(),
        (std::vector<std::string>{"leaf.s: the surface is ignored (patch 'Left' names "
                                  "'Right' as its neighbour B, but is not its A)"}));
}

TEST(PredefinedSurfaces, HaveALimitedNumberOfTriangles) {
    ViewFiles files;
    files.add("leaf.s", kLeaf);
    EXPECT_EQ(
        files.errors("surface: l leaf.s 1 201 2"),
        "tree.v:1: the number of divisions s is '201' (it is an integer from 1 to 200)");
    std::string many = kLeaf;
    many = replaced(many, "B: Right", "B: ~");
    const std::string patch =
        many.substr(many.find("Left"), many.find("Right") - many.find("Left"));
    for (int i = 0; i < 6; ++i) {
        many += patch;
    }
    files.add("many.s", replaced(many, "A: Left", "A: ~"));
    EXPECT_EQ(
        files.errors("surface: l many.s 1 200 200"),
        "many.s: the surface has 8 patches of 200 x 200 divisions (PRECISION or the view file "
        "gives integers from 1 on, for at most 500000 triangles); write 'surface: x file size s "
        "t' in the view file");
}

TEST(ViewFiles, HaveDefaults) {
    const View view = ViewFiles().read("");
    EXPECT_EQ(view.angle_deg, 45);
    EXPECT_EQ(view.line_width, 1);
    EXPECT_EQ(view.color, 128);
    EXPECT_EQ(view.contour_sides, 8);
    EXPECT_TRUE(view.interprets_past_cut);
    EXPECT_FALSE(view.passes_before_display);
}

TEST(ViewFiles, SetTheTurtle) {
    ViewFiles files;
    const View view = files.read(
        "angle increment: 30\nAngle  Factor: 6\r\n\n"
        "initial line width: 2 pixels\nline width increment: 0.25\n"
        "initial scale: 10\nscale multiplier: 4\n"
        "initial color: 3 4\ncolor increment: -2\ncontour sides: 4\n"
        "initial elasticity: 0.2\nelasticity increment: 0.1\n"
        "tropism direction: 0.0,-2.0,0.0\n"
        "interpretation past %: off\nenvironment display: before\n"
        "box: x: -1,1 y: 0,2 z:-3,3\n");
    EXPECT_EQ(view.angle_deg, 60);
    EXPECT_EQ(view.line_width, 2);
    EXPECT_EQ(view.line_width_increment, 0.25);
    EXPECT_EQ(view.scale, 10);
    EXPECT_EQ(view.scale_multiplier, 4);
    EXPECT_EQ(view.color, 3);
    EXPECT_EQ(view.color_increment, -2);
    EXPECT_EQ(view.contour_sides, 4);
    EXPECT_EQ(view.elasticity, 0.2);
    EXPECT_EQ(view.elasticity_increment, 0.1);
    EXPECT_EQ(view.old_tropism, (Vec3{0, -1, 0}));
    EXPECT_FALSE(view.interprets_past_cut);
    EXPECT_TRUE(view.passes_before_display);
    EXPECT_TRUE(files.notices().empty());
}

TEST(ViewFiles, GiveLineWidthsWithUnits) {
    for (const char* const width : {"2", "2p", "2 p", "2pixels", "2e0 s", "2.0"}) {
        EXPECT_EQ(ViewFiles().read(std::string("initial line width: ") + width).line_width, 2)
            << width;
    }
}

TEST(ViewFiles, SkipLabelsOfTheScreen) {
    ViewFiles files;
    static_cast<void>(
        files.read("scale factor: 1\nviewpoint: 0,0,1\nview reference point: 0,0,0\ntwist: 0\n"
                   "projection: parallel\nfront distance: -1000\nback distance: 1000\n"
                   "line style: pixel\nz buffer: on\n"));
    EXPECT_TRUE(files.notices().empty());
}

TEST(ViewFiles, WarnOfUnknownLabelsOnce) {
    ViewFiles files;
    static_cast<void>(files.read("angel factor: 6\nbanana: 3\nangel factor: 7\nno label\n"));
    EXPECT_EQ(
        files.notices(),
        (std::vector<std::string>{
            "tree.v:1: label 'angel factor' is unknown and ignored; did you mean 'angle "
            "factor'?",
            "tree.v:2: label 'banana' is unknown and ignored",
            "tree.v:4: 'no label' is ignored (lines are 'label: value')"}));
}

TEST(ViewFiles, WarnOfUnsupportedShapes) {
    ViewFiles files;
    static_cast<void>(files.read("tsurface: t leaf.ray 1\nline: l 1\n"));
    EXPECT_EQ(
        files.notices(), (std::vector<std::string>{
                             "tree.v:1: this predefined shape is not supported and ignored",
                             "tree.v:2: this predefined shape is not supported and ignored"}));
}

TEST(ViewFiles, CountTropismsByTheirIntensity) {
    const View view = ViewFiles().read(
        "tropism: T: 0 2 0 I: 3 E: 0.1\n"
        "tropism: T: 0 0.5 0 I: 1 E: 0.1 S:0.02\n"
        "tropism: T:0,3,0 A: 30 E: 0.1\n"
        "torque: T: 0 0 5 I: 0.5\n");
    ASSERT_EQ(view.tropisms.size(), 4U);
    EXPECT_EQ(view.tropisms[0].direction, (Vec3{0, 1, 0}));
    EXPECT_EQ(view.tropisms[0].intensity, 2);
    EXPECT_EQ(view.tropisms[0].elasticity, 0.1);
    EXPECT_EQ(view.tropisms[1].intensity, 0.5);
    EXPECT_EQ(view.tropisms[1].step, 0.02);
    EXPECT_EQ(view.tropisms[2].intensity, 1);
    EXPECT_EQ(view.tropisms[2].angle_deg, 30);
    EXPECT_EQ(view.tropisms[2].direction, (Vec3{0, 1, 0}));
    EXPECT_FALSE(view.tropisms[2].is_torque);
    EXPECT_TRUE(view.tropisms[3].is_torque);
    EXPECT_EQ(view.tropisms[3].intensity, 0.5);
    EXPECT_EQ(view.tropisms[3].direction, (Vec3{0, 0, 1}));
}

TEST(ViewFiles, TurnOffTropismsWithoutADirection) {
    ViewFiles files;
    const View view = files.read("tropism: I: 3 T: 0 2 0 E: 0.1\ntropism: T: 0 0 0 E: 0.1\n");
    ASSERT_EQ(view.tropisms.size(), 2U);
    EXPECT_EQ(view.tropisms[0].direction, Vec3{});
    EXPECT_EQ(view.tropisms[1].direction, Vec3{});
    EXPECT_EQ(files.notices().size(), 2U);
}

TEST(ViewFiles, NumberTheirFunctionsInOrder) {
    ViewFiles files;
    files.add("f.func", kBumps);
    const View view = files.read("function: f.func\nfunction: none.func\nfunction: f.func 50\n");
    ASSERT_EQ(view.functions.size(), 3U);
    EXPECT_TRUE(view.functions[0].table.empty());
    EXPECT_EQ(view.functions[1].value(0.5), 0);
    EXPECT_EQ(view.functions[2].table.size(), 50U);
    EXPECT_EQ(
        files.notices(),
        (std::vector<std::string>{"tree.v:2: function 2, which is 0, is ignored: "
                                  "/models/plants/none.func: can't be read (no such file)"}));
}

TEST(ViewFiles, ReplaceFunctionsByASet) {
    ViewFiles files;
    files.add("f.func", kBumps);
    files.add("set.fset", kFunctionSet);
    const View view = files.read("function: f.func\nfunction set: set.fset\nfunction: f.func\n");
    ASSERT_EQ(view.functions.size(), 3U);
    EXPECT_EQ(six_digits(view.functions[0].value(0.2)), "0.200856");
    EXPECT_EQ(files.notices().size(), 1U);
}

TEST(ViewFiles, WarnOfMissingFiles) {
    ViewFiles files;
    const View view = files.read(
        "surface: l none.s 1\ncontour: 1 none.con\nfunction set: none.fset\ncurve: none.crv\n");
    EXPECT_TRUE(view.surfaces.empty());
    EXPECT_TRUE(view.contours.empty());
    EXPECT_TRUE(view.functions.empty());
    ASSERT_EQ(view.curves.size(), 1U);
    EXPECT_EQ(view.curves[0].at(0.5), Vec3{});
    EXPECT_EQ(files.notices().size(), 4U);
}

TEST(ViewFiles, ReadTheFilesBesideThem) {
    ViewFiles files;
    files.add("leaf.s", kLeaf);
    files.add("c.con", straight_points("cver 1 3", 6));
    files.add("c.crv", straight_points("version: 1.4", 6));
    const View view = files.read("surface: l leaf.s 2 1 1\ncontour: 7 c.con\ncurve: c.crv 10\n");
    EXPECT_EQ(view.surfaces.at('l').mesh->size(), 4U);
    EXPECT_EQ(view.surfaces.at('l').name, 'l');
    EXPECT_EQ(view.contours.at(7).points.size(), 6U);
    EXPECT_EQ(view.curves[0].lengths.size(), 10U);
    EXPECT_TRUE(files.notices().empty());
}

TEST(ViewFiles, NameFilesRelativeToIncludedFiles) {
    const PreprocessedText text{
        "function: f.func\nfunction: g.func\nbanana: 1\n",
        {{0, 3}, {1, 1}, {1, 7}},
        {"plants/tree.v", "parts/leaf.v"}};
    std::vector<std::string> paths, sent;
    InputFiles files("/models", [&](const std::filesystem::path& path) {
        paths.push_back(path.string());
        return std::string(kBumps);
    });
    Notices notices([&](const std::string& notice) { sent.push_back(notice); });
    EXPECT_EQ(read_view(text, files, notices).functions.size(), 2U);
    EXPECT_EQ(paths, (std::vector<std::string>{"/models/plants/f.func", "/models/parts/g.func"}));
    EXPECT_EQ(
        sent, (std::vector<std::string>{"parts/leaf.v:7: label 'banana' is unknown and ignored"}));
}

TEST(ViewFiles, ReportAllErrorsAtOnce) {
    ViewFiles files;
    files.add("f.func", "range: 0 1\npoints: 4\n0 0\n0.3 x\n");
    files.add("few.func", "range: 0 1\npoints: 2\n0 0\n1 1\n");
    files.add("no.con", "hello\n");
    files.add("s.s", "0 1 0 1 0 1\nSIZE: 1\n");
    EXPECT_EQ(
        files.errors("angle increment: x\nfunction: f.func\nfunction: few.func\n"
                     "contour: 1 no.con\nsurface: s s.s 1 2 2\nsurface: long s.s 1\n"
                     "tropism: T: 0 1\n"),
        "tree.v:1: the value is 'x' (it is a number from -1e+30 to 1e+30)\n"
        "f.func:4: the y of a point is 'x' (it is a number from -1e+30 to 1e+30)\n"
        "few.func:4: there are only 2 points (at least 4 are needed, repeated ones "
        "included)\n"
        "no.con:1: this is another kind of file (its first line is 'cver 1 3')\n"
        "s.s:2: there is no patch (a surface needs at least one)\n"
        "tree.v:6: the surface is called 'long' (the name of a surface is one character); "
        "write 'surface: l leaf.s 1'\n"
        "tree.v:7: a coordinate of T is missing (it is a number from -1e+30 to 1e+30)");
}

TEST(ViewFiles, NameTheirLimits) {
    ViewFiles files;
    files.add("f.func", "range: 0 1\npoints: 1000000000\n");
    files.add("m.func", "fver 1 1\npoints: 2\n0 0 6000\n1 1 6000\n");
    EXPECT_EQ(
        files.errors("function: f.func\nfunction: m.func\ncurve: c.crv\ncontour sides: 1e9\n"),
        "f.func:2: the number of points is '1000000000' (it is an integer from 1 to "
        "10000)\n"
        "m.func:4: there are too many points (at most 10000 are allowed, repeated ones "
        "included)\n"
        "tree.v:4: the number of sides is '1e9' (it is an integer from -1000 to 1000)");
}

TEST(ViewFiles, AcceptOrRefuseEveryBeginningOfTheirFiles) {
    for (const std::string& whole :
         {std::string(kBumps), std::string(kFunctionSet), std::string(kLeaf),
          straight_points("cver 1 3", 6), straight_points("version: 1.4", 6)}) {
        for (std::size_t size = 0; size < whole.size(); ++size) {
            ViewFiles files;
            files.add("x", whole.substr(0, size));
            for (const char* const label :
                 {"function: x", "function set: x", "surface: l x 1", "contour: 1 x", "curve: x"}) {
                static_cast<void>(files.errors(label));
            }
        }
    }
}

}  // namespace
}  // namespace quasimc::test
