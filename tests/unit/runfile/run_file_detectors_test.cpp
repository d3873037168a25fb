#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "detectors/catalogue.h"
#include "quasimc/result_file.h"
#include "quasimc/run.h"
#include "quasimc/run_file.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::string with_detectors(const std::string& tables) {
    RunText text;
    text.top = "bands = ['R', 'N']\n";
    text.materials = "[[material]]\nname = 'leaf'\nreflectance = 0.5\n";
    text.rest = tables;
    return text.text();
}

std::string detector_of(std::string_view type, const std::string& keys) {
    return fmt::format("[[detector]]\ntype = '{}'\n{}", type, keys);
}

/// The keys of all parameters of a type but one.
std::string keys_of(const DetectorEntry& type, std::string_view omitted) {
    std::string keys;
    for (const DetectorParameter& p : type.parameters) {
        if (p.name != omitted) {
            keys += fmt::format("{} = {}\n", p.name, shortest(p.usual.value_or(p.high)));
        }
    }
    return keys;
}

TEST(RunFileDetectors, EveryTypeTakesTheKeysOfItsRow) {
    for (const DetectorEntry& type : detector_catalogue()) {
        SCOPED_TRACE(type.name);
        const auto faults_with = [&](const std::string& keys) {
            return faults_of(with_detectors(detector_of(type.name, keys)));
        };
        EXPECT_TRUE(faults_with(keys_of(type, "")).empty());
        EXPECT_TRUE(mentions(faults_with("colour = 3\n"), "unknown key 'colour'"));
        for (const DetectorParameter& p : type.parameters) {
            const std::string others = keys_of(type, p.name);
            EXPECT_EQ(
                mentions(faults_with(others), fmt::format("{} is missing", p.name)), !p.usual);
            const std::string beyond =
                fmt::format("{}{} = {}\n", others, p.name, shortest(2 * p.high + 1));
            EXPECT_TRUE(mentions(faults_with(beyond), fmt::format("{} is ", p.name)));
        }
    }
}

TEST(RunFileDetectors, FaultsStandAtTheirLines) {
    const auto faults_of_detector = [](const std::string& tables) {
        return faults_of(with_detectors(tables));
    };
    EXPECT_TRUE(mentions(
        faults_of_detector("[[detector]]\ntype = 'escaped_by_zenit'\n"),
        "did you mean 'escaped_by_zenith'?"));
    EXPECT_TRUE(mentions(
        faults_of_detector(detector_of("escaped_by_zenith", "rigs = 3\n")),
        "unknown key 'rigs'; did you mean 'rings'?"));
    EXPECT_TRUE(mentions(faults_of_detector("[[detector]]\nname = 'a'\n"), "type is missing"));
    const std::string twice = detector_of("escaped_by_zenith", "name = 'up'\n");
    const auto faults = faults_of_detector(twice + twice);
    EXPECT_TRUE(mentions(faults, "detector 'up' exists already"));
    EXPECT_TRUE(mentions(faults, "run.toml:"));
}

struct TracedRun {
    Result result;
    nlohmann::json json;
};
TracedRun traced(const std::string& tables) {
    RunFile run = read_text(with_detectors(tables));
    run.spec.paths = 256;
    const Result result = quasimc::run(run.scene, run.sources, run.spec);
    std::string json;
    static_cast<void>(write_json(run, result, [&](std::string_view piece) { json += piece; }));
    return {result, nlohmann::json::parse(json)};
}

TEST(RunFileDetectors, AreReadAndTheirLightIsWritten) {
    const auto [result, json] = traced(
        detector_of("escaped_by_zenith", "name = 'up'\nrings = 2\n") +
        detector_of("escaped_by_zenith", ""));
    ASSERT_EQ(json["detectors"].size(), 2U);
    const auto& up = json["detectors"][0];
    EXPECT_EQ(up["name"], "up");
    EXPECT_EQ(up["type"], "escaped_by_zenith");
    EXPECT_EQ(up["quantity"], "zenith angle (deg)");
    EXPECT_EQ(up["unit"]["N"], "W");
    ASSERT_EQ(up["bins"].size(), 2U);
    EXPECT_EQ(up["bins"][0]["bin"], "0 to 90");
    ASSERT_EQ(result.detectors.size(), 2U);
    const Estimate& expected = result.detectors[0].at(0, 1);
    const auto& written = up["bins"][0]["flux"]["N"];
    EXPECT_EQ(written["mean"], expected.mean);
    EXPECT_EQ(written["standard_error"], expected.standard_error);
    EXPECT_EQ(written["ci95_low"], expected.ci95_low);
    EXPECT_EQ(written["ci95_high"], expected.ci95_high);
    EXPECT_GT(expected.mean, .2);
    // The leaf passes nothing on below.
    EXPECT_EQ(up["bins"][1]["flux"]["N"]["mean"], 0.);
    EXPECT_TRUE(up["bins"][1]["flux"]["N"]["standard_error"].is_null());
    EXPECT_EQ(up["bins"][1]["flux"]["N"]["ci95_high"], result.detectors[0].at(1, 1).ci95_high);
    EXPECT_EQ(json["detectors"][1]["name"], "escaped_by_zenith");
    EXPECT_EQ(json["detectors"][1]["bins"].size(), 9U);
}

TEST(RunFileDetectors, ResultsWithoutThemDoNotMentionThem) {
    EXPECT_FALSE(traced("").json.contains("detectors"));
}

}  // namespace
}  // namespace quasimc::test
