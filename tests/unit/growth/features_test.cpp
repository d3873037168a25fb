#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

// A small plant for each feature and symbol that models of plants use.

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A plant, and its string and geometry.
Grown plant(
    int steps,
    const char* axiom,
    const std::string& productions,
    const char* view = "",
    const char* header = "") {
    Grown grown = grow(lsystem(steps, axiom, productions, header), view);
    EXPECT_EQ(grown.faults, Texts());
    return grown;
}

/// The shapes that an axiom draws, without the lines around them and the colour.
std::string drawn(const char* axiom, const char* view = "") {
    const std::string text = plant(0, axiom, "\n", view).geometry;
    const auto begin = text.find('\n', text.find("color"));
    const auto end = text.rfind("end\n");
    return begin == std::string::npos ? "" : text.substr(begin + 1, end - begin - 1);
}

TEST(PlantFeatures, AMonopodialShootWithLeaves) {
    const Grown grown = plant(
        3, "A(0)",
        "A(n) : n<2 --> I(1)[+(50)L(n)][-(50)L(n)]A(n+1)\nA(n) --> I(0.5)K\nI(x) --> I(x*2)");
    EXPECT_EQ(grown.text, "I(4)[+(50)L(0)][-(50)L(0)]I(2)[+(50)L(1)][-(50)L(1)]I(0.5)K");
}

TEST(PlantFeatures, DefinedConstantsAndFunctions) {
    const std::string model =
        "#define NODES 2\n#define GROWTH 1.5\n#define SIZE(n) (GROWTH^(n))\n#if NODES>1\n"
        "#define ANGLE 60\n#else\n#define ANGLE 30\n#endif\n" +
        lsystem(2, "A(0)", "A(n) : n<NODES --> F(SIZE(n))/(ANGLE)A(n+1)");
    EXPECT_EQ(grow(model).text, "F(1)/(60)F(1.5)/(60)A(2)");
}

TEST(PlantFeatures, IncludedFiles) {
    const TemporaryFolder folder;
    folder.write("angles.h", "#define ANGLE 25\n");
    folder.write("plant.v", "");
    folder.write("model.l", "#include \"angles.h\"\n" + lsystem(1, "A", "A --> +(ANGLE)F"));
    EXPECT_EQ(grow_in(folder).text, "+(25)F");
}

TEST(PlantFeatures, HomomorphismIntoShapes) {
    const Grown grown = plant(
        1, "A",
        "A --> I(2)K\nhomomorphism\nmaximum depth: 2\nI(x) --> !(x/10)F(x)\n"
        "K --> ;(5)P\nP --> @O(0.5)\n");
    EXPECT_EQ(grown.text, "I(2)K");
    EXPECT_EQ(grown.image, "!(0.2)F(2);(5)@O(0.5)");
    EXPECT_EQ(
        grown.geometry,
        "model\ncolor 128\ncylinder 0.1 0 0 0 0 2 0\ncolor 5\nsphere 0.25 0 2 0\nend\n");
}

TEST(PlantFeatures, DecompositionOfAnInternode) {
    EXPECT_EQ(
        plant(
            1, "A",
            "A --> I(3)\ndecomposition: no warnings\nmaximum depth: 9\n"
            "I(n) : n>1 --> S I(n-1)\nI(n) --> S")
            .text,
        "SSS");
}

TEST(PlantFeatures, AcropetalSignal) {
    EXPECT_EQ(plant(2, "B[+A]AA", "B < A --> B\nB --> A", "", "ignore: +").text, "A[+A]AB");
}

TEST(PlantFeatures, BasipetalSignal) {
    EXPECT_EQ(plant(2, "AA[+A]AB", "A > B --> B\nB --> A", "", "consider: AB").text, "AA[+B]AA");
}

TEST(PlantFeatures, BlocksOfTheRun) {
    EXPECT_EQ(
        plant(
            2, "A(0)", "A(t) : * {total=total+1;} --> A(time)B(total)", "",
            "Start: {time=0; dt=0.5; total=0;}\nStartEach: {time=time+dt;}\n"
            "EndEach: {if (time>0.7) {time=9;}}\nEnd: {printf(\"%g\",time);}")
            .printed,
        "9");
}

TEST(PlantFeatures, ConditionsWithBlocks) {
    EXPECT_EQ(
        plant(2, "A(1)", "A(x) : {y=x^2;} y<3 {z=sqrt(y+3);} --> F(z)A(x+1)\nA(x) : * --> B(x)")
            .text,
        "F(2)B(2)");
}

