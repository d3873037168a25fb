// What the program does to files: it destroys nothing that it reads, mixes nothing, and leaves old
// files or new ones, whatever happens.

#include "outputs.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

/// Every row of the catalogue has a flag that writes its file.
TEST_F(OutputsTest, AreWrittenByTheirFlags) {
    folder_.write(
        "all.toml", folder_.read("bare.toml") +
                        "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\ntimes = "
                        "[\"2024-06-21T12:00+02:00\"]\n[[detector]]\ntype = \"escaped_by_zenith\"\n"
                        "[[sensors]]\nat = { start = [0, 0, 9], along = [1, 0, 0], across = [0, 1, "
                        "0], counts = [2, 2] }\n[[gap_fraction]]\nat = [[0, 0, 0]]\n");
    std::istringstream rows(run({"list", "outputs"}).out);
    std::size_t written = 0;
    for (std::string row; std::getline(rows, row);) {
        std::string name = row.substr(0, row.find(' '));
        std::replace(name.begin(), name.end(), '_', '-');
        const Outcome outcome = run({"run", "-q", "all.toml", "--" + name, "its-" + name});
        if (outcome.err.find("was built without") == std::string::npos) {
            EXPECT_EQ(outcome.status, 0) << name << ": " << outcome.err;
            EXPECT_FALSE(folder_.read("its-" + name).empty()) << name;
            ++written;
        }
    }
    EXPECT_GE(written, 9U);
}

TEST_F(OutputsTest, DrawNoMapWithoutAnArrayOfSensors) {
    folder_.write("point.toml", folder_.read("bare.toml") + "[[sensors]]\nat = [[0, 0, 9]]\n");
    const Outcome outcome = run({"run", "-q", "point.toml", "--sensors-picture", "map.png"});
    if (outcome.err.find("was built without") == std::string::npos) {
        EXPECT_NE(outcome.status, 0);
        EXPECT_NE(outcome.err.find("no [[sensors]] is an array"), std::string::npos) << outcome.err;
    }
}

/// A repeated result writes them again: no flag names them.
TEST_F(OutputsTest, AreTablesOfTheRunFile) {
    folder_.write(
        "tables.toml", folder_.read("bare.toml") +
                           "[[table]]\nfile = \"long.csv\"\nform = \"long\"\n"
                           "[[table]]\nfile = \"-\"\nrows = \"groups\"\nquantities = "
                           "[\"absorbed_flux\"]\nstatistics = [\"mean\"]\n");
    const Outcome outcome = run({"run", "-q", "tables.toml", "--json", "result.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\nby,value_of,organs,area,absorbed_flux_"), std::string::npos);
    EXPECT_NE(folder_.read("long.csv").find(",quantity,band,unit,value,se,"), std::string::npos);
    const std::string rows = folder_.read("long.csv");
    folder_.write("long.csv", "");
    const Outcome again = run({"run", "-q", "--repeat", "result.json"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.out, outcome.out);
    EXPECT_EQ(folder_.read("long.csv"), rows);
    folder_.write("wrong.toml", folder_.read("bare.toml") + "[[table]]\nfile = \"leaves.tri\"\n");
    const Outcome wrong = run({"run", "-q", "wrong.toml"});
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("is an input of this run"), std::string::npos) << wrong.err;
}

