// Materials from spectra.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "light/daylight/band_mean.h"
#include "light/daylight/solar_reference.h"
#include "optics/prospect.h"
#include "optics/side.h"
#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

constexpr const char* kTop =
    "irradiance_unit = 'W m-2'\n[[band]]\nname = 'blue'\nfrom_nm = 400\nto_nm = 500\n"
    "[[band]]\nname = 'photons'\nunit = 'umol m-2 s-1'\nfrom_nm = 400\nto_nm = 500\n";

RunText spectrum_text(const std::string& keys = "") {
    RunText text;
    text.top = kTop;
    text.materials = "[[material]]\nname = 'leaf'\nspectrum = 'leaf.csv'\n" + keys;
    return text;
}

const FakeFiles kLeaf{
    {"leaf.csv",
     "# a leaf\nwavelength_nm,reflectance,transmittance\n300,0.1,0.0\n400,0.1,0.0\n"
     "500,0.3,0.2\n900,0.3,0.2\n"}};

/// Reflectance and transmittance of the leaf's Lambertian lobes.
std::pair<double, double> optics_of_band(const RunFile& run, std::size_t band) {
    std::pair<double, double> optics{0, 0};
    const Material& leaf = data_of(run.scene).material(run.scene.regions()[0]);
    for (const Lobe& lobe : leaf.side(SurfaceSide::upper).lobes()) {
        const bool is_reflected = lobe.shape->hemisphere() == Hemisphere::reflected;
        (is_reflected ? optics.first : optics.second) += lobe.albedo[band];
    }
    return optics;
}

/// Under light that is alike at every wavelength a reflectance that grows from 0.1 to 0.3 has the
/// mean 0.2; photons grow with the wavelength: (int r x dx) / (int x dx) from 400 to 500.
TEST(RunFileSpectrum, MeansOfStraightLinesAreExact) {
    const RunFile run = read_text(spectrum_text("spectrum_light = 'flat'\n").text(), kLeaf);
    EXPECT_NEAR(optics_of_band(run, 0).first, 0.2, 1e-14);
    EXPECT_NEAR(optics_of_band(run, 0).second, 0.1, 1e-14);
    const double mean = 0.1 + 0.002 * ((125e6 - 64e6) / 3 / 45000 - 400);
    EXPECT_NEAR(optics_of_band(run, 1).first, mean, 1e-14);
}

TEST(RunFileSpectrum, DaylightIsTheUsualWeight) {
    const RunFile usual = read_text(spectrum_text().text(), kLeaf);
    const RunFile global = read_text(spectrum_text("spectrum_light = 'global'\n").text(), kLeaf);
    const RunFile flat = read_text(spectrum_text("spectrum_light = 'flat'\n").text(), kLeaf);
    EXPECT_EQ(optics_of_band(usual, 0), optics_of_band(global, 0));
    EXPECT_NE(optics_of_band(usual, 0), optics_of_band(flat, 0));
    // By the midpoint rule in steps that are much finer than the table's.
    double sum = 0, all = 0;
    for (int i = 0; i < 100000; ++i) {
        const double nm = 400 + (i + 0.5) / 1000;
        sum += (0.1 + 0.002 * (nm - 400)) * reference_global().at(nm);
        all += reference_global().at(nm);
    }
    EXPECT_NEAR(optics_of_band(usual, 0).first, sum / all, 1e-9);
}

TEST(BandMean, WithoutLightIsTheMeanOverWavelengths) {
    const Spectrum property({100, 200}, {0, 1}), light({300, 400}, {1, 1});
    EXPECT_NEAR(band_mean(property, light, {100, 200}), 0.5, 1e-14);
}

TEST(RunFileSpectrum, TellsFaults) {
    const auto expect = [](const FakeFiles& files, const std::string& keys, const char* part) {
        EXPECT_TRUE(mentions(faults_of(spectrum_text(keys).text(), files), part)) << part;
    };
    expect({}, "", "file 'leaf.csv' can't be read");
    expect({{"leaf.csv", "400,0.1\n500,0.1\n"}}, "", "leaf.csv:1: the names of the columns");
    const std::string names = "wavelength_nm,reflectance,transmittance\n";
    expect({{"leaf.csv", names + "400,0.6,0.5\n"}}, "", "leaf.csv:2: is not a row of a spectrum");
    expect({{"leaf.csv", names + "400,0,0\n400,0,0\n"}}, "", "leaf.csv:3: the wavelength does not");
    expect(
        {{"leaf.csv", names + "400,0.1\n450,0.1\n"}}, "",
        "covers 400 to 450 nm, band 'blue' 400 to 500");
    expect(kLeaf, "reflectance = 0.1\n", "its optics are given twice");
    expect(kLeaf, "spectrum_light = 'moon'\n", "spectrum_light: 'moon' is not one of");
    RunText text = spectrum_text();
    text.top = "bands = ['odd']\n";
    EXPECT_TRUE(mentions(faults_of(text.text(), kLeaf), "the wavelengths of band 'odd'"));
}

constexpr const char* kLeafModel =
    "optics = {model = 'prospect_d', structure = 1.5, chlorophyll_ug_cm2 = 40, "
    "carotenoids_ug_cm2 = 10, water_cm = 0.015, dry_matter_g_cm2 = 0.01}\n";