TEST(PlantFeatures, TablesInArrays) {
    EXPECT_EQ(
        plant(3, "A(0)", "A(n) --> F(len[n])A(n+1)", "", "define: { array len[3] = {3,2,1}; }")
            .text,
        "F(3)F(2)F(1)A(3)");
}

TEST(PlantFeatures, AChoiceWithASeed) {
    const std::string text =
        plant(6, "A", "A --> F[+A]A : 0.3\nA --> F[-A]A : 0.3\nA --> F : 0.4", "", "seed: 7").text;
    EXPECT_EQ(text.find("F[+"), 0U);
}

TEST(PlantFeatures, AFilamentInARing) {
    EXPECT_EQ(plant(2, "ABAA", "A > B --> B\nB --> A", "", "ring lsystem").text, "AAAB");
}

TEST(PlantFeatures, ASubsystemForTheInflorescence) {
    const Grown grown = grow(
        "Lsystem: 1\nderivation length: 3\naxiom: A(0)\nA(n) : n<1 --> F A(n+1)\n"
        "A(n) --> ?(2,0.5)B(1)$\nendlsystem\n"
        "Lsystem: 2\naxiom: B\nB(n) --> F(n)[+B(n/2)]B(n)\nendlsystem\n");
    EXPECT_EQ(grown.text, "F?(2,0.5)F(1)[+B(0.5)]B(1)$");
    EXPECT_NE(grown.geometry.find("cylinder 0.25 0 1 0 0 1.5 0"), std::string::npos)
        << grown.geometry;
}

TEST(PlantFeatures, FunctionsOfTheViewFile) {
    const TemporaryFolder folder;
    folder.write("grow.func", "range: 0 1\npoints: 4\n0 0\n0.333333 1\n0.666667 2\n1 3\n");
    folder.write("plant.v", "function: grow.func 100\n");
    folder.write(
        "model.l", lsystem(1, "A", "A --> F(floor(func(1,0.5)*10+0.5))F(floor(func(1,2)*10+0.5))"));
    EXPECT_EQ(grow_in(folder).text, "F(15)F(30)");
}

TEST(PlantSymbols, MoveAndDraw) {
    EXPECT_EQ(
        drawn("F(2)f(1)G(3)g(1)F"),
        "cylinder 0.5 0 0 0 0 2 0\ncylinder 0.5 0 3 0 0 6 0\ncylinder 0.5 0 7 0 0 8 0\n");
}

TEST(PlantSymbols, TurnPitchAndRoll) {
    const auto end_of = [](const char* turns) {
        const std::string axiom = std::string(turns) + "F(1)?P(7,7,7)";
        const std::string text = plant(0, axiom.c_str(), "\n", "angle factor: 4\n").text;
        return text.substr(text.find("?P"));
    };
    EXPECT_EQ(end_of("|").substr(0, 6), "?P(0,-");
    EXPECT_EQ(end_of("+").substr(0, 6), "?P(-1,");
    EXPECT_EQ(end_of("-").substr(0, 5), "?P(1,");
    const std::string pitched = end_of("&");
    EXPECT_EQ(pitched.substr(pitched.size() - 4), ",-1)");
    EXPECT_EQ(end_of("^").substr(end_of("^").size() - 3), ",1)");
    EXPECT_EQ(end_of("/+").substr(end_of("/+").size() - 4), ",-1)");
    EXPECT_EQ(end_of("\\+").substr(end_of("\\+").size() - 3), ",1)");
}

TEST(PlantSymbols, BranchAndReturn) {
    EXPECT_EQ(
        drawn("F[^(90)F(2)]F"),
        "cylinder 0.5 0 0 0 0 1 0\ncylinder 0.5 0 1 0 0 1 2\ncylinder 0.5 0 1 0 0 2 0\n");
}

TEST(PlantSymbols, ChangeColours) {
    const std::string text =
        plant(0, "F;F;(7)F,F,(300)F", "\n", "initial color: 1\ncolor increment: 2\n").geometry;
    std::string colors;
    for (auto at = text.find("color "); at != std::string::npos; at = text.find("color ", at + 1)) {
        colors += text.substr(at + 6, text.find('\n', at) - at - 6) + " ";
    }
    EXPECT_EQ(colors, "1 3 7 5 44 ");
}

TEST(PlantSymbols, ChangeWidths) {
    const char* view = "initial line width: 1\nline width increment: 0.5\n";
    EXPECT_EQ(drawn("F", view), "cylinder 0.5 0 0 0 0 1 0\n");
    EXPECT_EQ(drawn("#F", view), "cylinder 0.75 0 0 0 0 1 0\n");
    EXPECT_EQ(drawn("!F", view), "cylinder 0.25 0 0 0 0 1 0\n");
    EXPECT_EQ(drawn("#(4)F", view), "cylinder 2 0 0 0 0 1 0\n");
    EXPECT_EQ(drawn("!(4)F!(2)F", view), "cone 2 0 0 0 1 0 1 0\ncylinder 1 0 1 0 0 2 0\n");
}

