// Suns, skies and sites of run files.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "quasimc/source.h"
#include "unit/runfile/io_testing.h"
#include "weather/read_sky_table.h"

namespace quasimc::test {
namespace {

/// A run file with a site and these sources.
std::string with_sources(const std::string& sources) {
    RunText text;
    text.top = "bands = ['PAR']\nsite = { latitude_deg = 50.1, longitude_deg = 8.7 }\n";
    text.sources = sources;
    return text.text();
}

const std::string kSun =
    "[[source]]\ntype = 'sun'\ntime = 2024-06-21T12:00:00+02:00\nirradiance_facing = 400\n";

std::string sky(const std::string& model, const std::string& more = "") {
    return "[[source]]\ntype = 'sky'\nmodel = '" + model + "'\nirradiance_horizontal = 50\n" + more;
}

/// Towards the first source, in the axes of the file.
Vec3 towards_source(const RunFile& run) {
    return run.scene.orientation().outward(
        model_of(*run.sources[0]).illuminate({}, .5, .5).to_light);
}

void expect_near(const Vec3& v, const Vec3& expected) {
    EXPECT_LT(length(v - expected), 1e-6) << v.x << " " << v.y << " " << v.z;
}

TEST(RunFileSun, IsWhereTimeAndSiteSay) {
    const RunFile run = read_text(with_sources(kSun));
    const SunPosition sun =
        sun_position({50.1, 8.7, 0, standard_pressure_hpa(0)}, {2024, 6, 21, 12, 0, 0, 2});
    EXPECT_TRUE(run.sources[0]->is_directional());
    EXPECT_NEAR(
        run.sources[0]->horizontal_irradiance(),
        std::sin(sun.elevation_deg * std::numbers::pi / 180), 1e-12);
    EXPECT_TRUE(mentions(run.source_notes, "2024-06-21T12:00+02:00 at latitude 50.1"));
    EXPECT_TRUE(mentions(run.source_notes, "sun: azimuth 139.49"));
    expect_near(towards_source(run), {0.340284, -0.398409, 0.851749});
}

TEST(RunFileSun, TimesMayBeTextsOrDatesOfToml) {
    const std::string quoted =
        "[[source]]\ntype = 'sun'\ntime = '2024-06-21 10:00Z'\nirradiance_facing = 400\n";
    EXPECT_NEAR(
        read_text(with_sources(quoted)).sources[0]->horizontal_irradiance(),
        read_text(with_sources(kSun)).sources[0]->horizontal_irradiance(), 1e-9);
}

TEST(RunFileSun, FollowsTheAxesOfTheFile) {
    const std::string south =
        "[[source]]\ntype = 'sun'\nazimuth_deg = 180\nelevation_deg = 45\nirradiance_facing = 1\n";
    RunText text;
    text.sources = south;
    text.top = "bands = ['PAR']\nup = 'y'\nnorth = [0, 0, 1]\n";
    expect_near(towards_source(read_text(text.text())), {0, 0.70710678, -0.70710678});
    text.top = "bands = ['PAR']\nnorth = [1, 0, 0]\n";
    expect_near(towards_source(read_text(text.text())), {-0.70710678, 0, 0.70710678});
}

TEST(RunFileSun, MayBeADisk) {
    const RunFile run = read_text(with_sources(kSun + "disk = true\n"));
    EXPECT_FALSE(run.sources[0]->is_directional());
    EXPECT_TRUE(run.sources[0]->is_sun());
    EXPECT_TRUE(mentions(run.source_notes, "disk of radius 0.2623 deg"));
}

TEST(RunFileSun, BelowTheHorizonGivesNoLightAndSaysSo) {
    std::string night = kSun;
    night.replace(night.find("12:00:00"), 8, "23:30:00");
    const RunFile run = read_text(with_sources(night + sky("cie_overcast")));
    EXPECT_EQ(run.sources[0]->spectrum()[0], 0);
    std::vector<std::string> warnings;
    for (const Warning& warning : run.warnings) {
        warnings.push_back(warning.text);
    }
    EXPECT_TRUE(mentions(warnings, "the sun is below the horizon and gives no light"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources(night + sky("cie_clear"))),
        "the sun is below the horizon (azimuth "));
}

TEST(RunFileSun, NeedsATimeZoneASiteAndADateThatIs) {
    const auto faults_with_time = [](const std::string& time) {
        std::string source = kSun;
        const std::size_t at = source.find("2024");
        source.replace(at, source.find('\n', at) - at, time);
        return faults_of(with_sources(source + sky("cie_overcast")));
    };
    EXPECT_TRUE(mentions(faults_with_time("2024-06-21T12:00:00"), "has no time zone"));
    EXPECT_FALSE(mentions(faults_with_time("2024-06-21T12:00:00"), "utc_offset_hours"))
        << "a sun has no such key";
    EXPECT_TRUE(mentions(faults_with_time("'2023-02-29T12:00Z'"), "month 2 of 2023 has 28 days"));
    EXPECT_TRUE(
        mentions(faults_with_time("'2024-06-21T12:00+15:00'"), "its time zone is 15 h from UTC"));
    EXPECT_TRUE(mentions(faults_with_time("'2016-12-31T23:58:60Z'"), "a leap second comes after"));
    EXPECT_TRUE(mentions(faults_with_time("'noon'"), "'noon' is not a time"));
    EXPECT_TRUE(mentions(faults_with_time("12"), "time is an integer"));
    EXPECT_TRUE(faults_with_time("'2016-12-31T23:59:60Z'").empty());
    RunText text;
    text.sources = kSun;
    EXPECT_TRUE(mentions(faults_of(text.text()), "time without [site]"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources(kSun + "azimuth_deg = 3\n")), "both time and angles are given"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources("[[source]]\ntype = 'sun'\nirradiance_facing = 1\n")),
        "the position of the sun is missing"));
    EXPECT_TRUE(mentions(faults_of(with_sources(kSun + "disc = true\n")), "did you mean 'disk'?"));
}

