#include "growth/turtle/turtle.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "growth/module_string.h"
#include "growth/turtle/mesh_drawing.h"
#include "growth/turtle/plain_geometry.h"

namespace quasimc {

namespace {

/// "F(1)[+(30)F]": symbols with numbers.
ModuleString turtle_commands(std::string_view text) {
    ModuleString string;
    for (std::size_t i = 0; i < text.size();) {
        const char symbol = text[i++];
        std::vector<double> parameters;
        if (i < text.size() && text[i] == '(') {
            const char* p = &text[i];
            while (*p != ')') {
                parameters.push_back(0);
                p = std::from_chars(p + 1, text.data() + text.size(), parameters.back()).ptr;
            }
            i = static_cast<std::size_t>(p - text.data()) + 1;
        }
        string.append(symbol, parameters);
    }
    return string;
}

/// A turtle that has executed commands. Modules are numbered.
class Walked {
  public:
    explicit Walked(
        std::string_view text,
        const View& view = {},
        Drawing* drawing = nullptr,
        Turtle::Commands commands = Turtle::Commands::all)
        : view_(view),
          notices_([this](const std::string& notice) { texts_.push_back(notice); }),
          turtle_(view_, notices_, commands) {
        turtle_.set_drawing(drawing);
        walk(text);
        turtle_.finish();
    }

    void walk(std::string_view text) {
        const ModuleString string = turtle_commands(text);
        std::size_t index = 0;
        for (auto p = ModuleString::begin(); p < string.end();) {
            turtle_.begin_module({string.symbol(p), index++, 0, 0});
            p = turtle_.execute(string, p);
        }
    }

    [[nodiscard]] Turtle& turtle() { return turtle_; }
    [[nodiscard]] const TurtleFrame& frame() const { return turtle_.frame(); }
    [[nodiscard]] const std::vector<std::string>& notices() const { return texts_; }

