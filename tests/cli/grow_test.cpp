// Plants grown from the command line. The language itself: tests/unit/growth.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "picture/image.h"
#include "program.h"
#include "support/http_get.h"
#include "window/page.h"

namespace quasimc::test {
namespace {

/// Three internodes with leaves.
constexpr const char* kPlant =
    "lsystem: 1\nderivation length: 3\naxiom: A(1)\n"
    "A(x) --> F(x)[+(45)L(x)]A(x/2)\n"
    "homomorphism\nL(x) --> ;(3){.+(30)f(x)-(60)f(x)}\nendlsystem\n";
constexpr const char* kView = "angle increment: 45\ninitial line width: 0.1\ninitial color: 2\n";
constexpr const char* kString = "F(1)[+(45)L(1)]F(0.5)[+(45)L(0.5)]F(0.25)[+(45)L(0.25)]A(0.125)\n";
/// Leaves that ask for their light.
constexpr const char* kAsking =
    "lsystem: 1\nderivation length: 2\naxiom: A\n"
    "A --> F(1)[+(60)?E(0)P(0.2,0.5)]A\n"
    "homomorphism\nP(a,b) --> {.+(30)f(b)-(60)f(b)}\nendlsystem\n";
constexpr const char* kLight =
    "location: 50 0\ngrowth period: 6 18\njulian day: 172\nweather: 1 3\n"
    "leaf material (top): 0.1 0 0.05 0\nsampling method: sobol\nnumber of rays: 1024\n"
    "verbose: 0\n";

class GrowCommand : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        folder_.write("plant.l", kPlant);
        folder_.write("plant.v", kView);
        folder_.write("asking.l", kAsking);
        folder_.write("light.qmc", kLight);
    }
    [[nodiscard]] bool has(const std::string& name) const {
        return std::filesystem::exists(folder_.path() / name);
    }
    static void expect_in(const std::string& text, const std::string& part) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
    }
    void expect_refused(
        const std::vector<std::string>& arguments, int status, const std::string& text) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        expect_in(outcome.err, text);
    }
};