TEST(RunFileSite, IsOnTheEarth) {
    RunText text;
    text.top = "bands = ['PAR']\nsite = { latitude_deg = 91, longitud_deg = 8 }\n";
    const std::vector<std::string> faults = faults_of(text.text());
    EXPECT_TRUE(mentions(faults, "latitude_deg is 91"));
    EXPECT_TRUE(mentions(faults, "longitude_deg is missing"));
    EXPECT_TRUE(mentions(faults, "did you mean 'longitude_deg'?"));
    EXPECT_EQ(faults.size(), 3);
}

TEST(RunFileSky, KnowsEveryModel) {
    const std::string all = sky("uniform") + sky("cie_overcast") + sky("cie_clear") +
                            sky("cie_general", "cie_type = 7\n") +
                            sky("perez", "direct_normal = 700\ndiffuse_horizontal = 100\n") +
                            sky("preetham", "turbidity = 4\n") + kSun;
    const RunFile run = read_text(with_sources(all));
    ASSERT_EQ(run.sources.size(), 7);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(run.sources[i]->spectrum()[0], 50);
        EXPECT_EQ(run.sources[i]->horizontal_irradiance(), 1);
    }
    EXPECT_TRUE(mentions(run.source_notes, "cie_general sky (type 7), sun at azimuth 139.49"));
    EXPECT_TRUE(run.sources[6]->is_directional()) << "sources stay in their order";
}

TEST(RunFileSky, MayHaveASunOfItsOwn) {
    const RunFile run =
        read_text(with_sources(kSun + sky("cie_clear", "azimuth_deg = 0\nelevation_deg = 30\n")));
    EXPECT_TRUE(mentions(run.source_notes, "sun at azimuth 0 deg, elevation 30 deg"));
    const double north = model_of(*run.sources[1]).radiance({0, .866025, .5});
    EXPECT_GT(north, 5 * model_of(*run.sources[1]).radiance({0, -.866025, .5}));
}

TEST(RunFileSky, TellsAllThatIsWrong) {
    EXPECT_TRUE(
        mentions(faults_of(with_sources(sky("cie_clear"))), "the position of the sun is missing"));
    EXPECT_TRUE(mentions(faults_of(with_sources(sky("cie_cler"))), "did you mean 'cie_clear'?"));
    EXPECT_TRUE(
        mentions(faults_of(with_sources(kSun + sky("cie_general"))), "cie_type is missing"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources(kSun + sky("cie_general", "cie_type = 16\n"))), "cie_type is 16"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources(kSun + sky("preetham", "turbidity = 1\n"))), "turbidity is 1"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources(kSun + sky("perez", "direct_normal = 1\ndiffuse_horizontal = 0\n"))),
        "diffuse_horizontal is 0"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources(sky("uniform", "turbidity = 3\n"))), "unknown key 'turbidity'"));
    EXPECT_TRUE(mentions(
        faults_of(with_sources("[[source]]\ntype = 'sky'\nmodel = 'uniform'\n")),
        "irradiance_horizontal is missing"));
}

