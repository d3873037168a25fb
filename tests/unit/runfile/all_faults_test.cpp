// Faults of all kinds are reported at once.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A run file with a fault of each kind that later checks find, each in its own table, and the part
/// of each message.
struct FaultyRun {
    std::string organ =
        "[[organ]]\nmaterial = 'leaf'\nshape = 'disk'\ncenter = [0, 0, 1]\n"
        "normal = [0, 0, 1]\nradius = 1\n";
    std::string source = "[[source]]\ntype = 'sky'\nmodel = 'uniform'\nirradiance_horizontal = 1\n";

    [[nodiscard]] std::string text() const {
        return "bands = ['PAR']\n[run]\nlayer_heights = [1, 0]\nratios = ['PAR:FR']\n"
               "origins = ['led*']\nsampler = 'faure'\ntarget_error = 0.1\nreplicates = 1\n"
               "path_allocation = 'proportional'\ntarget_quantity = 'height'\n"
               "[[material]]\nname = 'leaf'\nreflectance = 0\n" +
               organ + source +
               "[[sensors]]\nname = 'top'\nat = [[0, 0, 2]]\nsize = -1\n"
               "[[control]]\nsources = 'lamp'\nsensors = 'crop'\nset_point = 10\n"
               "[[gap_fraction]]\nat = [[0, 0, 0]]\nrings_deg = [50, 10]\n"
               "[output]\ndaily_csv = 'days.csv'\nquantities = ['shade']\n"
               "[[table]]\nfile = 'a.csv'\nwhere = 'colour == 3'\n"
               "[[table]]\nfile = 'b.csv'\norigins = ['moon']\n";
    }
};

/// Faults that need neither organs nor sources.
const Texts kOfTables{
    "run.toml:3: layer_heights: 0 follows 1",
    "run.toml:4: ratios: 'FR' is not a band",
    "run.toml:7: target_error: at least 2 replicates",
    "control 'lamp': it needs [time]",
    "control 'lamp': no sensors are called 'crop'",
    "gap_fraction 'gap_fraction': rings_deg are no bounds",
    "[output]: daily_csv without [time]",
    "[output]: 'shade' is not a quantity",
    "run.toml:10: [run]: target_quantity: 'height'",
    "sensors 'top': size is -1"};
const Texts kOfSources{
    "run.toml:5: origins: no source is called 'led*'", "control 'lamp': no lamp is called 'lamp'",
    "origins: the run has no origin 'moon'",
    "run.toml:9: path_allocation: it is \"proportional\" (the run has no [time])"};
const Texts kOfOrgans{"where: unknown label 'colour'"};

Texts all_of(std::initializer_list<Texts> lists) {
    Texts all;
    for (const Texts& list : lists) {
        all.insert(all.end(), list.begin(), list.end());
    }
    return all;
}

void expect_exactly(const Texts& found, const Texts& expected) {
    for (const std::string& part : expected) {
        EXPECT_EQ(
            std::ranges::count_if(
                found, [&](const std::string& text) { return text.find(part) != text.npos; }),
            1)
            << part;
    }
    EXPECT_EQ(found.size(), expected.size()) << testing::PrintToString(found);
}

TEST(AllFaults, AreReportedAtOnce) {
    expect_exactly(faults_of(FaultyRun().text()), all_of({kOfTables, kOfSources, kOfOrgans}));
}

TEST(AllFaults, OfWhatDependsOnAFaultyOrganAreNotReported) {
    FaultyRun run;
    run.organ += "radii = 3\n";
    expect_exactly(faults_of(run.text()), all_of({kOfTables, kOfSources, {"unknown key 'radii'"}}));
}

TEST(AllFaults, OfWhatDependsOnAFaultySourceAreNotReported) {
    FaultyRun run;
    run.source += "turbidity = 3\n";
    expect_exactly(
        faults_of(run.text()), all_of({kOfTables, kOfOrgans, {"unknown key 'turbidity'"}}));
}

TEST(AllFaults, OfOptionsThatDependOnAFaultyOneAreNotReported) {
    RunText text;
    text.run = "[run]\npaths = 'many'\nmax_paths = 16\n";
    expect_exactly(faults_of(text.text()), {"run.toml:3: [run]: paths: 'many'"});
}

TEST(AllFaults, OfLayersAndBandsThatAreUnknownAreNotReported) {
    RunText text;
    text.run = "[run]\nlayers = -1\ngroups = ['all where layer == 1']\n";
    text.rest = "[[table]]\nfile = 'a.csv'\nwhere = 'layer == 1'\n";
    expect_exactly(faults_of(text.text()), {"run.toml:3: [run]: layers: -1"});
    text = {.top = "bands = 3\n", .run = "[run]\nratios = ['R:FR']\n", .rest = ""};
    expect_exactly(faults_of(text.text()), {"run.toml:1: bands is an integer"});
}

}  // namespace
}  // namespace quasimc::test
