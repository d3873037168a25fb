#include "coupling/step_files.h"

#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

#include "coupling_testing.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

TEST(StepFiles, AreNumbered) {
    EXPECT_EQ(numbered_name("light.dat", 12), "light0012.dat");
    EXPECT_EQ(numbered_name("out.d/light", 3), "out.d/light0003");
}

class StepFilesTest : public FolderTest {
  protected:
    /// The files of a black leaf tilted by 60 degrees, and half of one in its shade, in 4 runs.
    void write(const std::string& directives) {
        const bool has_leaf = directives.find("leaf material") != std::string::npos;
        const std::string black = has_leaf ? "" : "leaf material (top): 0 0 0 0\n";
        PlantLight light(
            specification(
                black + "number of rays: 4096\nnumber of runs: 4\nreturn type: D\n" + directives,
                cached_),
            cached_.notices);
        static_cast<void>(answers_of(
            light, "0 E(1)P(1,2)\n 0 1 0\n 0 0.8660254 -0.5\n -1 0 0\n 0 0.5 0.8660254\n" +
                       flat(1, "P(1,2)", 0) + flat(2, "P(1,2)", -1, "E(-1)")));
    }
    [[nodiscard]] std::vector<std::vector<double>> rows(const std::string& name) const {
        std::istringstream lines(folder_.read(name));
        std::string line;
        std::getline(lines, line);
        std::vector<std::vector<double>> all;
        while (std::getline(lines, line)) {
            std::istringstream words(line);
            all.emplace_back();
            for (double value = 0; words >> value;) {
                all.back().push_back(value);
            }
        }
        return all;
    }

    RecordedNotices cached_;
};

TEST_F(StepFilesTest, TellAreasAndVariances) {
    write("return variance: yes " + (folder_.path() / "v.dat").string() + "\n");
    const auto table = rows("v.dat");
    ASSERT_EQ(table.size(), 2U);  // it has no organs that only shade
    ASSERT_EQ(table[0].size(), 7U);
    const double projected = 2 * std::cos(std::numbers::pi / 3);
    EXPECT_NEAR(table[0][0], 2, 1e-5);
    EXPECT_NEAR(table[0][1], projected, 1e-5);
    EXPECT_NEAR(table[0][2], projected, 1e-3);  // in full light
    EXPECT_NEAR(table[0][3], 0, 1e-3);
    EXPECT_NEAR(table[0][4], 0.5, 1e-3);  // mean
    EXPECT_NEAR(table[0][5], 0.5, 1e-3);  // of light from above
    EXPECT_GE(table[0][6], 0);
    EXPECT_NEAR(table[1][1], 2, 1e-6);
    EXPECT_NEAR(table[1][2] + table[1][3], table[1][1], 1e-5);
    // Seen from above the rhombi of widths 2 and lengths 1 and 2 overlap on 2/3.
    EXPECT_NEAR(table[1][2], 4.0 / 3, 0.02);
}

TEST_F(StepFilesTest, NameColumnsAsTheOriginal) {
    const std::string name = (folder_.path() / "v.dat").string();
    write("output file: yes " + name + "\n");
    EXPECT_TRUE(folder_.read("v.dat").starts_with(
        "actual_leaf_area mean_projected_area sunlit_area shaded_area "
        "mean_flux0 rel_mean_flux0 variance0\n"));
    write(
        "output file: yes " + name +
        "\nspectrum samples: 2\nsource spectrum: 1 1 2 1\nleaf material (top): 0 0 0 0\n"
        ": 0.5 0 0 0\n");
    EXPECT_NE(
        folder_.read("v.dat").find(
            " mean_flux1 rel_mean_flux1 variance1 ratio variance_of_ratio\n"),
        std::string::npos);
}

TEST_F(StepFilesTest, AreNumberedAfterTheFirst) {
    PlantLight light(
        specification(
            "number of rays: 64\noutput file: yes " + (folder_.path() / "v.dat").string() + "\n",
            cached_),
        cached_.notices);
    for (std::uint64_t step = 0; step < 3; ++step) {
        light.set_step(step);
        static_cast<void>(answers_of(light, flat(0, "P(1,2)", 1)));
    }
    for (const char* name : {"v.dat", "v0001.dat", "v0002.dat"}) {
        EXPECT_TRUE(std::filesystem::exists(folder_.path() / name)) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "v0000.dat"));
}

/// One run: every number is one, and the sunlit area, which has an error, is never all but more.
TEST_F(StepFilesTest, HaveNoNegativeShadeAndNoUnknownVariance) {
    bool was_more = false;
    for (int seed = 1; seed <= 8; ++seed) {
        write(
            "method: light_tracing\nnumber of runs: 1\nnumber of rays: 256\nspectrum samples: 2\n"
            "source spectrum: 1 1 2 1\nleaf material (top): 0 0 0 0\n: 0.5 0 0 0\n"
            "sampling method: monte carlo\nseed: " +
            std::to_string(seed) + "\noutput file: yes " + (folder_.path() / "v.dat").string() +
            "\n");
        for (const auto& row : rows("v.dat")) {
            ASSERT_EQ(row.size(), 12U) << seed;
            EXPECT_GE(row[3], 0) << seed;
            EXPECT_EQ(row[6], 0) << seed;
            EXPECT_EQ(row[9], 0) << seed;
            EXPECT_EQ(row[11], 0) << seed;
            was_more = was_more || row[2] > row[1];
        }
    }
    EXPECT_TRUE(was_more);  // else the test shows nothing
}

TEST_F(StepFilesTest, TellTheVarianceOfOneRunHoweverManyThereAre) {
    const std::string name = (folder_.path() / "v.dat").string();
    const auto variance = [&](const std::string& runs) {
        write(
            "method: light_tracing\nsampling method: monte carlo\nnumber of rays: 256\n"
            "return variance: yes " +
            name + "\nnumber of runs: " + runs + "\n");
        return rows("v.dat").at(0).at(6);
    };
    // The sample variances of 100 and 400 runs differ by a fifth or so.
    const double ratio = variance("400") / variance("100");
    EXPECT_GT(ratio, 0.5);
    EXPECT_LT(ratio, 2);
}

TEST_F(StepFilesTest, DoNotTellWhatIsSunlitWhereDirectLightIsIgnored) {
    write(
        "ignore direct light: yes\nreturn variance: yes " + (folder_.path() / "v.dat").string() +
        "\n");
    EXPECT_NE(folder_.read("v.dat").find("\n2 1 nan nan"), std::string::npos)
        << folder_.read("v.dat");
}

TEST_F(StepFilesTest, ShowThePlantInColours) {
    write("picture file: " + (folder_.path() / "p.ply").string() + "\n");
    const std::string ply = folder_.read("p0000.ply");
    EXPECT_TRUE(ply.starts_with("ply\n"));
    EXPECT_NE(ply.find("element face 6\n"), std::string::npos);
    EXPECT_NE(ply.find("property uchar red"), std::string::npos);
    EXPECT_EQ(ply.find(" 128 128 128 nan "), std::string::npos);
}

TEST_F(StepFilesTest, ShowInGreyWhatNoSensorMeasures) {
    write("rays from objects: yes 90\npicture file: " + (folder_.path() / "p.ply").string() + "\n");
    EXPECT_NE(folder_.read("p0000.ply").find(" 128 128 128 nan "), std::string::npos);
}

}  // namespace
}  // namespace quasimc::test