  private:
    View view_;
    std::vector<std::string> texts_;
    Notices notices_;
    Turtle turtle_;
};

View turtle_view() {
    View view;
    view.color = 1;
    view.contour_sides = 4;
    return view;
}

std::string geometry(std::string_view text, const View& view = turtle_view()) {
    PlainGeometry lines(view);
    const Walked walked(text, view, &lines);
    return lines.text();
}

std::vector<DrawnOrgan> organs(std::string_view text, const View& view = turtle_view()) {
    MeshDrawing meshes(view.contour_sides);
    const Walked walked(text, view, &meshes);
    return meshes.take_organs();
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-6) {
    EXPECT_LT(length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " instead of " << b.x << ' ' << b.y << ' ' << b.z;
}

View surface_view() {
    View view = turtle_view();
    BezierSurface& leaf = view.surfaces['l'];
    leaf.name = 'l';
    leaf.mesh = std::make_shared<Mesh>(Mesh{Triangle{Vec3{0, 0, 0}, Vec3{1, 2, 0}, Vec3{0, 2, 1}}});
    leaf.end_point = {0, 2, 1};
    leaf.control_bounds.add({-1, 0, 0});
    leaf.control_bounds.add({1, 3, 0});
    return view;
}

TEST(Turtle, StartsUpright) {
    const Walked walked("");
    EXPECT_EQ(walked.frame().position, (Vec3{0, 0, 0}));
    EXPECT_EQ(walked.frame().heading, (Vec3{0, 1, 0}));
    EXPECT_EQ(walked.frame().left, (Vec3{-1, 0, 0}));
    EXPECT_EQ(walked.frame().up, (Vec3{0, 0, -1}));
}

TEST(Turtle, TurnsAboutItsThreeAxes) {
    Walked walked("F(1)+(30)f(2)&(30)/(30)");
    const double h = std::sqrt(3) / 2;
    expect_near(walked.frame().position, {-1, 1 + 2 * h, 0});
    expect_near(walked.frame().heading, {-h / 2, h * h, -0.5});
    expect_near(walked.frame().left, {-0.625, -0.649519, -0.433013});
    expect_near(walked.frame().up, {0.649519, -0.125, -0.75});
    walked.walk("\\(30)^(30)-(30)");
    expect_near(walked.frame().heading, {0, 1, 0});
    walked.walk("|");
    expect_near(walked.frame().heading, {0, -1, 0});
    expect_near(walked.frame().left, {1, 0, 0});
    expect_near(walked.frame().up, {0, 0, -1});
}

TEST(Turtle, HasTheRoundingOfARightAngle) {
    EXPECT_EQ(Walked("+(90)F(1)").frame().position, (Vec3{-1, std::cos(std::acos(-1) / 2), 0}));
}

TEST(Turtle, UsesTheAngleAndTheScaleOfTheView) {
    View view;
    view.angle_deg = 60;
    view.scale = 10;
    view.scale_multiplier = 4;
    expect_near(Walked("F", view).frame().position, {0, 10, 0});
    expect_near(Walked("@D(2)F(1)@Di(3)f(1)@Dd(2)G[@Dig(1)]", view).frame().position, {0, 11, 0});
    EXPECT_EQ(Walked("@D(2)F(1)@Di(3)f(1)@Dd(2)G@Di", view).turtle().scale(), 12);
    expect_near(Walked("@D(3)@M(0,0,0)F+F", view).frame().position, {-2.598076, 4.5, 0});
}

TEST(Turtle, BendsByTheOldElasticity) {
    View view;
    view.old_tropism = {0, -1, 0};
    view.elasticity = 0.2;
    view.elasticity_increment = 0.1;
    Walked walked("+(90)F(1)", view);
    expect_near(walked.frame().position, {-1, 0, 0});
    expect_near(walked.frame().heading, {-0.979796, -0.2, 0});
    walked.walk("F(1)_F(1)");
    expect_near(walked.frame().heading, {-0.778374, -0.627801, 0}, 2e-6);
    walked.walk("_(0)F(1)/(30)_(0.3)F");
    expect_near(walked.frame().heading, {-0.611236, -0.791446, -0.00208915}, 2e-6);
    expect_near(walked.frame().left, {0.681379, -0.524884, -0.510117}, 2e-6);
    expect_near(walked.frame().up, {-0.402634, 0.313225, -0.860102}, 2e-6);
}

View tropism_view() {
    View view;
    view.tropisms = {
        {false, {0, 1, 0}, 0, 2, 0.1, 0.02},
        {false, {0, 1, 0}, 0, 0.5, 0.1, 0},
        {false, {0, 1, 0}, 0, 1, 0.1, 0},
        {true, {0, 0, 1}, 0, 0.5, 0, 0}};
    return view;
}

TEST(Turtle, BendsByTropismsAndTorques) {
    Walked walked("+(60)F(1)", tropism_view());
    expect_near(walked.frame().heading, {-0.677302, 0.735705, 0});
    walked.walk("[@Ts(1,0.1)@Ts(2,0)@Ts(3,0)F(1)");
    expect_near(walked.frame().heading, {-0.571743, 0.820433, 0});
    walked.walk("][@Ts(1,0)@Ts(2,0.1)@Ts(3,0)F(1)");
    expect_near(walked.frame().heading, {-0.652003, 0.758216, 0});
    walked.walk("][@Ts(1,0)@Ts(2,0)@Ts(3,0)@Ts(4,0.2)/(30)F(1)");
    expect_near(walked.frame().up, {0.335549, 0.308912, -0.889933});
}

TEST(Turtle, BendsByTropismsWithAngles) {
    View view;
    view.tropisms = {
        {true, {0.6, 0, 0.8}, 70, 1.5, 0.2, 0},
        {false, {0, 0.6, 0.8}, 35, 2, 0.1, 0},
        {false, {1, 0, 0}, 90, 1, 0.2, 0}};
    const Walked walked("&(50)F(1)+(30)/(20)@TfF(1)[/(40)@Tp]-(10)F(1)", view);
    expect_near(walked.frame().position, {-0.56953308, 2.55887964, -1.28279614});
    expect_near(walked.frame().heading, {-0.17545024, 0.94387144, -0.27986409});
    expect_near(walked.frame().left, {-0.95377845, -0.09251609, 0.28591509});
    expect_near(walked.frame().up, {-0.24397516, -0.31709221, -0.91647621});
}

TEST(Turtle, StepsElasticities) {
    const std::string off = "@Ts(2,0)@Ts(3,0)";
    const auto heading = [&off](const std::string& text) {
        return Walked(off + text + "+(60)F", tropism_view()).frame().heading;
    };
    expect_near(heading("@Ti(1)@Td(1,0.05)"), heading("@Ts(1,0.07)"));
    expect_near(heading("@Ti@Td(1)"), heading("@Ts(1,0.08)"));
    const Walked walked("@Ts(9,1)", tropism_view());
    EXPECT_EQ(walked.notices().size(), 1U);
}

TEST(Turtle, TropismsUndoRollsUnlessTheFrameIsSet) {
    const Walked lost("+(60)/(30)F", tropism_view());
    expect_near(lost.frame().up, {0, 0, -1});
    const Walked set("+(60)/(30)@TfF", tropism_view());
    EXPECT_LT(set.frame().up.z, -0.8);
    EXPECT_GT(set.frame().up.z, -0.9);
}

TEST(Turtle, IsOrientedByVectors) {
    const Walked both("@R(2,0,0,0,0,3)");
    EXPECT_EQ(both.frame().heading, (Vec3{1, 0, 0}));
    EXPECT_EQ(both.frame().up, (Vec3{0, 0, 1}));
    EXPECT_EQ(both.frame().left, (Vec3{0, -1, 0}));
    const Walked least("/(40)@R(1,0,0)");
    expect_near(least.frame().up, {0, 0, -1});
    expect_near(least.frame().left, {0, 1, 0});
    expect_near(Walked("+(20)@R(0,0,0)").frame().heading, {0, 1, 0});
    expect_near(Walked("@R(0,0,0,1,1,0)").frame().up, {0, 0, -1});  // up is not across
    expect_near(Walked("@R(0,0,0,2,0,0)").frame().up, {1, 0, 0});
}

TEST(Turtle, MakesItsLeftSideHorizontal) {
    const Walked walked("&(40)/(25)+(10)@v");
    const TurtleFrame& frame = walked.frame();
    EXPECT_NEAR(frame.left.y, 0, 1e-15);
    EXPECT_LT(frame.up.y, 0);
    expect_near(cross(frame.left, frame.heading), frame.up);
    expect_near(Walked("/(25)@v").frame().up, Walked("/(25)").frame().up);
}

TEST(Turtle, BracketsRestoreTheState) {
    View view;
    view.line_width_increment = 0.5;
    Walked walked("F[+(30)##@Di(2);(3)F]", view);
    expect_near(walked.frame().position, {0, 1, 0});
    EXPECT_EQ(walked.turtle().line_width(), 1);
    EXPECT_EQ(walked.turtle().scale(), 1);
    walked.walk("]");
    ASSERT_EQ(walked.notices().size(), 1U);
    EXPECT_NE(walked.notices()[0].find("']'"), std::string::npos);
}

TEST(Turtle, MovesOnlyWithoutWidths) {
    Walked walked("#(3)!F@D(2)", {}, nullptr, Turtle::Commands::moves);
    EXPECT_EQ(walked.turtle().line_width(), 1);
    EXPECT_EQ(walked.turtle().scale(), 2);
    walked.turtle().set_commands(Turtle::Commands::all);
    walked.walk("#(3)");
    EXPECT_EQ(walked.turtle().line_width(), 6);
}

TEST(Turtle, KeepsAStateToContinueFrom) {
    Walked walked("F+(30)@Ts(1,0.3)#(2)", tropism_view());
    const auto state = walked.turtle().state();
    const TurtleFrame frame = walked.frame();
    walked.walk("FF@Ts(1,0)");
    walked.turtle().set_state(*state);
    EXPECT_EQ(walked.frame().position, frame.position);
    EXPECT_EQ(walked.turtle().line_width(), 2);
}

TEST(Turtle, SubsystemsScale) {
    Walked walked("F");
    walked.turtle().enter_subsystem(0.5);
    EXPECT_EQ(walked.turtle().line_width(), 0.5);
    walked.walk("F");
    expect_near(walked.frame().position, {0, 1.5, 0});
    walked.turtle().leave_subsystem();
    EXPECT_EQ(walked.turtle().scale(), 1);
    EXPECT_EQ(walked.turtle().line_width(), 1);
}

TEST(Turtle, SkipsSymbolsAndWarnsOnce) {
    const Walked walked("A(1)..}}@q(3)@Gx(2)@qF@S@");
    expect_near(walked.frame().position, {0, 1, 0});
    EXPECT_EQ(walked.notices().size(), 6U);  // . } @q @Gx @S @
}

TEST(Turtle, BoundsHoldAllPositionsSpheresAndSurfaces) {
    const Bounds moves = Walked("f(2)[+(90)G(3)]@M(0,0,5)").turtle().bounds();
    expect_near(moves.low, {-3, 0, 0});
    expect_near(moves.high, {0, 2, 5});
    expect_near(Walked("@O(4)").turtle().bounds().low, {-2, -2, -2});
    const Bounds leaf = Walked("~l(2)", surface_view()).turtle().bounds();
    expect_near(leaf.low, {-2, 0, -2});
    expect_near(leaf.high, {2, 6, 0});
}

TEST(TurtleDrawing, SegmentsEndWithTheWidthOfTheNextNode) {
    EXPECT_EQ(
        geometry("F#(2)F;(7)F[#(4)F]f#(1)F(0)F(-1)"),
        "model\n"
        "color 1\n"
        "cone 0.5 0 0 0 1 0 1 0\n"
        "cylinder 1 0 1 0 0 2 0\n"
        "color 7\n"
        "cylinder 1 0 2 0 0 3 0\n"
        "cylinder 2 0 3 0 0 4 0\n"
        "cylinder 0.5 0 4 0 0 3 0\n"
        "end\n");
}

TEST(TurtleDrawing, ColoursAndWidthsHaveIncrements) {
    View view = turtle_view();
    view.color_increment = 2;
    view.line_width_increment = 0.25;
    EXPECT_EQ(
        geometry(";(255);#F,,!F@D(2)!F#(3)F", view),
        "model\n"
        "color 1\n"
        "cone 0.625 0 0 0 0.5 0 1 0\n"
        "color 253\n"
        "cone 0.5 0 1 0 0.25 0 2 0\n"
        "cone 0.25 0 2 0 3 0 4 0\n"
        "cylinder 3 0 4 0 0 6 0\n"
        "end\n");
}

TEST(TurtleDrawing, PolygonsFollowTheSegmentsInThem) {
    EXPECT_EQ(
        geometry("{.f(1).+(90)f(1)}F{f[+(90)f.G]g(1)F;(5)}"),
        "model\n"
        "color 1\n"
        "polygon 0 0 0 0 1 0 0 1 0 -1 1 0\n"
        "cylinder 0.5 -1 1 0 -2 1 0\n"
        "cylinder 0.5 -3 0 0 -3 -1 0\n"
        "cylinder 0.5 -4 1 0 -5 1 0\n"
        "color 5\n"
        "polygon -3 1 0 -3 0 0 -3 0 0 -5 1 0\n"
        "end\n");
}

TEST(TurtleDrawing, PolygonsInPolygonsAreSeparate) {
    PlainGeometry lines(turtle_view());
    const View view = turtle_view();
    const Walked walked("{f{ff}f}", view, &lines);
    EXPECT_EQ(lines.text(), "model\ncolor 1\npolygon 0 2 0 0 3 0\npolygon 0 1 0 0 4 0\nend\n");
    EXPECT_EQ(walked.notices().size(), 1U);
}

TEST(TurtleDrawing, SpheresAndDiscsHaveDiameters) {
    EXPECT_EQ(
        geometry("#(0.5)@O@D(3)@O(2)&(90)@c(1)@bo(1)@L(1)@Tx(3)@o"),
        "model\n"
        "color 1\n"
        "sphere 0.25 0 0 0\n"
        "sphere 3 0 0 0\n"
        "disc 1.5 0 0 0 0 -1 0\n"
        "disc 0.25 0 0 0 0 -1 0\n"
        "end\n");
}

TEST(TurtleDrawing, SurfacesAreInstancesAndMoveTheTurtle) {
    EXPECT_EQ(
        geometry("@D(2)~l(1,2,3)~z(2)+(90)~l", surface_view()),
        "surface l\n"
        "triangle 0 0 0 1 2 0 0 2 1\n"
        "end\n"
        "model\n"
        "instance l -2 0 0 0 4 0 0 0 -6 0 0 0\n"
        "instance l 0 -2 0 -2 0 0 0 0 -2 0 4 -2\n"
        "end\n");
}

TEST(TurtleDrawing, GeneralizedCylindersAreHermiteCurves) {
    const std::string straight = geometry("#(1)@Gsf(1)#(0.5)f(1)@Ge(4)");
    EXPECT_EQ(std::count(straight.begin(), straight.end(), '\n'), 3 + 4 * 4 * 2);
    EXPECT_TRUE(
        straight.starts_with("model\n"
                             "color 1\n"
                             "triangle 0 0.5375 -0.4375 0.4375 0.5375 0 0 0 -0.5\n"
                             "triangle 0 0 -0.5 0.4375 0.5375 0 0.5 0 0\n"
                             "triangle 0.4375 0.5375 0 0 0.5375 0.4375 0.5 0 0\n"))
        << straight;
    const std::string bent = geometry("#(0.5)f(2)[+(90)@Gsf(1)&(40)f(1)@Gc(2)]");
    EXPECT_NE(
        bent.find("triangle -1.766 2.25 -0.64279 -1.9267 2 -0.45128 -0.94898 2.25 -0.14019\n"),
        std::string::npos)
        << bent;
}

TEST(TurtleDrawing, BracketsRestoreGeneralizedCylinders) {
    const std::string text = geometry("#(0.5)f(2)@!(3)@Gsf(1)[+(40)f(0.5)@Gc(1)f(1)@Ge(1)]f(1)@Ge");
    EXPECT_NE(
        text.find("triangle -0.96418 4.1491 -0.25 -0.79833 4.2882 0.125 -0.32139 3.383 -0.25\n"
                  "triangle -0.32139 3.383 -0.25 -0.79833 4.2882 0.125 -0.15554 3.5222 0.125\n"),
        std::string::npos);
    EXPECT_NE(
        text.find("triangle -0.21651 4 0.125 0 4 -0.25 -0.21651 3.4625 0.125\n"),
        std::string::npos);
}

TEST(TurtleDrawing, CurvesInBracesAreGeneralizedCylinders) {
    View view = turtle_view();
    view.contour_sides = 3;
    const std::string text = geometry(
        "#(0.2){(1).g(1).(2)+(40)g(1).(3)}(1)f(1)"
        "{(3).g(1).(2)+(90)g(1).(3)+(90)g(1).(1)+(90)g(1).(2)}(3)",
        view);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3 + 48);
    EXPECT_NE(
        text.find("triangle -0.64279 1.766 -0.1 -0.57645 1.8217 0.05 -0.36187 1.5201 -0.1\n"),
        std::string::npos);
    EXPECT_NE(
        text.find("triangle -2.3411 2.2991 -0.1 -2.4074 2.2434 0.05 -2.4596 2.6348 -0.1\n"),
        std::string::npos);
    const std::string ring = geometry("#(0.5){(2)f(1)+(70)#(0.2)f(1)&(80)f(1)}", view);
    EXPECT_NE(
        ring.find("triangle 0.0098476 1.3549 0.10625 -0.34366 1.1189 0.0875 "
                  "-0.19779 1.051 0.10625\n"),
        std::string::npos);
    const std::string spline = geometry("#(0.5){(4)f(1)+(70)#(0.2)f(1)&(80)f(1).(2)}", view);
    EXPECT_NE(
        spline.find("triangle -0.72094 1.1807 0.046757 -0.76444 1.2146 -0.24821 "
                    "-0.63927 1.1577 -0.19378\n"),
        std::string::npos);
    const std::string closed = geometry("{(2).f(1)+(90)f(1)+(90)f(1)}{(4)ffff}", view);
    EXPECT_EQ(std::count(closed.begin(), closed.end(), '\n'), 3 + 6 * (4 * 4) + 6 * (4 * 4));
}

TEST(TurtleDrawing, TangentsOfTheRadiusAndTheAxisCanBeGiven) {
    // The radius has a maximum halfway: tangents of slope 2 and -2 at a radius of 0.5 give 1.
    const double slope = std::atan(2) * 180 / std::acos(-1);
    const std::string steep = std::to_string(slope);
    const double size = std::sqrt(5);
    const std::string text = geometry(
        "@Gr(-" + steep + "," + std::to_string(size) + "," + steep + "," + std::to_string(size) +
        ")@Gsf(2)@Ge(2)");
    EXPECT_NE(text.find("triangle 0 1 -1 1 1 0 0 0 -0.5\n"), std::string::npos) << text;
    const std::string slow = geometry("@Gt(0,1.2)@Gsf(2)@Ge(2)");
    EXPECT_NE(slow.find("triangle 0 1.3 -0.5 0.5 1.3 0 0 0 -0.5\n"), std::string::npos) << slow;
}

TEST(TurtleDrawing, PatchesNeedAllTheirPoints) {
    std::string text = "@PS(7)";
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const std::string at = std::to_string(row) + "," + std::to_string(column);
            text += "@M(" + at + ",0)@PC(7," + at + ")";
        }
    }
    EXPECT_EQ(
        geometry(text + "@PD(7,1,2)"),
        "model\ncolor 1\n"
        "triangle 0 0 0 0 1.5 0 3 0 0\n"
        "triangle 3 0 0 0 1.5 0 3 1.5 0\n"
        "triangle 0 1.5 0 0 3 0 3 1.5 0\n"
        "triangle 3 1.5 0 0 3 0 3 3 0\n"
        "end\n");
    PlainGeometry lines(turtle_view());
    const View view = turtle_view();
    const Walked walked("@PS(1)@PC(1,0,4)@PC(2,0,0)@PD(1,2,2)", view, &lines);
    EXPECT_EQ(walked.notices().size(), 2U);
}