TEST_F(OutputsTest, AreNeverInputs) {
    make_links();
    const std::string leaves = folder_.read("leaves.tri");
    const std::string text = folder_.read("bare.toml");
    const std::vector<Texts> table{
        {"--csv", "bare.toml"},      {"--json", "./bare.toml"},
        {"--csv", "soft.csv"},       {"--json", "hard.csv"},
        {"--csv", "here/bare.toml"}, {"--csv", (folder_.path() / "bare.toml").string()},
        {"--csv", "leaves.tri"},     {"--csv", "out.csv", "--json", "leaves.tri"}};
    for (const Texts& row : table) {
        Texts arguments{"run", "bare.toml"};
        arguments.insert(arguments.end(), row.begin(), row.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << ::testing::PrintToString(row);
        EXPECT_NE(outcome.err.find("is an input of this run"), std::string::npos) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("error: " + row[row.size() - 2] + ": ")) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_EQ(folder_.read("bare.toml"), text);
    EXPECT_EQ(folder_.read("leaves.tri"), leaves);
    EXPECT_FALSE(fs::exists(folder_.path() / "out.csv"));
}

TEST_F(OutputsTest, OfRunFilesAreNeverInputs) {
    for (const std::string name : {"run.toml", "leaves.tri", "./none/../leaves.tri"}) {
        folder_.write(
            "run.toml", replaced(good_run_file(), "csv = \"out.csv\"", "csv = \"" + name + "\""));
        for (const char* command : {"run", "check"}) {
            const Outcome outcome = run({command, "run.toml"});
            EXPECT_EQ(outcome.status, 1);
            EXPECT_NE(outcome.err.find("run.toml:7: [output]: csv = '"), std::string::npos)
                << outcome.err;
            EXPECT_NE(outcome.err.find("is an input of this run"), std::string::npos);
        }
    }
    EXPECT_EQ(folder_.read("leaves.tri"), good_leaves());
}

TEST_F(OutputsTest, OfConvertAreNeverInputs) {
    for (const char* output : {"leaves.tri", "./leaves.tri"}) {
        const Outcome outcome = run({"convert", "run.toml", output});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find("is an input of this run"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run({"convert", "run.toml", "run.toml", "--to", "obj"}).status, 2);
    EXPECT_EQ(folder_.read("leaves.tri"), good_leaves());
    EXPECT_EQ(folder_.read("run.toml"), good_run_file());
}

TEST_F(OutputsTest, AreNotTheResultThatIsRepeated) {
    ASSERT_EQ(run({"run", "bare.toml", "--json", "old.json"}).status, 0);
    const std::string old = folder_.read("old.json");
    for (const char* flag : {"--csv", "--json"}) {
        const Outcome outcome = run({"run", "--repeat", "old.json", flag, "./old.json"});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find("is an input of this run"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder_.read("old.json"), old);
    EXPECT_EQ(run({"run", "--repeat", "old.json", "--json", "new.json"}).status, 0);
}

TEST_F(OutputsTest, AreNotEachOther) {
    fs::create_symlink("new.csv", folder_.path() / "soft.csv");
    fs::create_symlink(".", folder_.path() / "here");
    const std::vector<Texts> table{
        {"new.csv", "./new.csv"},
        {"new.csv", "soft.csv"},
        {"here/new.csv", "new.csv"},
        {"-", "/dev/stdout"}};
    for (const Texts& row : table) {
        const Outcome outcome = run({"run", "bare.toml", "--csv", row[0], "--json", row[1]});
        EXPECT_EQ(outcome.status, 2) << ::testing::PrintToString(row);
        EXPECT_NE(outcome.err.find("--json: '"), std::string::npos) << outcome.err;
        EXPECT_NE(
            outcome.err.find("is the file of another output (--csv names it)"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_FALSE(fs::exists(folder_.path() / "new.csv"));
    EXPECT_EQ(
        run({"run", "bare.toml", "--csv", "/dev/null", "--json", "/dev/../dev/null"}).status, 0);
}

TEST_F(OutputsTest, FollowLinksToWhatIsNotThereYet) {
    fs::create_symlink("new.csv", folder_.path() / "soft.csv");
    EXPECT_EQ(run({"run", "bare.toml", "--csv", "soft.csv"}).status, 0);
    EXPECT_TRUE(fs::is_symlink(folder_.path() / "soft.csv"));
    EXPECT_NE(folder_.read("new.csv").find("third"), std::string::npos);
}

TEST_F(OutputsTest, ByTheNameOfStandardOutputLeaveItToThem) {
    const Outcome outcome = run({"run", "bare.toml", "--csv", "/dev/stdout"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(outcome.out.starts_with("# QuasiMC"));
    EXPECT_EQ(outcome.out.find("energy    "), std::string::npos);
    EXPECT_NE(outcome.err.find("energy    "), std::string::npos);
}

TEST_F(OutputsTest, AreNotMixedWithClosedStreams) {
    for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        write_old();
        const Outcome outcome = shell("\"$quasimc\" run run.toml " + std::string(closed));
        EXPECT_EQ(outcome.status, 0) << closed << outcome.err;
        EXPECT_TRUE(folder_.read("out.csv").starts_with("# QuasiMC")) << closed;
        EXPECT_EQ(folder_.read("out.csv").find("energy    "), std::string::npos) << closed;
        EXPECT_TRUE(folder_.read("out.json").starts_with("{")) << closed;
        EXPECT_TRUE(has_new_json()) << closed;
        EXPECT_EQ(folder_.read("leaves.tri"), good_leaves());
    }
    const Outcome refused = shell("\"$quasimc\" run bare.toml --csv - >&-");
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(
        refused.err,
        "error: standard output: can't be written (it is closed); --csv names it; name another "
        "file\n");
    EXPECT_EQ(shell("\"$quasimc\" run - <&-").status, 1);
}

TEST_F(OutputsTest, ThatFailDoNotCostTheOthers) {
    write_old();
    const Outcome full = run({"run", "run.toml", "--csv", "/dev/full"});
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.err.find("/dev/full: can't be written (No space left"), std::string::npos)
        << full.err;
    EXPECT_TRUE(has_new_json());
    EXPECT_EQ(full.out.find("/dev/full"), std::string::npos) << full.out;
    ASSERT_EQ(::mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
    const Outcome gone = shell("true <pipe & \"$quasimc\" run run.toml --json pipe");
    EXPECT_EQ(gone.status, 1);
    EXPECT_NE(gone.err.find("pipe: can't be written (Broken pipe)"), std::string::npos) << gone.err;
    EXPECT_TRUE(has_new_csv());
}

// As of programs that SIGPIPE ends: the status is that which a shell reports for them.
TEST_F(OutputsTest, AReaderOfStandardOutputThatEndsIsNoFault) {
    folder_.write(
        "day.toml", good_run_file() +
                        "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n[time]\nday = "
                        "\"2024-06-20\"\nutc_offset_hours = 1\nsky = \"uniform\"\n");
    for (const char* command :
         {"run day.toml --paths 64 --csv - -q", "list options", "list formats", "--help",
          "run --help", "--dump-default", "check run.toml", "info run.toml",
          "convert run.toml - --to obj", "run run.toml --csv - -q",
          "sky --site 50,8 --time 2024-06-21T09:00Z"}) {
        const Outcome gone = shell(
            "{ sleep 0.2; \"$quasimc\" " + std::string(command) +
            "; echo $? >status; } | true; cat status");
        EXPECT_EQ(gone.out, "141\n") << command << ": " << gone.err;
        EXPECT_EQ(gone.err, "") << command;
    }
    write_old();
    const Outcome other = shell(
        "{ sleep 0.2; \"$quasimc\" run run.toml --json - -q; echo $? >status; } | true; cat "
        "status");
    EXPECT_EQ(other.out, "141\n") << other.err;
    EXPECT_EQ(other.err, "");
    EXPECT_TRUE(has_new_csv());
}

// A limit on the size of files simulates a full disk: the table fits, the result does not.
TEST_F(OutputsTest, OnAFullDiskStayAsTheyWere) {
    write_old();
    const Outcome outcome = shell("ulimit -f 5; \"$quasimc\" run run.toml -q");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("out.json: can't be written (File too large)"), std::string::npos)
        << outcome.err;
    EXPECT_TRUE(has_new_csv());
    EXPECT_EQ(folder_.read("out.json"), "old");
    write_old();
    const Outcome none = shell("ulimit -f 0; \"$quasimc\" run run.toml -q 2>/dev/full");
    EXPECT_EQ(none.status, 1);
    EXPECT_EQ(folder_.read("out.csv"), "old");
    EXPECT_EQ(folder_.read("out.json"), "old");
    EXPECT_EQ(hidden_files(), Texts{});
}

// A bad output is reported before anything is computed, and the good one is left alone.
TEST_F(OutputsTest, ThatCanNotBeOpenedAreReportedAtOnce) {
    write_old();
    const Outcome outcome = run({"run", "run.toml", "--csv", "none/a.csv", "--json", "out.json"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(
        outcome.err.find("none/a.csv: can't be written (No such file or directory); --csv names "
                         "it; make its folder, or name another file"),
        std::string::npos)
        << outcome.err;
    EXPECT_EQ(folder_.read("out.json"), "old");
}

TEST_F(OutputsTest, ThatCanNotBeWrittenAreReportedWithAllFaultsOfTheFile) {
    folder_.write(
        "bad.toml", replaced(
                        replaced(good_run_file(), "\"out.csv\"", "\"none/a.csv\""), "paths = 256",
                        "paths = 0") +
                        "[[table]]\nfile = \"none/b.csv\"\n");
    const Outcome outcome = run({"run", "bad.toml"});
    EXPECT_EQ(outcome.status, 1);
    for (const char* part :
         {"csv = 'none/a.csv' can't be written (No such file", "file = 'none/b.csv' can't be",
          "paths: 0 is out of range"}) {
        EXPECT_NE(outcome.err.find(part), std::string::npos) << part << outcome.err;
    }
    // A flag replaces the path of the file.
    const Outcome other = run({"run", "bad.toml", "--csv", "c.csv"});
    EXPECT_EQ(other.err.find("none/a.csv"), std::string::npos) << other.err;
}

/// The library of NetCDF is loaded when a file is asked for. A file that is none lies before it
/// here.
TEST_F(OutputsTest, AsNetcdfNeedItsLibraryBeforeAnythingIsComputed) {
    if (run({"list", "formats"}).out.find("not built in") != std::string::npos) {
        GTEST_SKIP() << "built without NetCDF";
    }
    const Outcome good = run({"run", "run.toml", "-q", "--netcdf", "out.nc"});
    ASSERT_EQ(good.status, 0) << good.err;
    EXPECT_TRUE(folder_.read("out.nc").starts_with("\x89HDF"));
    write_old();
    folder_.write("out.nc", "old");
    constexpr int kVersions = 40;
    fs::create_directory(folder_.path() / "broken");
    for (int version = 1; version < kVersions; ++version) {
        folder_.write("broken/libnetcdf.so." + std::to_string(version), "");
    }
    fs::create_directory(folder_.path() / "temporary");
    const std::string broken =
        "TMPDIR=temporary LD_LIBRARY_PATH=broken \"$quasimc\" run run.toml -q";
    const Outcome refused = shell(broken + " --netcdf out.nc");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("NetCDF: can't be written ("), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("install the netCDF library"), std::string::npos) << refused.err;
    EXPECT_EQ(folder_.read("out.csv") + folder_.read("out.nc"), "oldold");
    EXPECT_TRUE(fs::is_empty(folder_.path() / "temporary"));
    EXPECT_EQ(shell(broken).status, 0) << "who does not ask for it does not need it";
    EXPECT_TRUE(has_new_csv());
}

TEST_F(OutputsTest, PipesAreReadAndWritten) {
    const Outcome substituted = shell("\"$quasimc\" run <(cat run.toml)");
    EXPECT_EQ(substituted.status, 0) << substituted.err;
    EXPECT_TRUE(has_new_csv());
    EXPECT_EQ(run({"run", "/dev/stdin"}, good_run_file()).status, 0);
    EXPECT_EQ(shell("cat run.toml | \"$quasimc\" run /dev/stdin").status, 0);
    EXPECT_EQ(shell("cat run.toml | \"$quasimc\" run -").status, 0);
    const Outcome late =
        shell("mkfifo late; (sleep 0.3; cat run.toml >late) & \"$quasimc\" run late; wait");
    EXPECT_EQ(late.status, 0) << late.err;
    const Outcome slow = shell("\"$quasimc\" run <(sleep 0.3; cat run.toml)");
    EXPECT_EQ(slow.status, 0) << slow.err;
    const Outcome written = shell("\"$quasimc\" run bare.toml --csv >(cat >piped.csv); wait $!");
    EXPECT_EQ(written.status, 0) << written.err;
    EXPECT_NE(folder_.read("piped.csv").find("third"), std::string::npos);
}

TEST_F(OutputsTest, APipeThatNobodyServesIsRefused) {
    const Outcome outcome = shell(
        "mkfifo a.tri b.csv; sed s/leaves.tri/a.tri/ run.toml >a.toml\n"
        "timeout 60 \"$quasimc\" check a.toml & "
        "timeout 60 \"$quasimc\" run bare.toml --csv b.csv; b=$?; wait $!; echo $? $b");
    EXPECT_EQ(outcome.out, "1 1\n") << outcome.err;
    EXPECT_NE(outcome.err.find("no program writes into this pipe"), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("no program reads this pipe"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace quasimc::test
