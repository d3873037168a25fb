// Pictures from the command line.

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "picture/image.h"
#include "program.h"

namespace quasimc::test {
namespace {

class ShowCommand : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        if (!has_png()) {
            GTEST_SKIP() << "built without pictures";
        }
    }
    /// The bytes of a picture.
    [[nodiscard]] std::string drawn(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "show");
        arguments.insert(arguments.end(), {"-o", "drawn.png", "--size", "400x300"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const std::string bytes = outcome.status == 0 ? folder_.read("drawn.png") : "";
        EXPECT_TRUE(bytes.starts_with("\x89PNG"));
        return bytes;
    }
    /// The heading of a picture of such numbers, from a GLB file with their colours.
    [[nodiscard]] std::string said(std::vector<std::string> choice) const {
        choice.insert(choice.begin(), {"convert", "out.json", "said.glb"});
        const Outcome outcome = run(choice);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.status == 0 ? folder_.read("said.glb") : "";
    }
    void expect_fault(const std::vector<std::string>& arguments, const std::string& text) const {
        const Outcome outcome = run(arguments);
        const bool names_a_flag = outcome.err.starts_with("error: -");
        EXPECT_EQ(outcome.status, names_a_flag ? 2 : 1) << outcome.err;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    }
};

TEST_F(ShowCommand, DrawsResultsAndScenes) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    EXPECT_EQ(run({"show", "out.json", "-o", "light.png", "--size", "200x100"}).status, 0);
    EXPECT_TRUE(folder_.read("light.png").starts_with("\x89PNG"));
    EXPECT_NE(said({}).find("absorbed flux density, PAR (W m-2): viridis"), std::string::npos);
    const std::string light = drawn({"out.json"});
    const std::vector<std::vector<std::string>> others{
        {"out.json", "--quantity", "incident_upper"},
        {"out.json", "--error"},
        {"out.json", "--camera", "top"},
        {"out.json", "--geometry-only"},
        {"out.json", "--no-annotations"},
        {"run.toml"}};
    for (const std::vector<std::string>& other : others) {
        EXPECT_TRUE(drawn(other) != light) << other.back();
    }
    EXPECT_TRUE(drawn({"out.json", "--camera", "200,20", "--band", "PAR"}) == light);
    folder_.write("named.png", folder_.read("out.json"));
    expect_fault({"show", "named.png", "-o", "./named.png"}, "is an input of this run");
    EXPECT_EQ(folder_.read("named.png"), folder_.read("out.json"));
    const Outcome outcome =
        run({"show", "run.toml", "-o", "-", "--no-annotations", "--size", "64x64"});
    EXPECT_TRUE(outcome.out.starts_with("\x89PNG"));
}

TEST_F(ShowCommand, DrawsLabels) {
    folder_.write(
        "run.toml",
        replaced(good_run_file(), "[[organ]]", "[[organ]]\nlabels = { plant = \"oak <7>\" }"));
    EXPECT_TRUE(drawn({"run.toml", "--label", "plant"}) != drawn({"run.toml"}));
    expect_fault(
        {"show", "run.toml", "-o", "p.png", "--label", "kind"}, "no organ has a label 'kind'");
}

TEST_F(ShowCommand, DrawsManyNumbersOfALabelOnAScale) {
    const auto labelled = [&](int organs) {
        std::string organ_tables;
        for (int i = 0; i < organs; ++i) {
            organ_tables += fmt::format(
                "[[organ]]\nmaterial = \"leaf\"\nshape = \"disk\"\ncenter = [{0}, 0, 1]\n"
                "normal = [0, 0, 1]\nradius = 0.3\nlabels = {{ plant = {0} }}\n",
                i);
        }
        return good_run_file() + organ_tables;
    };
    folder_.write("few.toml", labelled(12));
    folder_.write("many.toml", labelled(30));
    EXPECT_TRUE(
        drawn({"few.toml", "--label", "plant"}) != drawn({"many.toml", "--label", "plant"}));
}

TEST_F(ShowCommand, DrawsTheDifferenceOfTwoResults) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    ASSERT_EQ(run({"run", "run.toml", "--json", "other.json", "--seed", "9"}).status, 0);
    EXPECT_TRUE(drawn({"out.json", "--minus", "other.json"}) != drawn({"out.json"}));
    EXPECT_TRUE(
        drawn({"out.json", "--minus", "other.json"}) != drawn({"out.json", "--minus", "out.json"}));
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--minus", "run.toml"}, "run.toml is not a result");
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--minus", "none.json"}, "none.json: can't be read");
    EXPECT_EQ(
        run({"show", "out.json", "-o", "p.png", "--minus", "other.json", "--error"}).status, 2);
}

