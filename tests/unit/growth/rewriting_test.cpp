#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A step, and the string after it.
struct Step {
    const char *axiom, *productions, *text;
};

template <std::size_t kCount>
void expect_steps(const std::array<Step, kCount>& steps, const char* header = "") {
    for (const auto& [axiom, productions, text] : steps) {
        EXPECT_EQ(grow(lsystem(1, axiom, productions, header)).text, text) << axiom << "\n"
                                                                           << productions;
    }
}

TEST(PlantProductions, ReplaceAllModulesAtOnce) {
    EXPECT_EQ(grow(lsystem(3, "A", "A --> AB\nB --> A")).text, "ABAAB");
    EXPECT_EQ(after_step("AXB", "A --> B\nB --> *"), "BX");
}

TEST(PlantProductions, NeedTheNumberOfParameters) {
    EXPECT_EQ(
        after_step("AA(1)A(1,2)A(1,2,3)", "A --> a\nA(x) --> b(x)\nA(x,y) --> c(y,x)"),
        "ab(1)c(2,1)A(1,2,3)");
}

TEST(PlantProductions, AreTriedInTheOrderOfTheFile) {
    EXPECT_EQ(after_step("A(1)A(5)", "A(x) : x>3 --> B\nA(x) --> C\nA(x) : x>4 --> D"), "CB");
}

TEST(PlantProductions, MayConsumeSeveralModules) {
    EXPECT_EQ(after_step("AABABC", "A B --> X\nA --> Y"), "YXXC");
    EXPECT_EQ(after_step("A(1)B(2)A(1)C", "A(x)B(y) --> D(x+y)"), "D(3)A(1)C");
}

TEST(PlantProductions, DoNotIgnoreModulesInPredecessors) {
    EXPECT_EQ(grow(lsystem(1, "A+B", "AB --> X", "ignore: +")).text, "A+B");
}

TEST(PlantProductions, RunTheirBlocksAroundTheCondition) {
    EXPECT_EQ(
        after_step(
            "A(1)A(7)", "A(x) : {y=x*2;} y>10 {z=y+1;} --> B(x,y,z)\nA(x) : * {x=x+1;} --> C(x)"),
        "C(2)B(7,14,15)");
}

TEST(PlantProductions, KeepTheEffectsOfRejectedBlocks) {
    EXPECT_EQ(
        grow(lsystem(1, "AAB", "A : {n=n+1;} n>5 --> X\nB --> B(n)", "Start: {n=0;}")).text,
        "AAB(2)");
}

TEST(PlantProductions, KeepTheirOwnVariables) {
    EXPECT_EQ(
        after_step("AAB", "A : * {n=n+1;} --> C(n)\nB : * {n=n+10;} --> D(n)"), "C(1)C(2)D(10)");
}

TEST(PlantProductions, ChangeVariablesInTheOrderOfTheString) {
    EXPECT_EQ(
        grow(lsystem(
                 1, "A(0)B(0)A(0)", "A(x) : * {n=n*2+1;} --> A(n)\nB(x) --> B(n)", "Start: {n=1;}"))
            .text,
        "A(3)B(3)A(7)");
}

TEST(PlantProductions, BindEqualNamesInAFixedOrder) {
    EXPECT_EQ(after_step("A(5,6)", "A(x,x) --> B(x)"), "B(5)");
    EXPECT_EQ(after_step("A(1)B(2)C(3)", "A(x) < B(x) > C(x) --> R(x)"), "A(1)R(1)C(3)");
    EXPECT_EQ(after_step("A(1)A(2)B", "A(x)A(x) < B --> R(x)"), "A(1)A(2)R(1)");
    EXPECT_EQ(after_step("B(7)C(1)D(2)", "B(x) > C(x)D(x) --> R(x)"), "R(2)C(1)D(2)");
    EXPECT_EQ(after_step("A(1)B(2)", "A(x)B(x) --> R(x)"), "R(2)");
}

TEST(PlantProductions, KnowStepAndLength) {
    EXPECT_EQ(grow(lsystem(3, "A(Q,Z)", "A(q,z) --> A(q*10+Q,Z)")).text, "A(123,3)");
}

TEST(PlantProductions, HaveNoStepBeforeTheDerivationLength) {
    const std::string model =
        "Lsystem: 1\nStart: {q=Q;}\nderivation length: 2\naxiom: A(q,Z)\nA(q,z) --> "
        "A(Q,Z)\nendlsystem\n";
    const Grown grown = grow(model);
    EXPECT_EQ(grown.text, "A(0,2)");
    EXPECT_EQ(grown.notices, Texts{"model.l:2:11: the variable 'Q' has no value yet and is 0"});
}