TEST_F(GrowCommand, PrintsTheString) {
    const Outcome outcome = run({"grow", "plant.l", "--string", "-"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, kString);
    EXPECT_TRUE(outcome.err.starts_with("3 steps, 16 modules, ")) << outcome.err;
    const Outcome quiet = run({"grow", "plant.l", "--string", "-", "--steps", "1", "-q"});
    EXPECT_EQ(quiet.out, "F(1)[+(45)L(1)]A(0.5)\n");
    EXPECT_EQ(quiet.err, "");
    const Outcome image =
        run({"grow", "plant.l", "--string", "-", "--steps", "1", "--homomorphism"});
    EXPECT_EQ(image.out, "F(1)[+(45);(3){.+(30)f(1)-(60)f(1)}]A(0.5)\n");
}

TEST_F(GrowCommand, UnderstandsTheFlagsOfCpfg) {
    const Outcome outcome = run(
        {"grow", "-g", "-m", "plant.map", "-s100000", "-str", "stdout", "-strb", "out.strb", "-vv",
         "out.box", "-ray", "out.geo", "plant.l", "plant.v"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, kString);
    EXPECT_TRUE(folder_.read("out.strb").starts_with("L-system string:76 3\nF("))
        << "7 bytes for each of 10 modules with a parameter, and 6 brackets";
    EXPECT_TRUE(folder_.read("out.box").starts_with("box: x: ")) << folder_.read("out.box");
    expect_in(folder_.read("out.geo"), "\ncolor 2\ncylinder 0.05 0 0 0 0 1 0\n");
    EXPECT_EQ(
        run({"grow", "-homo", "plant.l", "--steps", "1", "-str", "stdout"}).out,
        "F(1)[+(45);(3){.+(30)f(1)-(60)f(1)}]A(0.5)\n");
    expect_refused({"grow", "plant.l", "-str"}, 2, "--string: a value is missing");
    expect_in(run({"grow", "--help"}).out, "Flags of cpfg");
}

TEST_F(GrowCommand, RefusesOutputsInOneFile) {
    expect_refused(
        {"grow", "plant.l", "--series", "all", "-o", "all/step_001.glb"}, 2,
        "'all/step_001.glb' is the file of another output");
    expect_refused(
        {"grow", "plant.l", "-o", "s_%d.ply", "--string", "s_2.ply"}, 2,
        "'s_2.ply' is the file of another output");
}

TEST_F(GrowCommand, TakesTheViewFileOfTheModel) {
    const auto geometry = [this](const std::vector<std::string>& files) {
        std::vector<std::string> arguments{"grow", "-q", "-ray", "-"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        return run(arguments).out;
    };
    EXPECT_EQ(geometry({"plant.l"}), geometry({"plant.l", "plant.v"}));
    folder_.write("wide.v", "initial line width: 0.4\n");
    expect_in(geometry({"plant.l", "wide.v"}), "cylinder 0.2 0 0 0 0 1 0\n");
}

TEST_F(GrowCommand, WritesThePlantByTheEndOfTheName) {
    for (const char* name : {"p.glb", "p.obj", "p.ply", "p.stl", "p.tri", "p.vtp"}) {
        const Outcome outcome = run({"grow", "plant.l", "-o", name});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_FALSE(folder_.read(name).empty()) << name;
    }
    const Outcome info = run({"info", "p.glb"});
    expect_in(info.out, "organs    6\n");
    expect_in(info.out, "material  color 2: 3 organs");
    expect_in(info.out, "label     module: 6 organs, 2 values: F L\n");
    EXPECT_EQ(run({"grow", "plant.l", "-o", "p.csv"}).status, 0);
    expect_in(folder_.read("p.csv"), "\nid,name,module,step,branch,order,area\n1,F 1,F,3,0,0,");
}

TEST_F(GrowCommand, RefusesBeforeItGrows) {
    expect_refused({"grow", "plant.l", "-o", "p.xyz", "--string", "p.txt"}, 2, "use tri, obj, ");
    EXPECT_FALSE(has("p.txt"));
    expect_refused({"grow", "none.l"}, 1, "none.l");
    expect_refused({"grow", "plant.l", "none.v"}, 1, "none.v");
    expect_refused({"grow", "plant.l", "--string", "plant.l"}, 2, "is an input of this run");
    expect_refused({"grow", "plant.l", "--port", "8080"}, 2, "--port needs --view");
    expect_refused({"grow", "asking.l", "--light", "light.qmc", "-e", "comm.e"}, 2, "--light");
    expect_refused({"grow"}, 2, "MODEL");
    folder_.write("bare.l", "lsystem: 1\naxiom: AB\nendlsystem\n");
    expect_refused({"grow", "bare.l", "-o", "p.glb"}, 1, "the plant of step 0 has no shape");
    EXPECT_FALSE(has("p.glb"));
}

TEST_F(GrowCommand, WritesEveryStep) {
    EXPECT_EQ(run({"grow", "plant.l", "-str", "s%02d.txt", "-o", "%d.stl"}).status, 0);
    EXPECT_EQ(folder_.read("s00.txt"), "A(1)\n");
    EXPECT_EQ(folder_.read("s03.txt"), kString);
    EXPECT_FALSE(has("0.stl")) << "nothing is drawn";
    EXPECT_TRUE(has("1.stl"));
    EXPECT_EQ(run({"grow", "plant.l", "--series", "all/steps"}).status, 0);
    EXPECT_EQ(folder_.read("all/steps/step_001.txt"), "F(1)[+(45)L(1)]A(0.5)\n");
    EXPECT_TRUE(has("all/steps/step_003.glb"));
    const std::string table = folder_.read("all/steps/steps.csv");
    expect_in(table, "\nstep,modules,organs,area\n0,1,0,0\n1,6,2,");
    expect_in(table, "\n3,16,6,");
}

/// Pictures of all steps have the frame of the whole growth; that of one step has its own.
TEST_F(GrowCommand, DrawsEveryStepInOneFrame) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const auto grow = [this](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"grow", "asking.l", "--size", "300x200", "-o"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    };
    grow({"f%02d.png"});
    grow({"last.png"});
    grow({"first.png", "--steps", "1"});
    EXPECT_FALSE(has("f00.png")) << "nothing is drawn";
    EXPECT_TRUE(folder_.read("last.png").starts_with("\x89PNG"));
    EXPECT_TRUE(folder_.read("f02.png") == folder_.read("last.png"));
    EXPECT_FALSE(folder_.read("f01.png") == folder_.read("first.png"));
    expect_refused({"grow", "plant.l", "-o", "p.png", "--camera", "north"}, 2, "--camera: 'north'");
    expect_refused({"grow", "plant.l", "-o", "none/p.png"}, 1, "none/p.png");
    folder_.write("bare.l", "lsystem: 1\naxiom: AB\nendlsystem\n");
    expect_refused({"grow", "bare.l", "-o", "p.png"}, 1, "the plant of step 0 has no shape");
    EXPECT_FALSE(has("p.png"));
}

/// A step has the colours of its light, on the scale of all steps.
TEST_F(GrowCommand, DrawsTheLightOfEveryStep) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const auto drawn = [this](const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"grow", "asking.l", "-o", name, "--size", "300x200"});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return folder_.read("l2.png");
    };
    const std::string light = drawn("l%d.png", {"--light", "light.qmc"});
    EXPECT_FALSE(light == drawn("l%d.png", {})) << "without light it is green";
    EXPECT_FALSE(light == drawn("l%d.png", {"--light", "light.qmc", "--range", "0,9"}));
}

