#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// The homomorphic image of an axiom.
std::string image_of(const char* axiom, const std::string& productions) {
    return grow(lsystem(0, axiom, "homomorphism" + productions)).image;
}

TEST(PlantHomomorphism, LeavesTheString) {
    const Grown grown =
        grow(lsystem(1, "A(2)B", "A(x) --> A(x+1)\nhomomorphism\nA(x) --> F(x)+\n"));
    EXPECT_EQ(grown.text, "A(3)B");
    EXPECT_EQ(grown.image, "F(3)+B");
}

TEST(PlantHomomorphism, IsRecursiveToItsDepth) {
    EXPECT_EQ(image_of("A", "\nA --> BA"), "BA");
    EXPECT_EQ(image_of("A", "\nmaximum depth: 3\nA --> BA"), "BBBA");
    EXPECT_EQ(
        image_of("A(3)", ": no warnings\nmaximum depth: 20\nA(n) : n>0 --> F(n)[A(n-1)]A(n-2)"),
        "F(3)[F(2)[F(1)[A(0)]A(-1)]A(0)]F(1)[A(0)]A(-1)");
}

TEST(PlantHomomorphism, TakesTheFirstProductionThatApplies) {
    EXPECT_EQ(image_of("A(1)A(2)A", "\nA(x) : x>1 --> B\nA(x) --> C\nA(x) --> D"), "CBA");
}

TEST(PlantHomomorphism, HasTheContextOfTheString) {
    EXPECT_EQ(
        image_of("XA[Y]Z", "\nmaximum depth: 2\nX < A > Z --> BC\nB > C --> n\nX < B --> y"),
        "XyC[Y]Z");
}

TEST(PlantHomomorphism, MayConsumeSeveralModules) {
    EXPECT_EQ(image_of("AABABC", "\nAB --> X\nA --> Y"), "YXXC");
}

TEST(PlantHomomorphism, RunsBlocksAtEachInterpretation) {
    const Grown grown = grow(lsystem(
        0, "A(1)A(2)", "homomorphism\nA(x) : {y=x*2;} y>0 {n=n+1;} --> F(y,n)\n", "Start: {n=0;}"));
    EXPECT_EQ(grown.image, "F(2,3)F(4,4)") << "the first interpretation ended the growth";
}

TEST(PlantHomomorphism, SharesTheGeneratorOfRandomNumbers) {
    const Grown grown =
        grow(lsystem(1, "A", "A --> A(ran(1))\nhomomorphism\nA(x) --> F(x,ran(1))\n"));
    EXPECT_EQ(grown.text, "A(0.170828)");
    EXPECT_NE(grown.image, "F(0.170828,0.170828)");
}

TEST(PlantHomomorphism, IgnoresItsOwnCuts) {
    const Grown grown = grow(lsystem(0, "A", "homomorphism\nA --> F%F?P(0,0)\n"));
    EXPECT_EQ(grown.image, "F%F?P(0,2)");
}

TEST(PlantHomomorphism, DrawsWhatTheStringDoesNotShow) {
    const Grown grown = grow(lsystem(0, "A[+(90)A]A?P(0,0,9)", "homomorphism\nA --> F(2)\n"));
    EXPECT_EQ(grown.text, "A[+(90)A]A?P(0,4,0)");
    EXPECT_NE(grown.geometry.find("cylinder 0.5 0 0 0 0 2 0"), std::string::npos) << grown.geometry;
}

TEST(PlantHomomorphism, OfASubsystemIsItsOwn) {
    const Grown grown = grow(
        "Lsystem: 1\nderivation length: 0\naxiom: A?(2,3)A$A\n\nhomomorphism\nA --> "
        "F(1)\nendlsystem\n"
        "Lsystem: 2\naxiom: A\n\nhomomorphism\nA --> G(1)\nendlsystem\n");
    EXPECT_EQ(grown.image.find("F(1)"), 0U);
    EXPECT_NE(grown.image.find("G(1)"), std::string::npos) << grown.image;
    EXPECT_NE(grown.geometry.find("cylinder 1.5 0 1 0 0 4 0"), std::string::npos) << grown.geometry;
}

TEST(PlantHomomorphism, MayHaveANumberOfASeed) {
    const std::string model =
        lsystem(0, "AA", "homomorphism\nseed: 3\nA --> F(ran(1))\n", "Start: {x=ran(1);}");
    const Grown grown = grow(model);
    EXPECT_EQ(grown.faults, Texts());
    EXPECT_EQ(grown.image, grow(model).image);
}

TEST(PlantInterpretation, StopsAtACutIfTheViewSaysSo) {
    const std::string model = lsystem(0, "F[F%F?P(0,0)]F?P(0,0)", "\n");
    EXPECT_EQ(grow(model).text, "F[F%F?P(0,3)]F?P(0,2)");
    EXPECT_EQ(grow(model, "interpretation past %: off\n").text, "F[F%F?P(0,0)]F?P(0,2)");
}

TEST(PlantInterpretation, TellsTheFrameOfTheTurtle) {
    EXPECT_EQ(
        grow(lsystem(0, "F(2)&(180)?P(9,9,9)?H(9)?L(9,9,9)", "\n")).text,
        "F(2)&(180)?P(0,2,0)?H(0)?L(-1,0,0)");
    EXPECT_EQ(grow(lsystem(0, "F(2)?P(7)?P?P(1,1,1,5)", "\n")).text, "F(2)?P(0)?P?P(0,2,0,5)");
}

TEST(PlantRun, RunsItsBlocksInOrder) {
    const Grown grown = grow(lsystem(
        2, "A(Q)", "A(q) : * {printf(\"a%g \",Q);} --> A(q)",
        "Start: {printf(\"s%g \",Q);}\nStartEach: {printf(\"b%g \",Q);}\n"
        "EndEach: {printf(\"e%g \",Q);}\nEnd: {printf(\"x%g\",Q);}"));
    EXPECT_EQ(grown.printed, "s0 b1 a1 e1 b2 a2 e2 x2");
}

TEST(PlantRun, OfNoStepsOnlyStarts) {
    const Grown grown = grow(lsystem(
        0, "A", "A --> B",
        "Start: {printf(\"s\");}\nStartEach: {printf(\"b\");}\nEnd: {printf(\"x\");}"));
    EXPECT_EQ(grown.printed, "s");
    EXPECT_EQ(grown.text, "A");
    EXPECT_EQ(grow(lsystem(-3, "A", "A --> B")).text, "A");
    EXPECT_EQ(grow("Lsystem: 1\naxiom: A\nA --> B\nendlsystem\n").text, "A");
}

TEST(PlantRun, TruncatesTheDerivationLength) {
    EXPECT_EQ(
        grow("Lsystem: 1\nderivation length: 5/2\naxiom: A(0)\nA(n) --> A(n+1)\nendlsystem\n").text,
        "A(2)");
}

}  // namespace
}  // namespace quasimc::test
