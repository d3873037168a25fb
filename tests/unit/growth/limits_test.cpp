#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A model whose axiom or productions are wrong.
Texts faults_of(const std::string& model) {
    return grow(model).faults;
}

bool contains(const Texts& texts, std::string_view part) {
    for (const std::string& text : texts) {
        if (text.find(part) != std::string::npos) {
            return true;
        }
    }
    return false;
}

GrowthOptions with_limits(std::size_t string_bytes, std::uint64_t loop_rounds) {
    GrowthOptions options;
    options.limits = {string_bytes, loop_rounds};
    return options;
}

TEST(PlantLimits, StopEndsTheGrowthAfterTheStep) {
    const Grown grown = grow(lsystem(
        9, "A(0)", "A(n) : n==2 {stop(1);} --> B(n)A(n+1)\nA(n) --> A(n+1)",
        "End: {printf(\"end\");}"));
    EXPECT_EQ(grown.text, "B(2)A(3)");
    EXPECT_EQ(grown.steps, 3);
    EXPECT_EQ(grown.printed, "end");
}

TEST(PlantLimits, LoopsWithoutEndAreErrors) {
    for (const char* loop : {"while (1) {n=n+1;}", "do {n=n+1;} while (n>0);"}) {
        const Texts faults = grow(
                                 lsystem(0, "A", "\n", std::string("Start: {") + loop + "}"), "",
                                 nullptr, with_limits(1 << 20, 1000))
                                 .faults;
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_EQ(
            faults[0].find("model.l:3: a loop does not end (the loops of the block have gone round "
                           "1000 times)"),
            0U)
            << faults[0];
    }
}

TEST(PlantLimits, NestedLoopsCountTogether) {
    const std::string model = lsystem(
        0, "A(n)", "\n", "Start: {i=0; while (i<50) {j=0; while (j<50) {n=n+1; j=j+1;} i=i+1;}}");
    EXPECT_EQ(grow(model, "", nullptr, with_limits(1 << 20, 3000)).text, "A(2500)");
    EXPECT_EQ(grow(model, "", nullptr, with_limits(1 << 20, 2000)).faults.size(), 1U);
}

TEST(PlantLimits, ParametersThatAreNoNumbersAreReported) {
    for (const char* axiom : {"F(sqrt(0-1))F(1)", "+(log(0))F(1)", "@M(0,sqrt(0-1),0)F(1)"}) {
        const Grown grown = grow(lsystem(0, axiom, "\n"));
        EXPECT_EQ(grown.notices.size(), 1U) << axiom;
    }
}

TEST(PlantLimits, ModelsStartNoPrograms) {
    const Grown grown = grow(lsystem(0, "@S(\"ls\")@L(\"a\")F", "\n"));
    ASSERT_EQ(grown.faults.size(), 1U);
    EXPECT_NE(grown.faults[0].find("a command of the shell is refused"), std::string::npos);
    EXPECT_TRUE(grow(lsystem(0, "@L(\"a\")F", "\n")).faults.empty());
}

TEST(PlantLimits, HeadersAfterTheAxiomAreNamed) {
    const Grown grown = grow(lsystem(0, "A\nignore: +", "\n"));
    ASSERT_FALSE(grown.faults.empty());
    EXPECT_NE(grown.faults[0].find("a header after the axiom"), std::string::npos);
}

TEST(PlantLimits, DecompositionWithoutEndIsAnError) {
    const Texts faults =
        grow(
            lsystem(1, "A", "A --> B\ndecomposition: no warnings\nmaximum depth: 1000\nB --> BB\n"),
            "", nullptr, with_limits(1 << 20, 1000))
            .faults;
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].find("step 1: the string takes more than 1 MiB"), 0U) << faults[0];
}

TEST(PlantLimits, HomomorphismWithoutEndIsAnError) {
    const Texts faults =
        grow(
            lsystem(0, "A", "homomorphism: no warnings\nmaximum depth: 1000\nA --> AA\n"), "",
            nullptr, with_limits(1 << 20, 1000))
            .faults;
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].find("homomorphism: it makes more than "), 0U) << faults[0];
}

TEST(PlantLimits, LongStringsAreFaults) {
    const Texts faults =
        grow(lsystem(40, "A", "A --> AA"), "", nullptr, with_limits(1 << 20, 1000)).faults;
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].find("step 19: the string takes more than 1 MiB"), 0U) << faults[0];
}