TEST_F(GrowCommand, WritesWhatGrewBeforeAnError) {
    folder_.write(
        "fails.l",
        "lsystem: 1\nderivation length: 5\naxiom: A(0)F(1)\n"
        "A(x) : {if (x == 2) {y = 0; while (y < 1) {z = 1;}}} 1 --> A(x+1)\nendlsystem\n");
    const Outcome outcome = run({"grow", "fails.l", "-str", "-", "-o", "p.stl"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "A(2)F(1)\n");
    expect_in(outcome.err, "fails.l:4");
    EXPECT_TRUE(has("p.stl"));
}

TEST_F(GrowCommand, ComputesTheLightOfQueries) {
    const Outcome outcome = run(
        {"grow", "asking.l", "--light", "light.qmc", "-str", "-", "-o", "light.csv", "--series",
         "s"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_in(outcome.err, "\nlight of step 2, 660: organs absorb ");
    EXPECT_EQ(outcome.out.find("?E(0)P(0.2,0.5)]F"), std::string::npos) << outcome.out;
    expect_in(folder_.read("light.csv"), "# step: 2\n");
    expect_in(folder_.read("light.csv"), "\n1,P,0.0999");
    expect_in(folder_.read("light.csv"), ",absorbed_flux_660,absorbed_flux_660_se,");
    const std::string table = folder_.read("s/steps.csv");
    expect_in(table, "\n0,1,0,0,,,\n1,");
    expect_in(run({"grow", "asking.l"}).err, "queries have no answers: give --light or -e");
}

/// With this line of the view file the last pass is over the final string.
TEST_F(GrowCommand, GivesOrgansTheirLight) {
    folder_.write("asking.v", "environment display: before\ninitial line width: 0.1\n");
    const Outcome outcome = run({"grow", "asking.l", "--light", "light.qmc", "-o", "p.ply"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_in(outcome.err, "\nlight of step 2, 660: organs absorb ");
    expect_in(folder_.read("p.ply"), "property double absorbed_flux_660\n");
}

/// In a stand all shapes have light; a module has the material of its name.
TEST_F(GrowCommand, GrowsAPlantInAStand) {
    folder_.write(
        "stand.toml",
        "bands = [\"PAR\"]\n[run]\npaths = 256\n[[source]]\ntype = \"sky\"\n"
        "model = \"uniform\"\nirradiance_horizontal = 100\n[[material]]\nname = \"soil\"\n"
        "reflectance = 0.2\n[[material]]\nname = \"P\"\nreflectance = 0.1\n[ground]\n"
        "material = \"soil\"\nx = [-4, 4]\ny = [-4, 4]\n");
    const Outcome outcome = run(
        {"grow", "asking.l", "--light", "stand.toml", "-str", "-", "-o", "light.csv", "--series",
         "s"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_in(outcome.err, "\nlight of step 2, PAR: organs absorb ");
    EXPECT_EQ(outcome.out.find("?E(0)P(0.2,0.5)]F"), std::string::npos) << outcome.out;
    const std::string table = folder_.read("light.csv");
    expect_in(table, "# step: 2\n");
    expect_in(table, "F 1");
    expect_in(table, "ground");
    expect_refused({"grow", "asking.l", "--light", "none.toml"}, 1, "none.toml");
}

TEST_F(GrowCommand, StopsAfterAStepAtCtrlC) {
    folder_.write(
        "long.l",
        "lsystem: 1\nderivation length: 1000000000\naxiom: A(0)\nA(x) --> A(x+1)\nendlsystem\n");
    const Outcome outcome = shell(
        "set -m; \"$quasimc\" grow long.l -v -str long.txt 2>err & "
        "until grep -q 'step 9:' err || ! kill -0 $!; do sleep 0.01; done; kill -INT $!; wait $!");
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_TRUE(folder_.read("long.txt").starts_with("A(")) << folder_.read("long.txt");
}

TEST_F(GrowCommand, ShowsItsStepsInABrowser) {
    if (embedded_page().script.empty()) {
        GTEST_SKIP() << "built without the viewer";
    }
    const Outcome outcome = shell(
        "set -m; \"$quasimc\" grow plant.l --view 2>err & "
        "for i in {1..400}; do grep -q stays err && break; sleep 0.05; done; "
        "kill -INT $!; wait $!");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(address_in(folder_.read("err")), "") << folder_.read("err");
}

}  // namespace
}  // namespace quasimc::test