TEST(TurtleMeshes, OrgansAreModulesWithParts) {
    const auto all = organs("F;(3)~l@O#(2);(4){.f.+(90)f.}F", surface_view());
    ASSERT_EQ(all.size(), 5U);
    EXPECT_EQ(all[0].module.symbol, 'F');
    EXPECT_EQ(all[0].module.index, 0U);
    EXPECT_EQ(all[0].parts[0].color, 1);
    EXPECT_EQ(all[0].parts[0].triangles.size(), 8U);
    EXPECT_EQ(all[1].module.symbol, '~');
    EXPECT_EQ(all[1].parts[0].color, 3);
    EXPECT_EQ(all[1].parts[0].shared->size(), 1U);
    EXPECT_EQ(all[1].parts[0].transform.point({1, 2, 3}), (Vec3{-1, 3, -3}));
    EXPECT_EQ(all[2].module.symbol, '@');
    EXPECT_EQ(all[3].module.symbol, '}');
    EXPECT_EQ(all[3].parts[0].triangles.size(), 1U);
    EXPECT_EQ(all[3].parts[0].color, 4);
    EXPECT_EQ(all[4].module.symbol, 'F');
}

TEST(TurtleMeshes, SegmentsBelongToTheModulesThatBeganThem) {
    MeshDrawing meshes(4);
    const View view = turtle_view();
    Notices notices([](const std::string& /*text*/) {});
    Turtle turtle(view, notices);
    turtle.set_drawing(&meshes);
    const ModuleString string = turtle_commands("F@OFF");
    for (auto p = ModuleString::begin(); p < string.end();) {
        turtle.begin_module({p < 4 ? 'A' : 'B', p < 4 ? 0U : 1U, 0, 0});
        p = turtle.execute(string, p);
    }
    turtle.finish();
    ASSERT_EQ(meshes.organs().size(), 2U);
    EXPECT_EQ(meshes.organs()[0].parts.size(), 1U);
    EXPECT_EQ(meshes.organs()[0].parts[0].triangles.size(), 8U + 24 + 8);
    EXPECT_EQ(meshes.organs()[1].parts[0].triangles.size(), 8U);
}