TEST(PlantSymbols, DrawSpheresAndDiscs) {
    EXPECT_EQ(
        drawn("f@O(2)f@c(1)f@o(4)"),
        "sphere 1 0 1 0\ndisc 0.5 0 2 0 0 0 -1\ndisc 2 0 3 0 0 0 -1\n");
}

TEST(PlantSymbols, DrawPolygons) {
    EXPECT_EQ(drawn("{.f(1).-(90)f(1).}"), "polygon 0 0 0 0 1 0 0 1 0 1 1 0 1 1 0\n");
}

TEST(PlantSymbols, DrawSurfaces) {
    const TemporaryFolder folder;
    std::string surface =
        "0 1 0 1 0 0\nPRECISION S: 1 T: 1\nCONTACT POINT X: 0 Y: 0 Z: 0\n"
        "END POINT X: 0 Y: 1 Z: 0\nHEADING X: 0 Y: 1 Z: 0\nUP X: 0 Y: 0 Z: 1\nSIZE: 1\n"
        "leaf\nTOP COLOR: 1 DIFFUSE: 0.5 BOTTOM COLOR: 1 DIFFUSE: 0.5\n"
        "AL: ~ A: ~ AR: ~\nL: ~ R: ~\nBL: ~ B: ~ BR: ~\n";
    for (int row = 0; row < 4; ++row) {
        surface += fmt::format("0 {0} 0 0.3 {0} 0 0.6 {0} 0 1 {0} 0\n", row / 3.0);
    }
    folder.write("leaf.s", surface);
    folder.write("plant.v", "surface: l leaf.s 2\n");
    folder.write("model.l", lsystem(1, "A", "A --> F~l(1.5)?P(8,8)"));
    const Grown grown = grow_in(folder, nullptr, GrownParts::all);
    EXPECT_EQ(grown.faults, Texts());
    EXPECT_EQ(grown.text, "F~l(1.5)?P(0,4)") << "the turtle moves to the end point";
    EXPECT_NE(grown.geometry.find("instance l"), std::string::npos) << grown.geometry;
}

TEST(PlantSymbols, DrawGeneralizedCylinders) {
    const std::string text = drawn("@!(4)@Gs f(1)@Gc(2)f(1)@Ge(1)");
    std::size_t triangles = 0;
    for (auto at = text.find("triangle"); at != std::string::npos;
         at = text.find("triangle", at + 1)) {
        ++triangles;
    }
    EXPECT_EQ(triangles, 3U * 4U * 2U);
    EXPECT_EQ(drawn("@Gs@#(0)@Gt(1,1)@Gr(0,1)").find("triangle"), std::string::npos);
}

TEST(PlantSymbols, BendAndOrient) {
    const char* view = "tropism: T: 0,-1,0 A: 0 I: 1 E: 0.2 S: 0.1\n";
    EXPECT_EQ(
        plant(0, "+(90)F(1)@Ts(1,0)F(1)?H(9,9,9)@Tf@v@R(0,0,1)F(1)?P(9,9,9)", "\n", view).text,
        "+(90)F(1)@Ts(1,0)F(1)?H(-0.980067,-0.198669,0)@Tf@v@R(0,0,1)F(1)?P(-1.96013,-0.397339,1)");
    EXPECT_EQ(plant(0, "@M(1,2,3)F(1)?P(9,9,9)", "\n").text, "@M(1,2,3)F(1)?P(1,3,3)");
}

TEST(PlantSymbols, BendByTheOldElasticity) {
    const std::string text =
        plant(0, "+(90)_(0.5)F(1)?H(9,9)", "\n", "tropism direction: 0,-1,0\n").text;
    EXPECT_EQ(text.find("?H(-0.8"), 15U) << text;
}

TEST(PlantSymbols, AreSkippedIfTheyDrawNothing) {
    const Grown grown = plant(0, "F@Tx(3)F@L(1)FXYZ", "\n");
    EXPECT_EQ(grown.notices, Texts());
    EXPECT_NE(grown.geometry.find("0 2 0 0 3 0"), std::string::npos) << grown.geometry;
}

TEST(PlantSymbols, ThatAreUnknownWarn) {
    const Grown grown = plant(0, "F@qF@Gx@Ts(9,1)F@q", "\n");
    EXPECT_EQ(grown.notices.size(), 3U);
}

}  // namespace
}  // namespace quasimc::test