TEST(PlantLimits, DepthWarnsOnce) {
    const Grown decomposed =
        grow(lsystem(3, "AA", "A --> B\ndecomposition\nmaximum depth: 2\nB --> CB"));
    EXPECT_EQ(
        decomposed.notices,
        Texts{"decomposition: the maximum depth 2 is reached; modules remain as they are"});
    const Grown image = grow(lsystem(0, "AA", "homomorphism\nmaximum depth: 2\nA --> CA"));
    EXPECT_EQ(
        image.notices, Texts{"homomorphism: the maximum depth 2 is reached (module 'A'); modules "
                             "remain as they are"});
}

TEST(PlantLimits, DivisionsByZeroWarn) {
    const Grown grown = grow(lsystem(1, "A(5)A(6)", "A(x) --> B(x/0,x%0,x%0.5)"));
    EXPECT_EQ(grown.text, "B(5,0,0)B(6,0,0)");
    EXPECT_EQ(
        grown.notices, (Texts{
                           "model.l:5: division by 0; the divisor is taken as 1",
                           "model.l:5: remainder of a division by 0; it is taken as 0",
                       }));
}

TEST(PlantLimits, ValuesMayBeInfiniteOrNone) {
    const Grown grown =
        grow(lsystem(1, "A", "A --> F(log(0))+(sqrt(-4))&(asin(2))F(1)@O(0^-1)#(log(-1))F(2)"));
    EXPECT_EQ(grown.faults, Texts());
    EXPECT_EQ(grown.text.find("F(-inf)+("), 0U) << grown.text;
    EXPECT_NE(grown.text.find("nan"), std::string::npos) << grown.text;
}

TEST(PlantLimits, NotNumbersAreNoIndices) {
    const Grown grown = grow(lsystem(
        0,
        "A(a[sqrt(-1)],a[0^-1],func(sqrt(-1),1),func(1,sqrt(-1)),curveX(log(0),1),ran(1)>2)~l(0/0)",
        "\n",
        "define: {array a[2] = {3,4};}\nStart: {srand(sqrt(-1)); a[sqrt(-1)]=5; "
        "SetDerivationLength(0);}"));
    EXPECT_EQ(grown.faults, Texts());
    EXPECT_EQ(grown.text.find("A(5,"), 0U) << grown.text;
}

TEST(PlantLimits, ShellCommandsAreRefused) {
    const Grown grown = grow(lsystem(0, "@S(1)F@S", "homomorphism\nB --> C"));
    EXPECT_EQ(grown.notices, Texts{"turtle: '@S': shell commands are not run"});
}

TEST(PlantLimits, UnmatchedBracketsWarn) {
    const Grown grown = grow(lsystem(1, "A]B}C$.D[E{F", "A --> X\nB --> Y"));
    EXPECT_EQ(grown.text, "X]Y}C$.D[E{F");
    EXPECT_TRUE(contains(grown.notices, "']'"));
    EXPECT_TRUE(contains(grown.notices, "'}'"));
    EXPECT_TRUE(contains(grown.notices, "'$'"));
    EXPECT_TRUE(contains(grown.notices, "'.'"));
}

TEST(PlantLimits, PolygonsMayBeNested) {
    const Grown grown = grow(lsystem(0, "{.f{.f+f.}f.}", "\n"));
    EXPECT_EQ(grown.faults, Texts());
}

TEST(PlantLimits, ModulesHaveAtMostTwentyParameters) {
    const std::string most = "A(1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20)";
    EXPECT_EQ(grow(lsystem(0, most, "\n")).text, most);
    const Texts faults = faults_of(lsystem(0, most.substr(0, most.size() - 1) + ",21)", "\n"));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].find("a module has at most 20 parameters"), std::string::npos) << faults[0];
}

TEST(PlantLimits, ArraysHaveALargestSize) {
    for (const char* arrays : {"array a[9000000]; array b[2000000];", "array a[4000][4000];"}) {
        const Texts faults =
            faults_of(lsystem(0, "A", "\n", std::string("define: {") + arrays + "}"));
        EXPECT_TRUE(contains(faults, "is too large")) << arrays;
    }
    EXPECT_TRUE(contains(faults_of(lsystem(0, "A", "\n", "define: {array a[0];}")), "integer"));
}

