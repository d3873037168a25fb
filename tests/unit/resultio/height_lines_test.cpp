#include "resultio/height_lines.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::string stripes(int layer) {
    const int count = 1 << (layer - 1);
    return fmt::format(
        "[[organ]]\nmaterial = 'leaf'\nshape = 'parallelogram'\ncorner = [-{0}, 0, {1}]\n"
        "edge_a = [{2}, 0, 0]\nedge_b = [0, 1, 0]\n"
        "at = {{ start = [0, 0, 0], along = [1, 0, 0], counts = {3} }}\n",
        .25 / count, 4 - layer, .5 / count, count);
}

/// Three layers of stripes over a cell of 1 x 1, each of which covers half of what every other
/// leaves free and half of what it covers: their shadows are independent, as Beer's law has it.
RunText independent_layers(const std::string& heights, const std::string& optics) {
    RunText text;
    text.top = "bands = ['PAR']\nlength_unit = 'm'\n";
    text.run = "[run]\npaths = 4096\n";
    text.materials = "[[material]]\nname = 'leaf'\n" + optics;
    text.organs = stripes(1) + stripes(2) + stripes(3);
    text.rest =
        "[cell]\nx = [0, 1]\ny = [0, 1]\n[ground]\nmaterial = 'leaf'\n"
        "[[sensors]]\nname = 'profile'\naverage = true\nheights = " +
        heights +
        "\nat = { start = [0, 0, 0], along = [1, 0, 0], across = [0, 1, 0], counts = [64, 8] }\n";
    return text;
}

struct Printed {
    double mean = 0, error = 0, height = 0;
};

/// The numbers of "PAR: transmittance 0.5000 +- 0.003 at 2.5 m, ...".
std::vector<Printed> printed(const std::string& line) {
    std::vector<Printed> all;
    std::size_t begin = line.find("transmittance ") + 14;
    while (begin < line.size()) {
        const std::size_t end = std::min(line.find(", ", begin), line.size());
        const std::string text = line.substr(begin, end - begin);
        Printed& own = all.emplace_back();
        own.mean = std::stod(text);
        const std::size_t sign = text.find("+- ");
        own.error = sign == std::string::npos ? 0 : std::stod(text.substr(sign + 3));
        own.height = std::stod(text.substr(text.find(" at ") + 4));
        begin = end + 2;
    }
    return all;
}

std::vector<std::string> lines_of(const RunFile& run, const Result& result) {
    TransmittanceSum sum(run.scene);
    sum.add(result, 1);
    return sum.lines(run);
}

/// With a leaf area index of 1/2 in each layer and black leaves: 2^-layers.
TEST(HeightLines, FollowBeersLawBelowIndependentBlackLayers) {
    const RunFile run =
        read_text(independent_layers("[3.5, 2.5, 1.5, 0.5]", "reflectance = 0\n").text());
    const auto lines = lines_of(run, quasimc::run(run.scene, run.sources, run.spec));
    ASSERT_EQ(lines.size(), 1U);
    const auto levels = printed(lines[0]);
    ASSERT_EQ(levels.size(), 4U) << lines[0];
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double expected = std::exp2(static_cast<double>(i) - 3);
        EXPECT_NEAR(levels[i].height, .5 + static_cast<double>(i), 1e-12) << "the lowest first";
        EXPECT_LT(levels[i].error, .01);
        EXPECT_NEAR(levels[i].mean, expected, 5 * levels[i].error + 1e-4) << lines[0];
    }
}

/// Scattered light counts too: on the ground it is the light on the ground.
TEST(HeightLines, EndAtTheTransmittanceOfTheCanopy) {
    const RunFile run =
        read_text(independent_layers("[0]", "reflectance = 0.4\ntransmittance = 0.3\n").text());
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    const auto level = printed(lines_of(run, result).at(0)).at(0);
    const Estimate& on_ground = result.canopy[0].transmittance;
    EXPECT_GT(on_ground.mean, .2);
    EXPECT_LT(level.error, .01);
    EXPECT_NEAR(
        level.mean, on_ground.mean, 5 * std::hypot(level.error, on_ground.standard_error) + 1e-4);
}

TEST(HeightLines, WeighTimesByTheirLight) {
    const RunFile run = read_text(independent_layers("[2]", "reflectance = 0\n").text());
    TransmittanceSum sum(run.scene);
    const auto result_of = [](double incident, double light) {
        Result sensors;
        sensors.bands = 1;
        sensors.values.assign(kQuantities, {light, .1, light, light});
        Result result;
        result.bands = 1;
        result.canopy.resize(1);
        result.canopy[0].incident = incident;
        result.sensors = std::make_shared<const Result>(std::move(sensors));
        return result;
    };
    sum.add(result_of(10, 5), 1);
    sum.add(result_of(30, 7), 1);
    sum.add(result_of(0, 0), 1);
    // (5 + 7) / 40, hypot(.1, .1) / 40.
    EXPECT_EQ(sum.lines(run).at(0), "PAR: transmittance 0.3000 +- 0.004 at 2 m");
}

TEST(HeightLines, NameSensorsAtEqualHeightsAndLeaveOutOthers) {
    RunText text = independent_layers("[1.5]", "reflectance = 0\n");
    const std::string mean = "average = true\nat = [[0.1, 0, 1.5], [0.9, 0, 1.5]]\n";
    text.rest += "[[sensors]]\nname = 'row'\n" + mean + "[[sensors]]\nname = 'tilted'\n" +
                 "facing = [0, 1, 1]\n" + mean + "[[sensors]]\nname = 'ball'\n" +
                 "receiver = 'sphere'\n" + mean +
                 "[[sensors]]\nname = 'point'\nat = [[0.5, 0.5, 1.5]]\n";
    const RunFile run = read_text(text.text());
    const std::string line = lines_of(run, quasimc::run(run.scene, run.sources, run.spec)).at(0);
    EXPECT_NE(line.find("at 1.5 m (profile at 1.5), "), std::string::npos) << line;
    EXPECT_NE(line.find("at 1.5 m (row)"), std::string::npos) << line;
    EXPECT_EQ(printed(line).size(), 2U) << line;
}

TEST(HeightLines, AreNoneWithoutLevelMeans) {
    RunText text = independent_layers("[1.5]", "reflectance = 0\n");
    text.rest.resize(text.rest.find("[[sensors]]"));
    const RunFile run = read_text(text.text());
    EXPECT_TRUE(lines_of(run, quasimc::run(run.scene, run.sources, run.spec)).empty());
}

}  // namespace
}  // namespace quasimc::test