TEST(TurtleMeshes, CylindersHaveOutwardSidesWithoutCaps) {
    const Mesh mesh = organs("F(3)")[0].parts[0].triangles;
    EXPECT_EQ(mesh.vertices[0], (Vec3{0.5, 0, 0}));
    EXPECT_EQ(mesh.vertices.size(), 8U);
    EXPECT_NEAR(area(mesh), 4 * std::sqrt(0.5) * 3, 1e-12);
    for (const std::string text : {"F(3)", "F(-3)"}) {
        const Mesh sides = organs(text)[0].parts[0].triangles;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const Vec3 center = (sides[i][0] + sides[i][1] + sides[i][2]) / 3;
            EXPECT_GT(dot(area_vector(sides[i]), {center.x, 0, center.z}), 0);
        }
    }
}

TEST(TurtleMeshes, ConnectedCylindersShareARingThatRollsDoNotTwist) {
    const auto all = organs("F+(20)/(50)F");
    const std::vector<Vec3>& first = all[0].parts[0].triangles.vertices;
    const std::vector<Vec3>& second = all[1].parts[0].triangles.vertices;
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(first[4 + k], second[k]);
    }
    const double bend = 20 * std::acos(-1) / 180;
    expect_near(
        second[4],
        Vec3{-std::sin(bend), 1 + std::cos(bend), 0} +
            0.5 * Vec3{std::cos(bend), std::sin(bend), 0},
        1e-12);
    const auto sharp = organs("F+(80)F");
    EXPECT_NE(sharp[0].parts[0].triangles.vertices[4], sharp[1].parts[0].triangles.vertices[0]);
}

