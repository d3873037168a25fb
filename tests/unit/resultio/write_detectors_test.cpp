// The table of detectors; unit/capi/written_detectors_test.cpp tries every type of detector.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "resultio/output_input.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// Two detectors, of two bins and of one, in two bands; with `more` tables.
RunFile detector_run(const std::string& more) {
    RunText text;
    text.top = "bands = ['PAR', 'NIR']\n";
    text.rest =
        "[[detector]]\ntype = 'escaped_by_zenith'\nname = 'up, down'\nrings = 2\n"
        "[[detector]]\ntype = 'escaped_by_zenith'\nname = 'all'\nrings = 1\n" +
        more;
    return read_text(text.text());
}

/// The table of a result in which every bin has the numbers 3, 1, 2 and 4, without comments.
std::vector<std::string> rows_of(const RunFile& run, std::size_t time_step = 0) {
    Result result = zero_result(run.scene, run.spec);
    for (DetectorResult& detector : result.detectors) {
        detector.values.assign(detector.values.size(), {3, 1, 2, 4});
    }
    std::vector<std::string> rows{""};
    const auto take = [&](std::string_view text) {
        for (const char c : text) {
            c == '\n' ? rows.emplace_back() : rows.back() += c;
        }
    };
    make_detectors({run, take})->on_time_step({time_step, result});
    std::erase_if(rows, [](const auto& row) { return row.empty() || row.starts_with('#'); });
    return rows;
}

TEST(WriteDetectors, HasARowForEachBinAndBand) {
    RunFile run = detector_run("");
    run.output.include_night = true;  // the result is dark
    const std::vector<std::string> rows = rows_of(run);
    ASSERT_EQ(rows.size(), 1U + 2 * 2 + 2);
    EXPECT_EQ(rows[0], "detector,bin,band,unit,mean,standard_error,ci95_low,ci95_high");
    EXPECT_EQ(rows[2], "\"up, down\",0 to 90,NIR,W,3,1,2,4");
    EXPECT_EQ(rows[5], "all,0 to 180,PAR,W,3,1,2,4");
    run.output.bands = {"NIR"};
    EXPECT_EQ(rows_of(run).size(), 1U + 2 + 1);
}

TEST(WriteDetectors, BeginsWithPointsAndTimes) {
    RunFile run = detector_run(
        "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\ntimes = "
        "['2024-06-21T12:00+02:00']\n");
    EXPECT_EQ(rows_of(run).size(), 1U) << "the time is dark";
    run.output.include_night = true;
    run.sweep = std::make_shared<std::vector<SweepPoint>>(std::vector<SweepPoint>{
        {.values = {{.key = "run.seed", .text = "5"}}, .source_notes = {}}});
    const std::vector<std::string> rows = rows_of(run);
    EXPECT_TRUE(rows.at(0).starts_with("run.seed,time,detector,bin,")) << rows[0];
    EXPECT_TRUE(rows.at(6).starts_with("5,2024-06-21T12:00+02:00,all,0 to 180,NIR,")) << rows[6];
}

}  // namespace
}  // namespace quasimc::test