TEST(PlantLimits, NestingHasALimit) {
    const std::string deep(3000, '('), minus(3000, '-'), negations(3000, '!');
    for (const std::string& expression : {deep, minus, negations}) {
        EXPECT_TRUE(contains(faults_of(lsystem(0, "A(" + expression, "\n")), "nested too deeply"));
    }
    std::string blocks;
    for (int i = 0; i < 3000; ++i) {
        blocks += "if (1) {";
    }
    EXPECT_TRUE(
        contains(faults_of(lsystem(0, "A", "\n", "Start: {" + blocks)), "nested too deeply"));
    const std::string branches = std::string(3000, '[') + "F" + std::string(3000, ']');
    EXPECT_EQ(grow(lsystem(1, branches, "F < [ --> A")).text, branches);
}

TEST(PlantFaults, NameFileLineAndColumn) {
    EXPECT_EQ(
        faults_of(lsystem(0, "A(foo(1))", "\n")), Texts{"model.l:4:10: 'foo' is no function"});
    EXPECT_EQ(faults_of(lsystem(0, "A(atan2(1,2))", "\n")).size(), 1U);
    EXPECT_EQ(
        faults_of(lsystem(0, "A", "A(x) --> B(x")),
        Texts{"model.l:5:13: the end of the line where ',' or ')' is expected"});
}

TEST(PlantFaults, AreReportedAllAtOnce) {
    const Texts faults = faults_of(lsystem(
        0, "A",
        "A B\nA --> B(1,)\nA(x) : x> --> C\nA() --> B\nA(x) --> B(x=1)\nA --> B[c[1]](c[1])",
        "Start: {a=;}\nignored: +"));
    EXPECT_TRUE(contains(faults, "model.l:3:11"));
    EXPECT_TRUE(contains(faults, "model.l:4:1"));
    for (const char* line :
         {"model.l:6:", "model.l:7:", "model.l:8:", "model.l:9:", "model.l:10:", "model.l:11:"}) {
        EXPECT_TRUE(contains(faults, line)) << line;
    }
    EXPECT_EQ(faults.size(), 8U);
}

TEST(PlantFaults, OfTheStructureOfAFile) {
    EXPECT_TRUE(contains(faults_of("A --> B\n"), "Lsystem: label"));
    EXPECT_TRUE(contains(faults_of("Lsystem: 1\nderivation length: 1\nendlsystem\n"), "no axiom"));
    EXPECT_TRUE(contains(faults_of("Lsystem: 1\naxiom: A\nA --> B\n"), "does not end"));
    EXPECT_TRUE(
        contains(faults_of("Lsystem: 1\naxiom: A\naxiom: B\nA --> B\nendlsystem\n"), "model.l:3:"));
    EXPECT_TRUE(contains(
        faults_of(lsystem(1, "A", "A --> B\nhomomorphism\nmaximum depth: 0\nA --> C")),
        "maximum depth"));
    EXPECT_TRUE(contains(faults_of(""), "Lsystem"));
    EXPECT_TRUE(contains(faults_of("Lsystem:\naxiom: A\n\nendlsystem\n"), "label"));
}

TEST(PlantFaults, NamesThatAreUnknown) {
    const Grown grown = grow(lsystem(1, "A(y)A(y)", "A(x) --> B(x,z)"));
    EXPECT_EQ(grown.text, "B(0,0)B(0,0)");
    EXPECT_EQ(
        grown.notices, (Texts{
                           "model.l:4:10: the variable 'y' has no value yet and is 0",
                           "model.l:5:14: the variable 'z' has no value yet and is 0",
                       }));
    EXPECT_TRUE(contains(faults_of(lsystem(0, "?(3,1)A$", "\n")), "no L-system"));
}

TEST(PlantFaults, AStarStandsAlone) {
    EXPECT_EQ(
        faults_of(lsystem(1, "A", "A --> B C*D")),
        Texts{"model.l:5:10: '*' among modules (alone it means no modules)"});
}

TEST(PlantFaults, AForgottenColonIsAContext) {
    EXPECT_EQ(after_step("A(1)", "A(x) x>0 --> B"), "A(1)");
}

TEST(PlantFaults, OfModelAndViewComeTogether) {
    const Texts faults = grow(lsystem(0, "A(", "\n"), "angle increment: much\n").faults;
    EXPECT_TRUE(contains(faults, "model.l:4:"));
}

}  // namespace
}  // namespace quasimc::test
