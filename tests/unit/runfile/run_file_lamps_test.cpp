#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/length_units.h"
#include "light/models/source.h"
#include "quasimc/run.h"
#include "unit/runfile/io_testing.h"
#include "weather/read_ies.h"

namespace quasimc::test {
namespace {

using std::numbers::pi;

std::string with_lamp(const std::string& keys, const std::string& top = "bands = ['PAR']\n") {
    RunText text;
    text.top = top;
    text.sources = "[[source]]\n" + keys;
    return text.text();
}

/// An IES file of a flat Lambertian panel of 1000 lm, 0.6 m wide and 1.2 m long.
std::string lambertian_ies(int horizontal = 1, const std::string& tilt = "TILT=NONE\n") {
    std::string text = "IESNA:LM-63-2002\n[TEST] none\n" + tilt;
    text += fmt::format("1 -1 1 19 {} 1 2 0.6 1.2 0\n1.0 1.0 10\n", horizontal);
    for (int i = 0; i <= 18; ++i) {
        text += fmt::format("{} ", 5 * i);
    }
    text += "\n";
    for (int j = 0; j < horizontal; ++j) {
        text += fmt::format("{} ", horizontal == 1 ? 0 : 360 * j / (horizontal - 1));
    }
    for (int j = 0; j < horizontal; ++j) {
        text += "\n";
        for (int i = 0; i <= 18; ++i) {
            text += fmt::format("{:.6f}\n", 1000 / pi * std::cos(5 * i * pi / 180));
        }
    }
    return text;
}

struct ReadIes {
    IesFile file;
    std::vector<std::string> faults, warnings;
};
ReadIes ies(const std::string& text) {
    Reporter reporter{"lamp.ies", {}, {}};
    ReadIes read{read_ies(text, reporter), {}, {}};
    for (const Warning& warning : reporter.warnings) {
        read.warnings.push_back(warning.where + ": " + warning.text);
    }
    try {
        reporter.faults.throw_if_any();
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            read.faults.push_back(fault.text());
        }
    }
    return read;
}

TEST(Ies, IsReadWithItsOpeningAndItsFactors) {
    for (const std::string tilt :
         {"TILT=NONE\n", "TILT=INCLUDE\n1\n3\n0 45 90\n1.0 .9 .8\n", "TILT=other.tlt\n"}) {
        const ReadIes read = ies(lambertian_ies(1, tilt));
        EXPECT_TRUE(read.faults.empty());
        EXPECT_EQ(read.file.width_m, .6);
        EXPECT_EQ(read.file.length_m, 1.2);
        EXPECT_EQ(read.file.web.vertical_deg.size(), 19U);
        EXPECT_NEAR(read.file.web.candela[0], 1000 / pi, 1e-5);
    }
    std::string dimmed = lambertian_ies();
    dimmed.replace(dimmed.find("1 -1 1 19"), 9, "1 -1 2 19");
    dimmed.replace(dimmed.find("1.0 1.0 10"), 10, "0.8 1.0 10");
    EXPECT_NEAR(ies(dimmed).file.web.candela[0], 1.6 * 1000 / pi, 1e-5);
}

TEST(Ies, TurnsFeetIntoMetresAndKnowsRoundOpenings) {
    std::string feet = lambertian_ies();
    feet.replace(feet.find("1 2 0.6"), 7, "1 1 0.6");
    EXPECT_NEAR(ies(feet).file.width_m, .6 * .3048, 1e-12);
    std::string round = lambertian_ies();
    round.replace(round.find("0.6 1.2 0"), 9, "-0.4 0 0");
    EXPECT_NEAR(ies(round).file.radius_m, .2, 1e-12);
}

/// 1000 lm, up to the straight lines between angles 5 degrees apart.
TEST(Ies, HasTheFluxOfItsIntensities) {
    EXPECT_NEAR(web_pattern(ies(lambertian_ies()).file.web).total(), 1000, 1.5);
    EXPECT_NEAR(web_pattern(ies(lambertian_ies(5)).file.web).total(), 1000, 1.5);
}

TEST(Ies, IsMirroredAsItsAnglesSay) {
    PhotometricWeb web;
    web.vertical_deg = {0, 90};
    const auto at = [&](double phi_deg) {
        const double theta = .9;
        const double phi = phi_deg * pi / 180;
        return web_pattern(web).intensity(
            {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    };
    web.horizontal_deg = {0, 45, 90};
    web.candela = {1, 1, 1, 2, 1, 5};
    EXPECT_NEAR(at(30), at(150), 1e-12);
    EXPECT_NEAR(at(30), at(210), 1e-12);
    EXPECT_NEAR(at(30), at(330), 1e-12);
    EXPECT_GT(at(90), at(0));
    web.horizontal_deg = {0, 90, 180};
    EXPECT_NEAR(at(60), at(300), 1e-12);
    EXPECT_GT(at(120), at(60));
    web.horizontal_deg = {0, 180, 360};
    EXPECT_GT(at(60), at(300));  // azimuths of files count the other way about the aim
}

TEST(Ies, RefusesWhatItCantRead) {
    EXPECT_TRUE(mentions(ies("IESNA91\n1 2 3\n").faults, "no line TILT="));
    std::string type_b = lambertian_ies();
    type_b.replace(type_b.find("1 1 2 0.6"), 9, "1 2 2 0.6");
    EXPECT_TRUE(mentions(ies(type_b).faults, "only type C"));
    std::string words = lambertian_ies();
    words.replace(words.find("0.6 1.2"), 3, "wide");
    EXPECT_TRUE(mentions(ies(words).faults, "'wide' is not a number"));
    std::string shorter = lambertian_ies();
    EXPECT_TRUE(mentions(ies(shorter.substr(0, shorter.size() - 12)).faults, "the file ends"));
    std::string backward = lambertian_ies();
    backward.replace(backward.find("5 10 15"), 7, "5 15 10");
    EXPECT_TRUE(mentions(ies(backward).faults, "vertical angles are not in order"));
    std::string negative = lambertian_ies();
    negative.replace(negative.rfind("27.7"), 1, "-");
    EXPECT_TRUE(mentions(ies(negative).faults, "negative"));
    std::string many = lambertian_ies();
    many.replace(many.find("1 19 1 1 2"), 10, "1 1e99 1 1 2");
    EXPECT_TRUE(mentions(ies(many).faults, "vertical angles"));
}

TEST(RunFileLamps, AreOfSevenTypes) {
    const FakeFiles files{{"lamp.ies", lambertian_ies()}};
    for (const std::string keys :
         {"type = 'point'\nposition = [0, 0, 3]\n",
          "type = 'spot'\nposition = [0, 0, 3]\ncone_deg = 30\nsoft_from_deg = 20\n",
          "type = 'spot'\nposition = [0, 0, 3]\nexponent = 20\naim = [0, 1, -1]\n",
          "type = 'rectangle'\nposition = [0, 0, 3]\nlength = 1\nwidth = 0.2\nalong = [1, 1, 0]\n",
          "type = 'disk'\nposition = [0, 0, 3]\nradius = 0.2\n",
          "type = 'line'\nfrom = [-1, 0, 3]\nto = [1, 0, 3]\n",
          "type = 'sphere'\nposition = [0, 0, 3]\nradius = 0.2\n",
          "type = 'ies'\nposition = [0, 0, 3]\nfile = 'lamp.ies'\n",
          "type = 'ies'\nposition = [0, 0, 3]\nfile = 'lamp.ies'\nopening = 'point'\n"}) {
        SCOPED_TRACE(keys);
        const RunFile run = read_text(with_lamp(keys + "power = 60\n"), files);
        ASSERT_EQ(run.sources.size(), 1U);
        EXPECT_TRUE(run.sources[0]->is_lamp());
        EXPECT_EQ(run.sources[0]->spectrum()[0], 60);
        EXPECT_NE(run.source_notes[0].find("emits PAR 60 W"), std::string::npos);
    }
}

TEST(RunFileLamps, KnowEveryUnitOfLength) {
    const std::string keys = "type = 'point'\nposition = [0, 0, 100]\npower = 1\n";
    for (const LengthUnit& unit : kLengthUnits) {
        const std::string name(unit.name);
        const RunFile run =
            read_text(with_lamp(keys, "bands = ['PAR']\nlength_unit = '" + name + "'\n"));
        EXPECT_DOUBLE_EQ(run.sources.at(0)->spectrum()[0], 1 / (unit.metres * unit.metres)) << name;
    }
}

/// A lamp in centimetres lights as the same lamp in metres.
TEST(RunFileLamps, FluxGoesWithTheUnitOfLength) {
    const std::string keys = "type = 'point'\nposition = [0, 0, 100]\npower = 1\n";
    const RunFile run = read_text(with_lamp(keys, "bands = ['PAR']\nlength_unit = 'cm'\n"));
    const Illumination seen = model_of(*run.sources[0]).illuminate({0, 0, 0}, .5, .5);
    EXPECT_NEAR(run.sources[0]->spectrum()[0] * seen.weight, 1 / (4 * pi), 1e-9);
    EXPECT_TRUE(
        mentions(faults_of(with_lamp(keys, "bands = ['PAR']\nlength_unit = 'cubit'\n")), "cubit"));
}

TEST(RunFileLamps, EmitInTheUnitOfEachBand) {
    const std::string bands =
        "[[band]]\nname = 'PAR'\nunit = 'umol m-2 s-1'\n[[band]]\nname = 'NIR'\nunit = 'W m-2'\n";
    const std::string point = "type = 'point'\nposition = [0, 0, 3]\n";
    const auto spectrum = [&](const std::string& keys) {
        const RunFile run = read_text(with_lamp(point + keys, bands));
        const auto emitted = run.sources.at(0)->spectrum();
        return std::vector<double>(emitted.begin(), emitted.end());
    };
    EXPECT_EQ(spectrum("photon_flux = [100, 0]\npower = [0, 7]\n"), (std::vector<double>{100, 7}));
    EXPECT_EQ(spectrum("photon_flux = [100, 0]\n"), (std::vector<double>{100, 0}));
    EXPECT_TRUE(
        mentions(faults_of(with_lamp(point + "power = [1, 7]\n", bands)), "power for band 'PAR'"));
}

TEST(RunFileLamps, SayWhatIsWrong) {
    const std::string point = "type = 'point'\nposition = [0, 0, 3]\n";
    EXPECT_TRUE(mentions(faults_of(with_lamp(point)), "its flux is missing"));
    EXPECT_TRUE(mentions(
        faults_of(with_lamp(point + "power = 1\nphoton_flux = 2\n")),
        "photon_flux for band 'PAR' in W m-2"));
    EXPECT_TRUE(
        mentions(faults_of(with_lamp(point + "photon_flux = 2\n")), "irradiance umol m-2 s-1"));
    EXPECT_TRUE(mentions(faults_of(with_lamp(point + "power = 2\nradius = 1\n")), "radius"));
    const std::string spot = "type = 'spot'\nposition = [0, 0, 3]\npower = 1\n";
    EXPECT_TRUE(mentions(faults_of(with_lamp(spot)), "cone_deg"));
    EXPECT_TRUE(mentions(
        faults_of(with_lamp(spot + "cone_deg = 10\nsoft_from_deg = 20\n")), "must not exceed it"));
    EXPECT_TRUE(mentions(
        faults_of(with_lamp(spot + "cone_deg = 10\naim = [0, 0, 0]\n")), "it has no direction"));
    EXPECT_TRUE(mentions(
        faults_of(with_lamp("type = 'line'\nfrom = [1, 0, 3]\nto = [1, 0, 3]\npower = 1\n")),
        "the same point"));
    EXPECT_TRUE(mentions(
        faults_of(with_lamp("type = 'disk'\nposition = [0, 0, 3]\nradius = 0\npower = 1\n")),
        "radius"));
    EXPECT_TRUE(mentions(
        faults_of(
            with_lamp("type = 'ies'\nposition = [0, 0, 3]\nfile = 'x.ies'\npower = 1\n"),
            {{"x.ies", "nonsense"}}),
        "no line TILT="));
}

/// The rectangle and the file of a Lambertian panel light a floor alike, near and far.
TEST(RunFileLamps, AnIesFileOfALambertianPanelIsTheRectangle) {
    for (const double height : {.3, 3.0}) {
        const auto light = [&](const std::string& keys) {
            RunText text;
            text.sources = fmt::format(
                "[[source]]\nposition = [0.3, 0.2, {}]\nalong = [1, 0, 0]\npower = 1\n{}",
                1 + height, keys);
            text.run = "[run]\nmethod = 'from_organs'\npaths = 65536\n";
            const RunFile run = read_text(text.text(), {{"lamp.ies", lambertian_ies()}});
            return quasimc::run(run.scene, run.sources, run.spec)
                .at(0, Quantity::incident_upper, 0);
        };
        const Estimate rectangle = light("type = 'rectangle'\nlength = 1.2\nwidth = 0.6\n");
        const Estimate file = light("type = 'ies'\nfile = 'lamp.ies'\n");
        // Straight lines between 5 degrees: some parts in a thousand.
        EXPECT_NEAR(file.mean, rectangle.mean, 3e-3 * rectangle.mean) << height;
        EXPECT_LT(rectangle.standard_error, 1e-3 * rectangle.mean);
    }
}

/// Warnings of a disk of this radius under a point lamp 100 above it.
std::vector<std::string> lamp_warnings(const std::string& unit, double radius) {
    RunText text;
    text.top = "bands = ['PAR']\n" + unit;
    text.materials = "[[material]]\nname = 'leaf'\nreflectance = 0.1\n";
    text.sources = "[[source]]\ntype = 'point'\nposition = [0, 0, 150]\npower = 100\n";
    text.organs = fmt::format(
        "[[organ]]\nmaterial = 'leaf'\nshape = 'disk'\ncenter = [0, 0, 50]\nnormal = [0, 0, 1]\n"
        "radius = {}\n",
        radius);
    std::vector<std::string> texts;
    for (const Warning& warning : read_text(text.text()).warnings) {
        texts.push_back(warning.where + ": " + warning.text);
    }
    return texts;
}

TEST(Lamps, WarnOfAUnitThatIsNotGivenAndOfPlantsOfStrangeSize) {
    EXPECT_EQ(
        lamp_warnings("", 5),
        std::vector<std::string>{
            "length_unit: is missing, and metres are assumed (the median organ is 14.2 m large); "
            "the irradiance from lamps depends on it; set length_unit to the unit of the "
            "coordinates, \"m\" or \"cm\""});
    EXPECT_EQ(lamp_warnings("", 0.1).size(), 1U);
    EXPECT_EQ(lamp_warnings("length_unit = 'cm'\n", 5), std::vector<std::string>{});
    EXPECT_EQ(lamp_warnings("length_unit = 'm'\n", 0.1), std::vector<std::string>{});
    EXPECT_TRUE(mentions(
        lamp_warnings("length_unit = 'm'\n", 5),
        "the median organ is 14.2 m large if coordinates are in m"));
    EXPECT_TRUE(mentions(
        lamp_warnings("length_unit = 'mm'\n", 0.5),
        "all organs together are 0.00142 m large if coordinates are in mm"));
}

TEST(Lamps, BelowTheGroundAreWarnedOf) {
    for (const char* lamp :
         {"type = 'point'\n", "type = 'disk'\nradius = 0.1\n", "type = 'spot'\ncone_deg = 20\n"}) {
        for (const double height : {-0.5, 2.0}) {
            RunText text;
            text.top = "bands = ['PAR']\nlength_unit = 'm'\n";
            text.sources = fmt::format(
                "[[source]]\nname = 'lamp'\n{}position = [0.2, 0.3, {}]\npower = 100\n", lamp,
                height);
            text.rest = "[ground]\nmaterial = 'leaf'\n";
            std::vector<std::string> texts;
            for (const Warning& warning : read_text(text.text()).warnings) {
                texts.push_back(warning.where + ": " + warning.text);
            }
            EXPECT_EQ(mentions(texts, "source 'lamp': is a lamp 0.5 below the ground"), height < 0)
                << lamp;
        }
    }
}

TEST(Ies, RefusesOrWarnsOfWhatDoesNotFit) {
    const auto with = [](const std::string& old, const std::string& text) {
        std::string file = lambertian_ies();
        file.replace(file.find(old), old.size(), text);
        return ies(file);
    };
    EXPECT_EQ(
        with("19 1 1 2 0.6", "19 1 1 3 0.6").faults,
        std::vector<std::string>{"lamp.ies:4: unit of length 3 (1 is feet, 2 is metres)"});
    EXPECT_TRUE(mentions(
        with("1 -1 1 19", "1 -1 1e308 19").faults, "an intensity is negative or too large"));
    EXPECT_TRUE(mentions(ies(lambertian_ies() + "17 more").warnings, "'17' follows the last"));
    EXPECT_TRUE(ies(lambertian_ies() + "\r\n\x1A").warnings.empty());
    EXPECT_TRUE(mentions(
        ies(lambertian_ies(1, "TILT=other.tlt\n")).warnings, "TILT refers to 'other.tlt'"));
    EXPECT_TRUE(mentions(
        ies("Maker of lamps\n1\n1\n4\n90\n19\n5\nreport\n").faults, "convert a EULUMDAT file"));
}

}  // namespace
}  // namespace quasimc::test