TEST_F(ShowCommand, RefusesADifferenceOfUnits) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    folder_.write("photons.toml", "irradiance_unit = \"umol m-2 s-1\"\n" + good_run_file());
    ASSERT_EQ(run({"run", "photons.toml", "--json", "photons.json"}).status, 0);
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--minus", "photons.json"},
        "photons.json: absorbed flux density, PAR is in umol m-2 s-1 here, but in W m-2");
}

TEST_F(ShowCommand, DrawsWithoutABackground) {
    const std::string bare = drawn({"run.toml", "--background", "transparent"});
    ASSERT_GT(bare.size(), 25U);
    EXPECT_EQ(bare[25], 6) << "red, green, blue and alpha";
    EXPECT_EQ(run({"show", "run.toml", "--background", "pink"}).status, 2);
}

TEST_F(ShowCommand, DrawsWhatAnEyeWouldSee) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    EXPECT_TRUE(drawn({"out.json", "--realistic"}) != drawn({"out.json"}));
    expect_fault({"show", "run.toml", "-o", "p.png", "--realistic"}, "run.toml: is not a result");
    folder_.write("run.toml", replaced(good_run_file(), "\"PAR\"", "\"NIR\""));
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    expect_fault({"show", "out.json", "-o", "p.png", "--realistic"}, "no band that an eye sees");
}

TEST_F(ShowCommand, DrawsTimesDaysAndPoints) {
    const std::string times =
        "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
        "[time]\nday = \"2024-06-21\"\nutc_offset_hours = 1\nhours = [11, 13]\nsky = \"uniform\"\n";
    folder_.write("days.toml", good_run_file() + times);
    ASSERT_EQ(run({"run", "days.toml"}).status, 0);
    EXPECT_NE(said({}).find("(J m-2), sum of all times"), std::string::npos);
    EXPECT_NE(
        said({"--time", "2024-06-21T12"}).find("(W m-2), 2024-06-21T12:00+01:00"),
        std::string::npos);
    EXPECT_NE(said({"--day", "2024-06-21"}).find(", 2024-06-21: viridis"), std::string::npos);
    EXPECT_TRUE(drawn({"out.json", "--time", "2024-06-21T12"}) != drawn({"out.json"}));
    EXPECT_TRUE(drawn({"out.json", "--day", "2024-06-21"}) != drawn({"out.json"}));
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--time", "2025"},
        "has no absorbed flux density, PAR of a time that begins '2025' (times without light are "
        "left out); there are 2024-06-21T11:00+01:00 to 2024-06-21T12:00+01:00");
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--day", "2024-06-22"},
        "of a day that begins '2024-06-22' (days without light are left out); there is 2024-06-21");
    const std::vector<std::string> all{"show", "out.json", "--size", "200x150", "-o"};
    const auto numbered = [&](std::vector<std::string> more) {
        more.insert(more.begin(), all.begin(), all.end());
        return run(more);
    };
    for (const char* kind : {"--quantity=incident_upper", "--realistic"}) {
        ASSERT_EQ(numbered({"t_%02d.png", kind}).status, 0);
        EXPECT_TRUE(folder_.read("t_01.png").starts_with("\x89PNG"));
        EXPECT_TRUE(folder_.read("t_01.png") != folder_.read("t_02.png"));
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "t_03.png"));
    }
    EXPECT_NE(
        numbered({"t_%02d.png", "--day", "2024-06-21"}).err.find("one picture is asked for"),
        std::string::npos);
    folder_.write("sweep.toml", good_run_file() + "[sweep]\nseed = [1, 2]\n");
    ASSERT_EQ(run({"run", "sweep.toml"}).status, 0);
    EXPECT_TRUE(said({"--sweep-point", "2"}) != said({"--sweep-point", "1"}));
    EXPECT_FALSE(drawn({"out.json", "--sweep-point", "2"}).empty());
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--sweep-point", "3"},
        "--sweep-point: 3 is out of range (1 to 2)");
    EXPECT_EQ(run({"show", "out.json", "-o", "p.png", "--sweep-point", "0"}).status, 2);
}

