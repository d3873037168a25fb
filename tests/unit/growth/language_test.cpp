#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

TEST(PlantLexing, BlanksBetweenSymbolsAreSkipped) {
    EXPECT_EQ(after_step("E ( 2 ) +  F", "E (x)  -->  E (x)  F ( x + 1 )"), "E(2)F(3)+F");
}

TEST(PlantLexing, TwoSlashesBeginAComment) {
    EXPECT_EQ(after_step("A/ /B//C", "/* A --> x */\n// B --> y"), "A//B");
}

TEST(PlantLexing, ATabContinuesALine) {
    EXPECT_EQ(after_step("A", "A --> B\n\tC\n\t\tD"), "BCD");
    EXPECT_EQ(after_step("AB", "A --> C\n B --> D"), "CD");
    EXPECT_EQ(after_step("A", "A --> C\n\n\tC --> D"), "C");
}

TEST(PlantLexing, ABackslashJoinsLines) {
    EXPECT_EQ(after_step("A", "A --> B\\\nC"), "BC");
}

TEST(PlantLexing, MacrosAreReplacedBesideSymbols) {
    const std::string model =
        "#define X 2\n#define LEAF(a) [+(a)L(X)]\n" + lsystem(1, "A", "A --> !(X)XYX LEAF(X*3)!X");
    EXPECT_EQ(grow(model).text, "!(2)XYX[+(6)L(2)]!2");
}

TEST(PlantLexing, KeywordsBeginWithAnyCase) {
    const std::string model =
        "lsystem: main\nSeed: 1\nDerivation Length: 1\nIgnore: +\nstart: {a=1;}\n"
        "startEach: {a=a+1;}\nendEach: {a=a+1;}\nend: {a=a+1;}\nAxiom: A\nA --> B(a)\n"
        "Decomposition: no warnings\nMaximum Depth: 2\nB(x) --> C(x)\nHomomorphism: warnings\n"
        "seed: 3\nmaximum depth: 4\nC(x) --> D(x)\nEndLsystem\n";
    const Grown grown = grow(model);
    EXPECT_EQ(grown.faults, Texts());
    EXPECT_EQ(grown.text, "C(2)");
    EXPECT_EQ(grown.image, "D(2)");
}

TEST(PlantLexing, StartEachMayBeTwoWords) {
    EXPECT_EQ(
        grow(lsystem(
                 2, "A", "A --> A(n)\nA(x) --> A(n)", "Start Each: {n=n+1;}\nEnd Each: {n=n+2;}"))
            .text,
        "A(4)");
}

TEST(PlantLexing, NumbersHaveAnExponentOnlyAfterAPoint) {
    EXPECT_EQ(values("12,1.5,.5,5.,1.0e3,2.5e-3,1.E2"), "12,1.5,0.5,5,1000,0.0025,100");
    EXPECT_NE(values("1e10").find("model.l:4:11"), std::string::npos) << values("1e10");
}

TEST(PlantNumbers, ArePrintedWithSixDigits) {
    EXPECT_EQ(
        values("1/3,100000,1000000,1.0e10,-0,0.0001,0.00001,123456.7"),
        "0.333333,100000,1e+06,1e+10,-0,0.0001,1e-05,123457");
}

TEST(PlantNumbers, ParametersHaveSinglePrecision) {
    EXPECT_EQ(
        after_step(
            "A(0.1)A(0.5)A(16777217)", "A(x) : x==0.1 || x==0.5 --> B\nA(x) --> C(x-16777216)"),
        "C(-1.67772e+07)BC(0)");
}

TEST(PlantNumbers, VariablesHaveDoublePrecision) {
    EXPECT_EQ(
        grow(lsystem(0, "A(a==0.1,b-16777216)", "\n", "Start: {a=0.1; b=16777217;}")).text,
        "A(1,1)");
}

struct Valued {
    const char* expressions;
    const char* values;
};

TEST(PlantExpressions, HaveThePrecedenceOfTheLanguage) {
    constexpr std::array kCases{
        Valued{"2^3^2,-2^2,2^-1,3>2>1", "64,4,0.5,0"},
        Valued{"1+2*3,(1+2)*3,8/4/2,8-4-2", "7,9,1,2"},
        Valued{"1||0&&0,1==1>0,2<>1,2!=2", "1,1,1,0"},
        Valued{"1<2,2<=2,3>=4,1?2:3,0?1:0?2:3", "1,1,0,2,3"},
        Valued{"!0+1,!2,!!3,-!0,!-1", "2,0,1,-1,0"},
        Valued{"3--2,2*-3,- -4,1- -1", "5,-6,4,2"},
        Valued{"-7%3,7%-3,7.9%3.9,2+7%4*2", "-1,1,1,8"},
        Valued{"0^0,(-4)^2,0^-1,4^0.5", "1,16,inf,2"},
        Valued{"5&&7,0||9,0||0,0&&1", "1,1,0,0"},
        Valued{"1==1==2,1+1==2,5>3==1", "0,1,1"},
    };
    for (const auto& [expressions, expected] : kCases) {
        EXPECT_EQ(values(expressions), expected) << expressions;
    }
}

TEST(PlantExpressions, EvaluateOnlyWhatTheyNeed) {
    const std::string first = "0.170828";
    EXPECT_EQ(values("ran(1)"), first);
    EXPECT_EQ(values("0&&ran(1),ran(1)"), "0," + first);
    EXPECT_EQ(values("1||ran(1),ran(1)"), "1," + first);
    EXPECT_EQ(values("1?5:ran(1),0?ran(1):6,ran(1)"), "5,6," + first);
}

TEST(PlantFunctions, UseDegrees) {
    EXPECT_EQ(values("sin(30),cos(60),tan(45)"), "0.5,0.5,1");
    EXPECT_EQ(values("asin(1),acos(-0.5),atan(-1)"), "90,120,-45");
}