TEST(PlantContexts, FollowTheBranches) {
    expect_steps(std::array{
        Step{"A[X]B", "A > B --> 1", "1[X]B"},
        Step{"[A]B", "A > B --> 1", "[A]B"},
        Step{"A[X]B", "A > [X]B --> 1\nA > X --> 2", "1[X]B"},
        Step{"[A]B", "A > ] --> 1", "[1]B"},
        Step{"A[X]B", "A < B --> 1", "A[X]1"},
        Step{"A[B]", "A < B --> 1", "A[1]"},
        Step{"C[D[E]F]", "C D < E --> 1\nC D < F --> 2", "C[D[1]2]"},
        Step{"C[D][E]", "D < E --> 1\nC < E --> 2", "C[D][2]"},
        Step{"AB", "A > BB --> 1\nAA < B --> 2", "AB"},
        Step{"A(1)BA", "A < B --> 1\nB > A(x) --> 2", "A(1)BA"},
    });
}

TEST(PlantContexts, MayDescribeBranches) {
    expect_steps(std::array{
        Step{"A[CD]G", "A > [CD]G --> 1", "1[CD]G"},
        Step{"A[CDX]G", "A > [CD]G --> 1", "A[CDX]G"},
        Step{"A[C[Q]D]G", "A > [CD]G --> 1", "1[C[Q]D]G"},
        Step{"B[CXY[Z]W]G", "B > [C=]G --> 1", "1[CXY[Z]W]G"},
        Step{
            "A(1)B(2)[C(3)]D(4)", "A(x) < B(y) > [C(z)]D(w) --> R(x,y,z,w)",
            "A(1)R(1,2,3,4)[C(3)]D(4)"},
    });
}

TEST(PlantContexts, MayBeStars) {
    expect_steps(std::array{
        Step{"AB", "* < A > B --> 1\nA < B > * --> 2", "12"},
        Step{"AB", "* < A > * --> 1", "1B"},
    });
}

TEST(PlantContexts, AreThoseOfTheOldString) {
    EXPECT_EQ(after_step("ABC", "A --> C\nA < B > C --> B(1)\nB < C --> A"), "CB(1)A");
}

TEST(PlantContexts, SkipIgnoredModules) {
    expect_steps(
        std::array{
            Step{"A+(3)-B", "A < B --> 1\nA > B --> 2", "2+(3)-1"},
            Step{"A&B", "A < B --> 1", "A&B"},
            Step{"A[X]+B", "A > B --> 2", "2[X]+B"},
        },
        "ignore: + -");
}

TEST(PlantContexts, MayConsiderAFewModules) {
    expect_steps(
        std::array{
            Step{"A+X(1)B", "A < B --> 1\nA > B --> 2", "2+X(1)1"},
            Step{"A[XB]", "A > B --> 2", "2[XB]"},
            Step{"[A]XB", "A > B --> 2\nA < B --> 1", "[2]XB"},
        },
        "consider: AB");
}

TEST(PlantContexts, SeeTheSymbolsOfLongNames) {
    EXPECT_EQ(after_step("F?E(3)~l(2)", "F > ? E(x) --> G(x)\nl(s) --> l(s+1)"), "G(3)?E(3)~l(3)");
}

TEST(PlantContexts, MeetInARing) {
    const auto ring = [](const char* axiom, const char* productions) {
        return grow(lsystem(1, axiom, productions, "ring lsystem")).text;
    };
    EXPECT_EQ(ring("A(1)B(2)C(3)", "C(z) < A(x) > B(y) --> R(z,x,y)"), "R(3,1,2)B(2)C(3)");
    EXPECT_EQ(ring("A(1)B(2)C(3)", "B(y) < C(z) > A(x) --> R(y,z,x)"), "A(1)B(2)R(2,3,1)");
    EXPECT_EQ(ring("A", "A < A > A --> B"), "B");
    EXPECT_EQ(ring("XX", "A < X --> B\nX > A --> B"), "XX");
}

TEST(PlantChance, ChoosesByWeights) {
    const auto chosen = [](const char* axiom, const char* productions) {
        return grow(lsystem(1, axiom, productions, "seed: 5")).text;
    };
    // The generator gives 0, .001, .042, .177, .365, .091, .092, .487, .527, .454.
    EXPECT_EQ(chosen("AAAAAAAAAA", "A --> L : 0.5\nA --> R : 0.5"), "LLLLLLLLRL");
    EXPECT_EQ(chosen("XXXXXXXXAA", "A --> L : 0.5\nA --> R : 0.5"), "XXXXXXXXRL");
    EXPECT_EQ(chosen("AAAAAAAAAA", "A --> L\nA --> R : 3"), "LLLLRLLRRR");
    EXPECT_EQ(chosen("A(1)A(2)", "A(x) : x>1 --> L : x\nA(x) --> R(x) : 0"), "R(1)L");
    EXPECT_EQ(chosen("AA", "A --> L : 0"), "LL");
    EXPECT_EQ(chosen("XA", "A --> L : -1\nA --> R : 0"), "XA");
}