TEST_F(ShowCommand, FramesAnotherSceneToo) {
    folder_.write("small.tri", "0 0 0  1 0 0  0 0 1\n");
    folder_.write("large.tri", "0 0 0  5 0 0  0 0 5\n");
    const std::string alone = drawn({"small.tri"});
    EXPECT_TRUE(drawn({"small.tri", "--frame", "small.tri"}) == alone);
    EXPECT_FALSE(drawn({"small.tri", "--frame", "large.tri"}) == alone);
    expect_fault({"show", "small.tri", "-o", "p.png", "--frame", "none.tri"}, "none.tri");
}

TEST_F(ShowCommand, WritesUnderNoNameThatPromisesSomethingElse) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    for (const char* name : {"p.bmp", "p.jpg", "p.pdf", "p.png.txt", "fig.2"}) {
        const std::string ending = std::filesystem::path(name).extension().string();
        expect_fault({"show", "out.json", "-o", name}, "-o: can't write " + ending);
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / name)) << name;
    }
    expect_fault({"show", "out.json", "-o", "p.svg"}, "-o: can't write .svg; name a .png file");
    expect_fault({"run", "run.toml", "--picture", "p.bmp"}, "--picture: can't write .bmp");
    expect_fault(
        {"sky", "--site", "50,8", "--time", "2024-06-21T12:00Z", "--png", "p.svg"},
        "--png: can't write .svg; name a .png file");
    EXPECT_EQ(run({"show", "out.json", "-o", "P.PNG", "--size", "64x64"}).status, 0);
    EXPECT_EQ(run({"show", "out.json", "-o", "v1.2/p", "--size", "64x64"}).status, 1)
        << "no folder";
    EXPECT_EQ(run({"show", "out.json", "-o", "plain", "--size", "64x64"}).status, 0);
    EXPECT_TRUE(folder_.read("plain").starts_with("\x89PNG"));
}

TEST_F(ShowCommand, TellsAllThatIsWrongAndWritesNothing) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--camera", "north", "--clip", "q<1", "--size", "9x9",
         "--range", "5,1"},
        "--camera: 'north' is not a view");
    const Outcome outcome = run(
        {"show", "out.json", "-o", "p.png", "--camera", "1,91", "--clip", "q<1", "--size", "9x9",
         "--range", "5,1"});
    for (const char* flag : {"--camera: ", "--clip: ", "--size: ", "--range: "}) {
        EXPECT_NE(outcome.err.find(flag), std::string::npos) << outcome.err;
    }
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--quantity", "light"},
        "'light' is not one of absorbed_flux, ");
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--band", "UV"}, "'UV' is not a band (bands: PAR)");
    expect_fault({"show", "out.json", "-o", "p.png", "--time", "2024"}, "the run has no [time]");
    expect_fault(
        {"show", "out.json", "-o", "p.png", "--clip", "z<-1000"}, "nothing of the scene is left");
    expect_fault({"show", "out.json", "-o", "leaves.tri"}, "can't write .tri");
    EXPECT_EQ(run({"show"}).status, 2);
    for (const std::string& file : new_files()) {
        EXPECT_EQ(file.find("p.png"), std::string::npos) << file;
    }
}

TEST_F(ShowCommand, IsWhatARunDraws) {
    folder_.write("run.toml", "title = \"T\"\n" + good_run_file());
    ASSERT_EQ(run({"run", "run.toml", "--picture", "run.png"}).status, 0);
    ASSERT_EQ(run({"show", "out.json", "-o", "show.png"}).status, 0);
    EXPECT_TRUE(folder_.read("run.png") == folder_.read("show.png"));
    folder_.write(
        "days.toml", "title = \"T\"\n" +
                         replaced(
                             good_run_file(), "json = \"out.json\"",
                             "json = \"out.json\"\npicture = \"day.png\"") +
                         "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\n"
                         "day = \"2024-06-21\"\nutc_offset_hours = 1\nhours = [11, 13]\n"
                         "sky = \"uniform\"\n");
    ASSERT_EQ(run({"run", "days.toml"}).status, 0);
    ASSERT_EQ(run({"show", "out.json", "-o", "show.png"}).status, 0);
    EXPECT_TRUE(folder_.read("day.png") == folder_.read("show.png"));
}

}  // namespace
}  // namespace quasimc::test
