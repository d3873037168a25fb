// Every type of detector comes out in every output, with the same numbers: CSV, JSON, NetCDF and C.
// (In Python, tests/python/test_result.py.)

#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "detectors/catalogue.h"
#include "netcdf/netcdf_writer.h"
#include "resultio/output_input.h"
#include "unit/capi/canopy.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

class WrittenDetectors : public ::testing::TestWithParam<std::string> {
  protected:
    /// The usual values, or else the lowest.
    static std::string run_text() {
        RunText text;
        text.top = "bands = ['PAR', 'NIR']\n";
        text.run = "[run]\npaths = 64\nmethod = 'light_tracing'\n";
        text.materials = "[[material]]\nname = 'leaf'\nreflectance = [0.1, 0.5]\n";
        text.rest = fmt::format("[[detector]]\ntype = '{}'\nname = 'it'\n", GetParam());
        for (const DetectorParameter& parameter : find_detector(GetParam())->parameters) {
            text.rest +=
                fmt::format("{} = {}\n", parameter.name, parameter.usual.value_or(parameter.low));
        }
        return text.text();
    }
    [[nodiscard]] const DetectorResult& seen() const { return result_.detectors.at(0); }
    [[nodiscard]] std::string written(MakeOutput* make) const {
        std::string text;
        const auto writer =
            make({run_, [&](std::string_view piece) { text += piece; }, "file", "--file"});
        writer->on_time_step({0, result_});
        writer->finish({});
        return text;
    }

    RunFile run_ = read_text(run_text());
    Result result_ = quasimc::run(run_.scene, run_.sources, run_.spec);
};

INSTANTIATE_TEST_SUITE_P(
    Catalogue,
    WrittenDetectors,
    ::testing::ValuesIn([] {
        std::vector<std::string> names;
        for (const DetectorEntry& type : detector_catalogue()) {
            names.emplace_back(type.name);
        }
        return names;
    }()),
    [](const auto& row) { return row.param; });

TEST_P(WrittenDetectors, HaveARowForEachBinAndBand) {
    std::istringstream table(written(make_detectors));
    std::string line;
    while (std::getline(table, line) && line.starts_with('#')) {
    }
    EXPECT_EQ(line, "detector,bin,band,unit,mean,standard_error,ci95_low,ci95_high");
    for (std::size_t i = 0; i < seen().values.size(); ++i) {
        ASSERT_TRUE(std::getline(table, line));
        const Estimate e = reported(seen().values[i]);
        EXPECT_TRUE(line.starts_with(
            fmt::format("it,{},{},W,{},", seen().bins[i / 2], i % 2 == 0 ? "PAR" : "NIR", e.mean)))
            << line;
        EXPECT_TRUE(line.ends_with(fmt::format(",{},{}", e.ci95_low, e.ci95_high))) << line;
    }
    EXPECT_FALSE(std::getline(table, line));
}

TEST_P(WrittenDetectors, AreInJson) {
    const auto json = nlohmann::json::parse(written(make_json)).at("detectors").at(0);
    EXPECT_EQ(json["type"], GetParam());
    ASSERT_EQ(json["bins"].size(), seen().bins.size());
    for (std::size_t i = 0; i < seen().bins.size(); ++i) {
        EXPECT_EQ(json["bins"][i]["flux"]["NIR"]["mean"], reported(seen().at(i, 1)).mean);
    }
}

/// tests/readers/check_netcdf.py compares the numbers.
TEST_P(WrittenDetectors, AreInNetcdf) {
    if (!has_netcdf()) {
        GTEST_SKIP() << "built without NetCDF";
    }
    const std::string bytes = written(make_netcdf);
    EXPECT_NE(bytes.find("it_standard_error"), std::string::npos);
    for (const std::string& bin : seen().bins) {
        EXPECT_NE(bytes.find(bin), std::string::npos) << bin;
    }
}

TEST_P(WrittenDetectors, AreReadByName) {
    const SceneHandle scene = new_scene();
    ASSERT_EQ(quasimc_scene_state(scene.get(), run_text().c_str()), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    ASSERT_EQ(quasimc_result_detector_count(result.get()), 1);
    EXPECT_STREQ(quasimc_result_detector_name(result.get(), 0), "it");
    const std::int64_t bins = quasimc_result_detector_bin_count(result.get(), "it");
    ASSERT_EQ(bins, static_cast<std::int64_t>(seen().bins.size()));
    std::vector<double> high(seen().bins.size());
    ASSERT_EQ(
        quasimc_result_get_detector(result.get(), "it", "NIR", "ci95_high", high.data(), bins),
        QUASIMC_DONE);
    for (std::size_t i = 0; i < high.size(); ++i) {
        EXPECT_EQ(
            quasimc_result_detector_bin(result.get(), "it", static_cast<std::int64_t>(i)),
            seen().bins[i]);
        EXPECT_EQ(high[i], reported(seen().at(i, 1)).ci95_high);
    }
    EXPECT_EQ(quasimc_result_detector_bin_count(result.get(), "that"), -1);
    EXPECT_STREQ(quasimc_last_error(), "there is no detector 'that'");
    EXPECT_EQ(quasimc_result_detector_bin(result.get(), "it", bins), nullptr);
}

}  // namespace
}  // namespace quasimc::test