RunText leaf_model_text(const std::string& keys = kLeafModel) {
    RunText text;
    text.top = kTop;
    text.materials = "[[material]]\nname = 'leaf'\n" + keys;
    return text;
}

/// What a file of the model's spectrum would give, for each kind of light.
TEST(RunFileLeafModel, IsTheMeanOfItsSpectrum) {
    std::string file = "wavelength_nm,reflectance,transmittance\n";
    const LeafConstituents leaf{
        .structure = 1.5, .chlorophyll = 40, .carotenoids = 10, .water = 0.015, .dry_matter = 0.01};
    for (const LeafConstants& row : leaf_constants()) {
        const LeafOptics optics = prospect(row, leaf);
        file += fmt::format("{},{},{}\n", row.nm, optics.reflectance, optics.transmittance);
    }
    for (const std::string light :
         {"", "spectrum_light = 'flat'\n", "spectrum_light = 'direct'\n"}) {
        const RunFile model = read_text(leaf_model_text(kLeafModel + light).text());
        const RunFile spectrum = read_text(spectrum_text(light).text(), {{"leaf.csv", file}});
        for (const std::size_t band : {0U, 1U}) {
            EXPECT_EQ(optics_of_band(model, band), optics_of_band(spectrum, band)) << light;
        }
    }
    RunText dead = leaf_model_text(kLeafModel);
    dead.materials +=
        "[material.lower]\noptics = {model = 'prospect_d', structure = 2, "
        "chlorophyll_ug_cm2 = 0, carotenoids_ug_cm2 = 1, brown_pigments = 1, "
        "anthocyanins_ug_cm2 = 1, water_cm = 0, dry_matter_g_cm2 = 0.01}\n";
    const RunFile sides = read_text(dead.text());
    EXPECT_EQ(optics_of_band(sides, 0), optics_of_band(read_text(leaf_model_text().text()), 0));
}

TEST(RunFileLeafModel, TellsFaults) {
    const auto expect = [](const std::string& keys, const char* part) {
        EXPECT_TRUE(mentions(faults_of(leaf_model_text(keys).text()), part)) << part;
    };
    const std::string rest = "structure = 1.5, chlorophyll_ug_cm2 = 40, carotenoids_ug_cm2 = 10, ";
    expect(
        "optics = {model = 'prospect', " + rest + "water_cm = 0, dry_matter_g_cm2 = 0}\n",
        "did you mean 'prospect_d'");
    expect("optics = {model = 'prospect_d', " + rest + "dry_matter_g_cm2 = 0}\n", "water_cm");
    expect("optics = {model = 'prospect_d', structure = 0.5}\n", "structure is 0.5");
    expect("optics = {model = 'prospect_d', chlorophyl = 1}\n", "chlorophyl");
    expect(kLeafModel + std::string("reflectance = 0.1\n"), "its optics are given twice");
    expect(
        kLeafModel + std::string("spectrum_light = 'moon'\n"),
        "spectrum_light: 'moon' is not one of");
    RunText text = leaf_model_text();
    text.top = "[[band]]\nname = 'UV'\nfrom_nm = 300\nto_nm = 400\n";
    EXPECT_TRUE(mentions(
        faults_of(text.text()), "'prospect_d' covers 400 to 2500 nm, band 'UV' 300 to 400 nm"));
}

RunText usual_text(const std::string& keys) {
    RunText text;
    text.top = "bands = ['PAR', 'NIR']\n";
    text.materials = "[[material]]\nname = 'leaf'\n" + keys;
    return text;
}

/// CLM 5.0, tables of plant functional types and of soils.
TEST(RunFileOptics, AreThoseOfTheRegionOfEachBand) {
    const RunFile grass = read_text(usual_text("optics = 'grass_leaf'\n").text());
    EXPECT_EQ(optics_of_band(grass, 0), (std::pair{.11, .05}));
    EXPECT_EQ(optics_of_band(grass, 1), (std::pair{.35, .34}));
    const auto soil = [](const std::string& keys) {
        const RunFile run = read_text(usual_text("optics = 'soil'\n" + keys).text());
        return std::pair{optics_of_band(run, 0).first, optics_of_band(run, 1).first};
    };
    EXPECT_EQ(soil("soil_color = 20\n"), (std::pair{.08, .16}));  // .04 + .11 is more than dry
    EXPECT_EQ(soil("soil_color = 1\nwater_content = 0.5\n"), (std::pair{.25, .50}));
    EXPECT_NEAR(soil("soil_color = 10\nwater_content = 0.2\n").first, .14 + .03, 1e-15);
}

TEST(RunFileOptics, TellFaults) {
    const auto expect = [](const std::string& keys, const char* part) {
        EXPECT_TRUE(mentions(faults_of(usual_text(keys).text()), part)) << part;
    };
    expect("optics = 'gras_leaf'\n", "did you mean 'grass_leaf'");
    expect("optics = 'grass_leaf'\nreflectance = 0.1\n", "its optics are given twice");
    expect("optics = 'soil'\n", "soil_color");
    expect("optics = 'soil'\nsoil_color = 21\n", "soil_color");
    RunText text = usual_text("optics = 'broad_leaf'\n");
    text.top = "[[band]]\nname = 'all'\nfrom_nm = 400\nto_nm = 1000\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "below and above 700 nm"));
}

}  // namespace
}  // namespace quasimc::test