TEST(TurtleMeshes, SpheresHavePolesAlongZ) {
    View view = turtle_view();
    view.contour_sides = 6;
    const Mesh mesh = organs("+(30)&(40)@O(2)", view)[0].parts[0].triangles;
    EXPECT_EQ(mesh.vertices.size(), 32U);
    EXPECT_EQ(mesh.size(), 60U);
    EXPECT_EQ(mesh.vertices[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(
        mesh.vertices[1], (Vec3{std::sin(std::acos(-1) / 6), 0, std::cos(std::acos(-1) / 6)}));
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        EXPECT_GT(dot(area_vector(mesh[i]), mesh[i][0] + mesh[i][1] + mesh[i][2]), 0);
    }
}

TEST(TurtleMeshes, DiscsStartOppositeToTheLeft) {
    const Mesh mesh = organs("@c(2)")[0].parts[0].triangles;
    ASSERT_EQ(mesh.size(), 4U);
    EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 0}));
    expect_near(mesh.vertices[2], {0, 1, 0}, 1e-15);
    EXPECT_GT(area_vector(mesh[0]).z, 0);
}

TEST(TurtleMeshes, PolygonsThatCrossOrAreTooSmallAreNoErrors) {
    EXPECT_TRUE(organs("{..f}").empty());
    EXPECT_TRUE(organs("{.f(1).f(1).f(1).}").empty());
    const auto crossing = organs("{.@M(1,1).@M(1,0).@M(0,1).}");
    ASSERT_EQ(crossing.size(), 1U);
    EXPECT_EQ(crossing[0].parts[0].triangles.size(), 2U);
    const auto concave = organs("{.@M(2,0).@M(0.5,0.5).@M(0,2).}");
    EXPECT_NEAR(area(concave.at(0).parts.at(0).triangles), 1, 1e-12);
}

TEST(TurtleMeshes, NumbersThatAreNotFiniteAreNotDrawn) {
    const std::string infinite = "F(1e38)@D(1e38)F(1e38)@D(1e38)@Di(1e38)@Di(1e38)@Di(1e38)";
    for (const DrawnOrgan& organ :
         organs(infinite + infinite + infinite + "FF@O@c{.f+f+f}#(1)F@Gsf@Ge")) {
        for (const DrawnPart& part : organ.parts) {
            for (const Vec3& vertex : part.triangles.vertices) {
                EXPECT_TRUE(is_finite(vertex));
            }
        }
    }
}

}  // namespace

}  // namespace quasimc