const std::string kTable = sky("table", "file = 'sky.txt'\n");

TEST(RunFileSky, MayBeATable) {
    // Four azimuths from north over east; the east is bright.
    const FakeFiles files{{"sky.txt", "# a sky\n4 2\n1 9 1 1\n1 9 1 1 # the upper ring\n"}};
    const RunFile run = read_text(with_sources(kTable), files);
    const auto towards = [](double azimuth_deg) { return Orientation().towards(azimuth_deg, 30); };
    EXPECT_NEAR(
        model_of(*run.sources[0]).radiance(towards(135)),
        9 * model_of(*run.sources[0]).radiance(towards(45)), 1e-9);
    EXPECT_NEAR(
        model_of(*run.sources[0]).radiance(towards(225)),
        model_of(*run.sources[0]).radiance(towards(45)), 1e-12);
    EXPECT_TRUE(mentions(run.source_notes, "sky of sky.txt (4 x 2 cells, values: radiance)"));
    EXPECT_EQ(run.inputs.back().path, "sky.txt");
}

TEST(RunFileSky, TablesHaveTheirFaultsToldByLine) {
    const auto faults_with = [](const std::string& text, const std::string& more = "") {
        return faults_of(with_sources(kTable + more), {{"sky.txt", text}});
    };
    EXPECT_TRUE(mentions(faults_with(""), "sky.txt: is empty"));
    EXPECT_TRUE(mentions(faults_with("4\n"), "sky.txt:1: does not give the size"));
    EXPECT_TRUE(mentions(faults_with("2 1\n1 -1\n"), "sky.txt:2: '-1' is not a value of a sky"));
    EXPECT_TRUE(mentions(faults_with("2 1\n1 nan\n"), "sky.txt:2: 'nan' is not a value of a sky"));
    EXPECT_TRUE(mentions(faults_with("2 1\n1\n"), "sky.txt:2: a value is missing"));
    EXPECT_TRUE(mentions(faults_with("2 1\n1 2 3\n"), "sky.txt:2: has too many values"));
    EXPECT_TRUE(mentions(faults_with("2 2\n1 2\n"), "ends after 1 of 2 rings"));
    EXPECT_TRUE(mentions(faults_with("2 1\n1 2\n3 4\n"), "sky.txt:3: is one line too many"));
    EXPECT_TRUE(mentions(faults_with("2 1\n0 0\n"), "a sky must have light somewhere"));
    EXPECT_TRUE(mentions(
        faults_with("2 1\n1 2\n", "format = 'radiance'\n"), "format: 'radiance' is not one of"));
    EXPECT_TRUE(
        mentions(faults_with("2 1\n1 2\n", "values = 'light'\n"), "values: 'light' is not one of"));
    EXPECT_TRUE(mentions(faults_of(with_sources(kTable)), "sky.txt"));
    const std::string vlab = "format = 'vlab'\n";
    EXPECT_TRUE(mentions(faults_with("2 1\n0 0 1\n0 1\n", vlab), "sky.txt:3: a value is missing"));
    EXPECT_TRUE(mentions(faults_with("2 1\n0 0 1\n0 up 1\n", vlab), "sky.txt:3: is not a cell"));
}

/// Azimuth by azimuth, over west, from the horizon up, whatever angles are written.
TEST(SkyTableFile, OfTheOriginalProgramRunsOverWest) {
    const SkyTable table = read_sky_table(
        "2 3\n0 0 1\n0 0 2\n0 0 3\n9 9 4\n9 9 5\n9 9 6\n", "sky", SkyFileFormat::vlab,
        SkyValues::radiance);
    EXPECT_EQ(table.radiance, (std::vector<double>{1, 4, 2, 5, 3, 6}));
    EXPECT_EQ(table.turn, 1);
    EXPECT_EQ(table.at(1, 0), 4);
}

TEST(SkyTableFile, MayStateTheLightOfEachCell) {
    const SkyTable table =
        read_sky_table("1 2\n1\n1\n", "sky", SkyFileFormat::cells, SkyValues::flux);
    const double low = std::sin(std::numbers::pi / 4);
    EXPECT_NEAR(table.radiance[1] / table.radiance[0], low / (1 - low), 1e-12);
    EXPECT_EQ(table.turn, -1);
}

}  // namespace
}  // namespace quasimc::test
