#include <limits>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics/material.h"

namespace quasimc::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

MaterialSpec grey_leaf(std::size_t bands) {
    const std::vector<SideOptics> side(bands, {.reflectance = 0.1, .transmittance = 0.05});
    return {"leaf", side, side};
}

/// All faults, one a line.
std::string faults_of(const MaterialSpec& spec, std::size_t bands, const std::string& where = "") {
    Faults faults;
    check_material(spec, bands, where, faults);
    try {
        faults.throw_if_any();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CheckMaterial, PassesWhatIsInOrder) {
    EXPECT_EQ(faults_of(grey_leaf(3), 3), "");
    MaterialSpec edges = grey_leaf(2);
    edges.upper[0] = {.reflectance = 1, .reflection_model = "mirror"};
    edges.upper[1] = {
        .reflectance = 0.7,
        .transmittance = 0.3,
        .reflection_model = "phong",
        .reflection_parameters = {{"exponent", kMaxExponent}}};
    EXPECT_EQ(faults_of(edges, 2), "");
}

TEST(CheckMaterial, RefusesASurfaceThatMakesLight) {
    MaterialSpec spec = grey_leaf(2);
    spec.upper[1] = {.reflectance = 0.75, .transmittance = 0.5};
    EXPECT_EQ(
        faults_of(spec, 2),
        "material 'leaf', upper side, band 2: reflectance 0.75 + transmittance 0.5 = 1.25 (the "
        "surface would create light)");
}

TEST(CheckMaterial, RefusesWhatIsNotAFraction) {
    for (const double bad : {-0.1, kNan, kInfinity, -kInfinity, 1.5}) {
        MaterialSpec spec = grey_leaf(1);
        spec.lower[0].reflectance = bad;
        EXPECT_NE(faults_of(spec, 1).find("lower side, band 1: reflectance is"), std::string::npos)
            << bad;
        spec = grey_leaf(1);
        spec.upper[0].transmittance = bad;
        EXPECT_NE(
            faults_of(spec, 1).find("upper side, band 1: transmittance is"), std::string::npos)
            << bad;
    }
}

TEST(CheckMaterial, SuspectsAPercentage) {
    MaterialSpec spec = grey_leaf(1);
    spec.upper[0].reflectance = 12;
    EXPECT_EQ(
        faults_of(spec, 1),
        "material 'leaf', upper side, band 1: reflectance is 12 (a fraction of the light, 0 ... "
        "1); "
        "a percentage? write 0.12");
}

TEST(CheckMaterial, SuggestsTheModelThatWasMeant) {
    MaterialSpec spec = grey_leaf(1);
    spec.upper[0].reflection_model = "Phnog";
    spec.lower[0].transmission_model = "blinn-phong";
    EXPECT_EQ(
        faults_of(spec, 1),
        "material 'leaf', upper side, band 1: no reflection model 'Phnog'; did you mean 'phong'?\n"
        "material 'leaf', lower side, band 1: no transmission model 'blinn-phong'; did you mean "
        "'blinn_phong'?");
}

TEST(CheckMaterial, RefusesExponentsThatNoLobeHas) {
    for (const double bad : {-1.0, kNan, kInfinity}) {
        MaterialSpec spec = grey_leaf(1);
        spec.upper[0].transmission_parameters["exponent"] = bad;
        EXPECT_NE(faults_of(spec, 1).find("transmission exponent is"), std::string::npos) << bad;
    }
    MaterialSpec spec = grey_leaf(1);
    spec.upper[0].reflection_parameters["exponent"] = 2e6;
    EXPECT_EQ(faults_of(spec, 1), "") << "the Lambertian model ignores it";
    spec.upper[0].reflection_model = "phong";
    EXPECT_EQ(
        faults_of(spec, 1),
        "material 'leaf', upper side, band 1: reflection exponent is 2000000 (0 ... 1000000); for "
        "one direction use model 'mirror'");
}

TEST(CheckMaterial, NamesAParameterThatIsMissingOrThatNoModelTakes) {
    MaterialSpec spec = grey_leaf(1);
    spec.upper[0].reflection_model = "phong";
    spec.lower[0].transmission_parameters["roughness"] = 1;
    EXPECT_EQ(
        faults_of(spec, 1),
        "material 'leaf', upper side, band 1: reflection exponent is missing (model 'phong' has "
        "it)\nmaterial 'leaf', lower side, band 1: transmission roughness is given (no model has "
        "this parameter)");
}

TEST(CheckMaterial, CountsTheBandsOfBothSides) {
    MaterialSpec spec = grey_leaf(2);
    spec.lower.clear();
    EXPECT_EQ(
        faults_of(spec, 3, "canopy.toml:7"),
        "canopy.toml:7, upper side: optics for 2 of the bands (there are 3)\n"
        "canopy.toml:7, lower side: optics for 0 of the bands (there are 3)");
}

TEST(CheckMaterial, ReportsAllFaultsAtOnce) {
    MaterialSpec spec = grey_leaf(3);
    spec.upper[0].reflectance = kNan;
    spec.upper[2].reflection_model = "gloss";
    spec.lower[1].transmittance = 0.95;
    Faults faults;
    check_material(spec, 2, "", faults);
    EXPECT_EQ(faults.size(), 5U);  // two of them the number of bands
}

TEST(MakeMaterial, MergesEqualLobesOfTheBandsAndDropsBlackOnes) {
    MaterialSpec spec = grey_leaf(5);
    for (std::size_t b = 0; b < 5; ++b) {
        spec.upper[b].reflection_parameters["exponent"] =
            static_cast<double>(b);  // ignored by Lambert's law
        spec.upper[b].transmission_model = "phong";
        spec.upper[b].transmission_parameters["exponent"] = b % 2 == 0 ? 10 : 20;
    }
    spec.upper[1].transmittance = 0;
    spec.upper[2].transmittance = 0;
    const Material m = make_material(spec, 5);
    ASSERT_EQ(m.side(SurfaceSide::upper).lobes().size(), 3U);
    EXPECT_EQ(
        m.side(SurfaceSide::upper).lobes()[0].albedo,
        (std::vector<double>{0.1, 0.1, 0.1, 0.1, 0.1}));
    EXPECT_EQ(
        m.side(SurfaceSide::upper).lobes()[1].albedo, (std::vector<double>{0.05, 0, 0, 0, 0.05}));
    EXPECT_EQ(
        m.side(SurfaceSide::upper).lobes()[2].albedo, (std::vector<double>{0, 0, 0, 0.05, 0}));
    EXPECT_EQ(m.side(SurfaceSide::lower).lobes().size(), 2U);
    EXPECT_EQ(m.bands(), 5U);
    EXPECT_EQ(m.name(), "leaf");
}

TEST(MakeMaterial, KeepsReflectedAndTransmittedLobesApart) {
    const Material m = make_material(grey_leaf(1), 1);
    ASSERT_EQ(m.side(SurfaceSide::upper).lobes().size(), 2U);
    EXPECT_EQ(m.side(SurfaceSide::upper).lobes()[0].shape->hemisphere(), Hemisphere::reflected);
    EXPECT_EQ(m.side(SurfaceSide::upper).lobes()[1].shape->hemisphere(), Hemisphere::transmitted);
}

}  // namespace
}  // namespace quasimc::test
