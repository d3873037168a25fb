// Run files that name Caribu's files of optics, light and patterns.

#include <cmath>

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "meshio/caribu_files.h"
#include "optics/side.h"
#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

const FakeFiles kCaribuFiles{
    {"a.can",
     "p 1 100007002001 3 0 0 1 1 0 1 0 1 1\np 1 100007000001 3 0 0 2 1 0 2 0 1 2\n"
     "p 1 1 3 0 0 0 1 0 0 0 1 0\n"},
    {"par.opt", "#  par.opt\nn 1\n#1\ns d 0.15\ne d 0.10   d 0.11 0.05  d 0.12 0.06\n\n"},
    {"nir.opt", "n 1\ns d 0.35\ne d 0.40 d 0.40 0.45 d 0.41 0.46\n"},
    {"two.light", "0.25\t0 0 -1\n0.75 1 0 -1\n"},
    {"a.8", " 2 3\n-1 1\n"}};

RunText caribu_text() {
    RunText text;
    text.top = "bands = ['PAR', 'NIR']\n";
    text.sources = "[[light_file]]\nfile = 'two.light'\nirradiance_horizontal = [100, 80]\n";
    text.materials = "[[material_file]]\nfile = { PAR = 'par.opt', NIR = 'nir.opt' }\n";
    text.organs = "[[geometry]]\nfile = 'a.can'\n";
    text.rest = "[cell]\nfile = 'a.8'\n";
    return text;
}

TEST(RunFileCaribu, TakesSceneOpticsLightAndPatternAsTheyAre) {
    const RunFile run = read_text(caribu_text().text(), kCaribuFiles);
    const Cell& cell = run.scene.cell();
    EXPECT_TRUE(cell.along_x && cell.along_y);
    EXPECT_EQ(cell.low_x, -1);
    EXPECT_EQ(cell.low_y, 1);
    EXPECT_EQ(cell.size_x, 3);
    EXPECT_EQ(cell.size_y, 2);
    const auto absorbed = [&](std::size_t organ, SurfaceSide side, std::size_t band) {
        const Region& region = run.scene.regions()[run.scene.organs()[organ].first_region];
        return data_of(run.scene).material(region).side(side).absorptance()[band];
    };
    EXPECT_DOUBLE_EQ(absorbed(0, SurfaceSide::upper, 0), 1 - 0.11 - 0.05);
    EXPECT_DOUBLE_EQ(absorbed(0, SurfaceSide::lower, 1), 1 - 0.41 - 0.46);
    EXPECT_DOUBLE_EQ(absorbed(1, SurfaceSide::lower, 0), 1 - 0.10);
    EXPECT_DOUBLE_EQ(absorbed(2, SurfaceSide::upper, 1), 1 - 0.35);
}

TEST(ReadCaribuOptics, ReflectanceComesBeforeTransmittance) {
    Reporter reporter{"file", {}, {}};
    const CaribuOptics optics = read_caribu_optics(kCaribuFiles.at("par.opt"), reporter);
    EXPECT_TRUE(reporter.faults.empty());
    EXPECT_EQ(optics.soil, 0.15);
    ASSERT_EQ(optics.species.size(), 1U);
    EXPECT_EQ(optics.species[0].upper.reflectance, 0.11);
    EXPECT_EQ(optics.species[0].upper.transmittance, 0.05);
    EXPECT_EQ(optics.species[0].lower.reflectance, 0.12);
    EXPECT_EQ(optics.species[0].lower.transmittance, 0.06);
}

TEST(RunFileCaribu, WeightsAreIrradianceOnTheHorizontal) {
    const RunFile run = read_text(caribu_text().text(), kCaribuFiles);
    ASSERT_EQ(run.sources.size(), 2U);
    EXPECT_EQ(run.source_notes.size(), 1U);
    EXPECT_NE(run.source_notes[0].find("2 directions"), std::string::npos);
    EXPECT_NE(run.source_notes[0].find("PAR 100 W m-2, NIR 80"), std::string::npos);
    const auto& slanting = *run.sources[1];
    EXPECT_NEAR(model_of(slanting).illuminate({}, 0.5, 0.5).to_light.z, std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(slanting.horizontal_irradiance() * slanting.spectrum()[0], 75, 1e-12);
}

TEST(RunFileCaribu, TellsFaultsByFileAndLine) {
    FakeFiles files = kCaribuFiles;
    files["nir.opt"] = "n 2\ns d 0.35\ne d 0.40 d 0.40 0.75 d 0.41 0.46\ne d 2\nq\n";
    files["two.light"] = "1 0 0\n-1 0 0 -1\n";
    files["a.8"] = "0 0\n0 1\n";
    const Texts faults = faults_of(caribu_text().text(), files);
    for (const char* part :
         {"nir.opt:3: reflectance + transmittance of a leaf exceeds 1",
          "nir.opt:4: '2' is not a number from 0 to 1",
          "nir.opt:5: 'q' is not the beginning of a line of optics", "two.light:1: 3 numbers",
          "two.light:2: the irradiance is negative", "a.8: is not a rectangle"}) {
        EXPECT_TRUE(mentions(faults, part)) << part;
    }
    files = kCaribuFiles;
    files["two.light"] = "1 0 0 1\n";
    files["nir.opt"] = "n 2\ns d 0.35\ne d 0.40 d 0.40 0.45 d 0.41 0.46\n";
    const Texts more = faults_of(caribu_text().text(), files);
    EXPECT_TRUE(mentions(more, "light 1 of 'two.light' does not travel downwards"));
    EXPECT_TRUE(mentions(more, "nir.opt: says 2 species and has 1"));
    RunText text = caribu_text();
    text.rest += "x = [0, 1]\n";
    EXPECT_TRUE(mentions(faults_of(text.text(), kCaribuFiles), "both a file and ranges"));
    files.erase("a.8");
    EXPECT_TRUE(mentions(faults_of(caribu_text().text(), files), "file 'a.8' can't be read"));
}

}  // namespace
}  // namespace quasimc::test