TEST(PlantFunctions, HaveTheValuesOfC) {
    EXPECT_EQ(values("exp(0),log(exp(2)),sqrt(2),fabs(-3)"), "1,2,1.41421,3");
    EXPECT_EQ(values("floor(-1.5),ceil(-1.5),ceil(1.2)"), "-2,-1,2");
    EXPECT_EQ(values("sign(-3),sign(0),sign(0.1)"), "-1,0,1");
}

TEST(PlantFunctions, TruncRounds) {
    EXPECT_EQ(values("trunc(1.5),trunc(-1.5),trunc(1.4),trunc(-1.6)"), "2,-1,1,-2");
}

TEST(PlantFunctions, DrawTheNumbersOfErand48) {
    EXPECT_EQ(values("ran(1),ran(1)"), "0.170828,0.749902");
    EXPECT_EQ(
        grow(lsystem(0, "A(ran(1),ran(2))", "\n", "Start: {srand(0);}")).text,
        "A(0.170828,1.4998)");
    EXPECT_EQ(values("nran(5,3),bran(0,2),biran(8,1),biran(8,-1)"), "5,0,8,0");
}

TEST(PlantFunctions, OfFilesWriteAndRead) {
    const TemporaryFolder folder;
    folder.write("plant.v", "");
    folder.write(
        "model.l",
        lsystem(
            0, "A(a,b,c,d)", "\n",
            "Start: {f=fopen(\"data\",\"w\"); fprintf(f,\"%g %g\\n\",1.5,-2); c=fclose(f);"
            "f=fopen(\"data\",\"r\"); fscanf(f,\"%lf %lf\",&a,&b); fclose(f);"
            "d=fopen(\"none\",\"r\");}"));
    EXPECT_EQ(grow_in(folder).text, "A(1.5,-2,0,-1)");
    EXPECT_EQ(folder.read("data"), "1.5 -2\n");
}

TEST(PlantFunctions, FilesAreWrittenBelowTheFolderOnly) {
    const TemporaryFolder folder;
    folder.write("plant.v", "");
    folder.write("sub/keep", "1");
    folder.write(
        "model.l", lsystem(
                       0, "A(a,b,c)", "\n",
                       "Start: {a=fopen(\"" + folder.path().string() +
                           "/keep\",\"w\"); b=fopen(\"../keep\",\"a\");"
                           "c=fopen(\"sub/../../keep\",\"r+\");}"));
    const Grown grown = grow_in(folder);
    EXPECT_EQ(grown.text, "A(-1,-1,-1)");
    EXPECT_EQ(grown.notices.size(), 3U);
}

TEST(PlantFunctions, PrintfTakesNumbers) {
    const Grown grown =
        grow(lsystem(0, "A", "\n", "Start: {printf(\"a %g\\t%05.2f\\n\",0.5,3.14159);}"));
    EXPECT_EQ(grown.printed, "a 0.5\t03.14\n");
    const Grown short_of_one = grow(lsystem(0, "A", "\n", "Start: {printf(\"%g %g\",1);}"));
    EXPECT_EQ(short_of_one.printed, "1 0");
    EXPECT_EQ(short_of_one.notices.size(), 1U);
}

TEST(PlantFunctions, KnowTheDerivationLength) {
    EXPECT_EQ(grow(lsystem(3, "A(GetDerivationLength(1))", "\n")).text, "A(3)");
    EXPECT_EQ(
        grow(lsystem(3, "A(0)", "A(n) --> A(n+1)", "Start: {SetDerivationLength(5);}")).text,
        "A(5)");
}

TEST(PlantStatements, DecideAndRepeat) {
    const std::string block =
        "Start: {i=0; s=0; while (i<5) { if (i==3) {s=s+100;} else {s=s+i;} i=i+1; }\n"
        "  do { s=s*2; } while (s<500); if (0) {s=-1;} }";
    EXPECT_EQ(grow(lsystem(0, "A(i,s)", "\n", block)).text, "A(5,856)");
}

TEST(PlantStatements, WhileMayRunNever) {
    EXPECT_EQ(
        grow(lsystem(0, "A(a,b)", "\n", "Start: {a=1; while (0) {a=2;} do {b=b+1;} while (0);}"))
            .text,
        "A(1,1)");
}

TEST(PlantArrays, AreRowMajorAndFilledWithZeros) {
    const Grown grown = grow(lsystem(
        0, "A(a[0],a[2],a[1.9],b[0][1],b[1][0],b[1][1])", "\n",
        "define: { array a[3] = {1, -2.5};\n array b[2][2] = {1,2,3,4}; }"));
    EXPECT_EQ(grown.text, "A(1,0,-2.5,2,3,4)");
    EXPECT_EQ(grown.notices, Texts());
}

TEST(PlantArrays, ClampTheirIndices) {
    const Grown grown = grow(lsystem(
        0, "A(a[-1],a[7])", "\n", "define: { array a[3] = {1,2,3}; }\nStart: {a[9]=5; a[-3]=4;}"));
    EXPECT_EQ(grown.text, "A(4,5)");
    ASSERT_EQ(grown.notices.size(), 4U);
    EXPECT_EQ(
        grown.notices.front(),
        "model.l:4: the index 9 is outside of the array, whose last index is 2; the nearest is "
        "used");
}

TEST(PlantArrays, DropInitialisersThatAreTooMany) {
    EXPECT_EQ(
        grow(lsystem(
                 0, "A(a[0],a[1],b[0])", "\n",
                 "define: { array a[2] = {1,2,3}; array b[1] = {7}; }"))
            .text,
        "A(1,2,7)");
}

}  // namespace
}  // namespace quasimc::test