TEST(PlantChance, NeedsASeed) {
    const Grown grown = grow(lsystem(1, "A", "A --> L : 0.1\nA --> R : 0.9"));
    EXPECT_EQ(grown.text, "L");
    ASSERT_EQ(grown.notices.size(), 1U);
    EXPECT_NE(grown.notices[0].find("model.l:5"), std::string::npos) << grown.notices[0];
}

TEST(PlantCut, RemovesTheRestOfItsBranch) {
    expect_steps(std::array{
        Step{"AB%CD", "C --> X", "AB"},
        Step{"A[B%C[D]E]F", "F --> G", "A[B]G"},
        Step{"A[%]B", "B --> C", "A[]C"},
        Step{"A%C", "% --> Y", "AYC"},
        Step{"AC", "A --> %", "%C"},
        Step{"A[%B]%C", "A > B --> n", "A[]"},
        Step{"A%B", "B --> n\ndecomposition\n% --> X", "AXn"},
        Step{"A[B%%D]%(1,0)C", "B --> n", "A[n]%(1,0)C"},
        Step{"AB%D%(1,0)C", "B --> n\n", "An%(1,0)C"},
    });
    EXPECT_EQ(grow(lsystem(2, "AC", "A --> B%\nC --> D")).text, "B");
}

TEST(PlantCut, MayKeepTheRestOfItsBranch) {
    const std::string productions = "B --> F(1)%(7)XY\nX --> XX\nC < X --> n";
    EXPECT_EQ(grow(lsystem(1, "A[B]C", productions)).text, "A[F(1)%(7)XY]C");
    EXPECT_EQ(grow(lsystem(2, "A[B]C", productions)).text, "A[F(1)]C%(7,0)XXY");
    EXPECT_EQ(grow(lsystem(3, "A[B]C", productions)).text, "A[F(1)]C%(7,0)XXXXY");
}

TEST(PlantCut, EndsContexts) {
    EXPECT_EQ(
        grow(lsystem(2, "AC%(7)B", "A > B --> n\nC < B --> n\nC > B --> n", "consider: AB")).text,
        "AC%(7,0)B");
}

TEST(PlantCut, DrawsTheRestWhereItWas) {
    EXPECT_EQ(
        grow(lsystem(2, "F(3)[+(90)F(1)%(7)?P(9,9)][%(8)?P(9,9)]F(5)?P(9,9)", "\n")).text,
        "F(3)[+(90)F(1)][]F(5)?P(0,8)%(7,0)?P(-1,3)%(8,1)?P(0,3)");
}

TEST(PlantDecomposition, ReplacesAllModulesThatAreWritten) {
    const std::string productions = "A --> AC\ndecomposition\nC --> DC\n";
    EXPECT_EQ(grow(lsystem(0, "AC", productions)).text, "AC");
    EXPECT_EQ(grow(lsystem(1, "A", productions)).text, "ADC");
    EXPECT_EQ(grow(lsystem(2, "A", productions)).text, "ADCDDC");
}

TEST(PlantDecomposition, IsRecursive) {
    EXPECT_EQ(
        after_step(
            "A",
            "A --> B(3)\ndecomposition: no warnings\nmaximum depth: 10\n"
            "B(n) : n>0 --> C(n)[B(n-1)]\nC(n) : n>1 --> D(n)"),
        "D(3)[D(2)[C(1)[B(0)]]]");
    EXPECT_EQ(after_step("A", "A --> B\ndecomposition\nmaximum depth: 3\nB --> CB"), "CCCB");
}

TEST(PlantDecomposition, HasTheContextOfTheOldString) {
    EXPECT_EQ(after_step("AZ", "A --> CX\ndecomposition\nC > X --> n\nC > Z --> y"), "yXZ");
}

const char* const kSubsystems =
    "Lsystem: 1\nderivation length: 2\nignore: +\naxiom: A?(2,1)A(0)+B$?(2,1)A(0)$A+B\n"
    "A --> B\nA < B --> C\nendlsystem\n"
    "Lsystem: 2\nStart: {n=10;}\naxiom: A\nA(x) : * {n=n+1;} --> A(n)\nA(x) < B --> "
    "D\nendlsystem\n";

TEST(PlantSubsystems, HaveTheirOwnProductionsAndVariables) {
    const Grown grown = grow(kSubsystems);
    EXPECT_EQ(grown.faults, Texts());
    EXPECT_EQ(grown.text, "B?(2,1)A(12)+B$?(2,1)A(12)$B+C");
}

}  // namespace
}  // namespace quasimc::test
