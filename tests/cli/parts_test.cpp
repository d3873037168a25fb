// Parts of a run, computed apart and put together.

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace quasimc::test {
namespace {

class PartsTest : public ProgramTest {
  protected:
    /// Computes parts 1 to `parts` of a run file into p1, p2, ...; each on other threads.
    void compute_parts(int parts, const std::vector<std::string>& options = {}) const {
        for (int part = 1; part <= parts; ++part) {
            std::vector<std::string> words{
                "run",         options.empty() ? "run.toml" : options[0],
                "--part",      std::to_string(part) + "/" + std::to_string(parts),
                "--part-file", "p" + std::to_string(part)};
            words.insert(words.end(), options.begin() + (options.empty() ? 0 : 1), options.end());
            words.insert(words.end(), {"--threads", std::to_string(1 + part % 2)});
            const Outcome outcome = run(words);
            EXPECT_EQ(outcome.status, 0) << outcome.err;
        }
    }
    /// What a result says of the files that it was made from.
    [[nodiscard]] nlohmann::json inputs_of(const std::string& name) const {
        return nlohmann::json::parse(folder_.read(name)).at("inputs");
    }
    /// A table without the lines on how it was made.
    [[nodiscard]] std::string rows(const std::string& name) const {
        const std::string table = folder_.read(name);
        return table.substr(table.find("id,name"));
    }
};

class PartsOfMethodsTest : public PartsTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(PartsOfMethodsTest, GiveTheNumbersOfTheWholeInAnyOrder) {
    compute_parts(3, {"run.toml", "--method", GetParam()});
    const Outcome merged = run({"merge", "p3", "p1", "p2", "--csv", "merged.csv"});
    EXPECT_EQ(merged.status, 0) << merged.err;
    ASSERT_EQ(run({"run", "run.toml", "--method", GetParam(), "--csv", "whole.csv"}).status, 0);
    EXPECT_EQ(rows("merged.csv"), rows("whole.csv"));
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    PartsOfMethodsTest,
    ::testing::Values("light_tracing", "first_hits", "from_organs", "auto"));

TEST_F(PartsTest, OfTimesGiveTheirNumbersAndSums) {
    folder_.write(
        "day.toml", good_run_file() +
                        "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
                        "[time]\nfrom = \"2024-06-20\"\nto = \"2024-06-21\"\n"
                        "utc_offset_hours = 1\nhours = [3, 6]\nsky = \"uniform\"\n");
    compute_parts(2, {"day.toml"});
    ASSERT_EQ(
        run({"merge", "p1", "p2", "--csv", "m.csv", "--daily-csv", "md.csv", "--json", "m.json"})
            .status,
        0);
    ASSERT_EQ(run({"run", "day.toml", "--csv", "w.csv", "--daily-csv", "wd.csv"}).status, 0);
    EXPECT_EQ(rows("m.csv"), rows("w.csv"));
    EXPECT_EQ(rows("md.csv"), rows("wd.csv"));
    ASSERT_EQ(run({"run", "day.toml", "--json", "w.json"}).status, 0);
    EXPECT_EQ(inputs_of("m.json"), inputs_of("w.json"));
    const Outcome again = run({"run", "--repeat", "m.json"});
    EXPECT_NE(again.out.find("the same numbers as in m.json"), std::string::npos) << again.out;
}

/// The light on sensors is computed when parts are put together.
TEST_F(PartsTest, HaveTheSensorsOfTheWhole) {
    folder_.write(
        "sensors.toml", good_run_file() + "[[sensors]]\nat = [[0.5, 0.5, 2], [0.5, 0.5, 0.5]]\n");
    compute_parts(2, {"sensors.toml"});
    ASSERT_EQ(run({"merge", "p1", "p2", "--sensors-csv", "m.csv"}).status, 0);
    ASSERT_EQ(run({"run", "sensors.toml", "--sensors-csv", "w.csv"}).status, 0);
    EXPECT_EQ(rows("m.csv"), rows("w.csv"));
    EXPECT_NE(rows("w.csv").find("2,sensors 2,0.5,0.5,0.5,sensors"), std::string::npos);
}

/// Rows of organs and of the sum over a sweep, without their comments on inputs.
TEST_F(PartsTest, HaveTheTablesOfTheWhole) {
    const std::string tables =
        "[[table]]\nfile = \"organs.csv\"\n"
        "[[table]]\nfile = \"sum.csv\"\nrows = \"groups\"\nper = \"sweep\"\n"
        "[sweep]\nseed = [1, 2]\nweights = [1, 3]\n";
    folder_.write("tables.toml", good_run_file() + tables);
    const auto rows_of = [&](const std::string& name, const std::string& first) {
        const std::string text = folder_.read(name);
        return text.substr(text.find("\n" + first));
    };
    ASSERT_EQ(run({"run", "tables.toml", "--json", "whole.json"}).status, 0);
    const std::string organs = rows_of("organs.csv", "seed,id,");
    const std::string sum = rows_of("sum.csv", "by,");
    for (const char* again : {"merge", "run"}) {
        folder_.write("organs.csv", "");
        folder_.write("sum.csv", "");
        const bool is_merged = std::string(again) == "merge";
        if (is_merged) {
            compute_parts(2, {"tables.toml"});
        }
        const Outcome outcome =
            is_merged ? run({"merge", "p1", "p2"}) : run({"run", "--repeat", "whole.json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(rows_of("organs.csv", "seed,id,"), organs) << again;
        EXPECT_EQ(rows_of("sum.csv", "by,"), sum) << again;
    }
}

TEST_F(PartsTest, MayBeMoreThanThereIsWork) {
    compute_parts(41, {"run.toml", "--paths", "64", "--replicates", "2"});
    std::vector<std::string> words{"merge", "--csv", "m.csv"};
    for (int part = 1; part <= 41; ++part) {
        words.push_back("p" + std::to_string(part));
    }
    EXPECT_EQ(run(words).status, 0);
    ASSERT_EQ(
        run({"run", "run.toml", "--paths", "64", "--replicates", "2", "--csv", "w.csv"}).status, 0);
    EXPECT_EQ(rows("m.csv"), rows("w.csv"));
}

TEST_F(PartsTest, HaveANameOfTheirOwnUnlessItIsStated) {
    EXPECT_EQ(run({"run", "run.toml", "--part", "2/3"}).status, 0);
    EXPECT_EQ(new_files(), std::vector<std::string>{"run.2of3.part"});
}

TEST_F(PartsTest, ThatMissOverlapOrAreOfAnotherRunAreRefused) {
    compute_parts(3);
    const auto refusal = [&](const std::vector<std::string>& parts) {
        std::vector<std::string> words{"merge", "--csv", "m.csv"};
        words.insert(words.end(), parts.begin(), parts.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 1);
        return outcome.err;
    };
    EXPECT_EQ(refusal({"p1", "p3"}), "error: PART: part 2 of 3 is missing; add its file\n");
    EXPECT_NE(
        refusal({"p1", "p2", "p2", "p3"}).find("p2: part 2 of 3 is given twice"),
        std::string::npos);
    EXPECT_NE(refusal({"p1", "p2", "p3", "p3x"}).find("p3x: can't be read"), std::string::npos);
    EXPECT_NE(
        refusal({"p1", "run.toml"}).find("run.toml: is not a part of a run"), std::string::npos);

    ASSERT_EQ(
        run({"run", "run.toml", "--part", "2/3", "--part-file", "q2", "--seed", "9"}).status, 0);
    EXPECT_NE(
        refusal({"p1", "q2", "p3"}).find("q2: belongs to another run than p1 (seed 1, here 9)"),
        std::string::npos)
        << refusal({"p1", "q2", "p3"});
    ASSERT_EQ(run({"run", "run.toml", "--part", "2/4", "--part-file", "q2"}).status, 0);
    EXPECT_NE(refusal({"p1", "q2", "p3"}).find("q2: is one of 4 parts"), std::string::npos);

    folder_.write("leaves.tri", replaced(good_leaves(), "0", "0.25"));
    ASSERT_EQ(run({"run", "run.toml", "--part", "2/3", "--part-file", "q2"}).status, 0);
    EXPECT_NE(refusal({"p1", "q2", "p3"}).find("inputs.leaves.tri"), std::string::npos)
        << refusal({"p1", "q2", "p3"});
    EXPECT_NE(refusal({"p1", "p2", "p3"}).find("its SHA-256 differs"), std::string::npos)
        << refusal({"p1", "p2", "p3"});
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "p1"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "m.csv"));
}

TEST_F(PartsTest, ThatAreDamagedAreRefused) {
    compute_parts(2);
    const std::string whole = folder_.read("p2");
    const auto refusal = [&](const std::string& bytes) {
        folder_.write("p2", bytes);
        const Outcome outcome = run({"merge", "p1", "p2"});
        EXPECT_EQ(outcome.status, 1);
        return outcome.err;
    };
    for (const std::size_t size : {0UL, 10UL, 30UL, 60UL, whole.size() / 2, whole.size() - 1}) {
        EXPECT_TRUE(refusal(whole.substr(0, size)).starts_with("error: p2: is ")) << size;
    }
    EXPECT_NE(refusal(whole + "x").find("extra bytes at its end"), std::string::npos);
    std::string changed = whole;
    changed[whole.size() - 100] = static_cast<char>(changed[whole.size() - 100] ^ 4);
    EXPECT_NE(refusal(changed).find("p2: is damaged"), std::string::npos);
    // Whatever is in it: a title too.
    for (const char* word : {"\"title\"", "\"run_file\"", "leaf"}) {
        changed = whole;
        char& letter = changed[whole.find(word) + 2];
        letter = static_cast<char>(letter ^ 1);
        EXPECT_NE(refusal(changed).find("p2: is damaged (its checksum"), std::string::npos) << word;
    }
}

TEST_F(PartsTest, TellNoTimesOfTheirMerger) {
    compute_parts(1);
    const Outcome merged = run({"merge", "p1"});
    EXPECT_EQ(merged.out.find("million paths/s"), std::string::npos) << merged.out;
    EXPECT_NE(merged.out.find("computed in parts"), std::string::npos) << merged.out;
}

TEST_F(PartsTest, CantBeOfRunsWhoseEndTheyDoNotKnow) {
    const Outcome outcome =
        run({"run", "run.toml", "--part", "1/2", "--target-error", "0.1", "--audit", "0.5"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--target-error: a part of a run can't apply it"), std::string::npos)
        << outcome.err;
    folder_.write("run.toml", replaced(good_run_file(), "[run]\n", "[run]\naudit = 0.5\n"));
    EXPECT_NE(
        run({"run", "run.toml", "--part", "1/2"})
            .err.find("run.toml: audit: a part of a run can't apply it"),
        std::string::npos);
    folder_.write("run.toml", good_run_file());
    EXPECT_NE(outcome.err.find("audit"), std::string::npos);
    for (const char* wrong : {"0/2", "3/2", "1/", "/2", "1", "1/2x", "-1/2", "1/99999999"}) {
        const Outcome refused = run({"run", "run.toml", "--part", wrong});
        EXPECT_EQ(refused.status, 2) << wrong;
        EXPECT_NE(refused.err.find("is not a part of a run"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(run({"run", "run.toml", "--part", "1/2", "--csv", "a.csv"}).status, 2);
    EXPECT_EQ(run({"run", "run.toml", "--part-file", "a"}).status, 2);
    EXPECT_EQ(new_files(), std::vector<std::string>{});
}

TEST_F(PartsTest, AreNoOutputOfTheirMerger) {
    compute_parts(1);
    const std::string before = folder_.read("p1");
    EXPECT_EQ(run({"merge", "p1", "--csv", "p1"}).status, 2);
    EXPECT_EQ(folder_.read("p1"), before);
}

}  // namespace
}  // namespace quasimc::test
