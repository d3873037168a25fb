// Whole runs against a table of what they gave.
//
// Rationale: a change of the program's structure must not change one bit of a result, and nothing
// but the results tells whether it did.
// Expected behaviour: every case traced in every way has the digest of the table in expected.txt,
// on any number of threads. A failure shows old and new numbers: one that moved by a small part of
// its error is rounding, one that moved by several is a fault. Where digests can't be compared (see
// why_digests_may_differ), the readable numbers are.
//
// Nothing in this program writes the table: quasimc_write_expected_runs does, by hand.

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "regression/table.h"
#include "support/sanitized.h"

namespace quasimc::test {
namespace {

/// The row of a case and a way; none is a failure.
Row expected_of(std::string_view name, std::string_view way) {
    for (const Row& row : read_table(table_file())) {
        if (row.name == name && row.way == way) {
            return row;
        }
    }
    ADD_FAILURE() << "expected.txt has no row of " << name << " " << way;
    return {};
}

const CaseEntry& case_called(std::string_view name) {
    for (const CaseEntry& entry : all_cases()) {
        if (entry.name == name) {
            return entry;
        }
    }
    throw std::runtime_error("no such case");
}

class WholeRun : public ::testing::TestWithParam<std::tuple<CaseEntry, std::string_view>> {};

TEST_P(WholeRun, GivesWhatTheTableSays) {
    const auto& [entry, way] = GetParam();
    const Row expected = expected_of(entry.name, way);
    const Case c = entry.make();
    const Row threads = row_of(entry.name, way, run_case(c, way, {.threads = 3}));
    // One thread finds nothing under a sanitizer that three don't; the table tells of both.
    const Row alone =
        kIsSanitized ? threads : row_of(entry.name, way, run_case(c, way, {.threads = 1}));
    EXPECT_TRUE(have_the_same_digest(threads, alone)) << "three threads and one";
    EXPECT_TRUE(are_nearly_the_same(alone, expected));
    const std::string why = expected.digest == 0 ? "it is unknown" : why_digests_may_differ(c);
    if (!why.empty()) {
        RecordProperty("digest", "not compared: " + why);
        return;
    }
    EXPECT_TRUE(have_the_same_digest(alone, expected));
}

/// Each case with each of its ways.
std::vector<std::tuple<CaseEntry, std::string_view>> all_runs() {
    std::vector<std::tuple<CaseEntry, std::string_view>> runs;
    for (const CaseEntry& entry : all_cases()) {
        for (const std::string_view way : ways_of(entry.make())) {
            runs.emplace_back(entry, way);
        }
    }
    return runs;
}

INSTANTIATE_TEST_SUITE_P(EveryCase, WholeRun, ::testing::ValuesIn(all_runs()), [](const auto& run) {
    return std::string(std::get<0>(run.param).name) + "_from_" +
           std::string(std::get<1>(run.param));
});

TEST(TableOfRuns, HasARowForEachRunAndNoOther) {
    std::multiset<std::pair<std::string, std::string>> expected;
    std::multiset<std::pair<std::string, std::string>> found;
    for (const CaseEntry& entry : all_cases()) {
        for (const std::string_view way : ways_of(entry.make())) {
            expected.emplace(entry.name, way);
        }
    }
    for (const Row& row : read_table(table_file())) {
        found.emplace(row.name, row.way);
    }
    EXPECT_EQ(found, expected);
}

/// What the cases are there for: a planner that chooses each way somewhere, a run of several
/// rounds.
TEST(TableOfRuns, CoversEveryChoiceAndSeveralRounds) {
    std::set<std::string> chosen;
    for (const Row& row : read_table(table_file())) {
        if (row.way == "automatic") {
            chosen.insert(row.chosen);
        }
    }
    EXPECT_EQ(chosen, (std::set<std::string>{"sources", "organs", "lit_surfaces", "bundles"}));
    const Case c = case_called("rounds_to_a_target").make();
    for (const std::string_view way : all_ways()) {
        EXPECT_GT(expected_of("rounds_to_a_target", way).paths, c.spec.paths) << way;
    }
}

/// A case of few organs that has all that a result can hold but an audit.
constexpr std::string_view kSmall = "rounds_to_a_target";

/// A control: the digest sees a run apart from another.
TEST(Digest, OfAnotherSeedIsAnother) {
    const Case c = case_called(kSmall).make();
    for (const std::string_view way : all_ways()) {
        const std::uint64_t digest = digest_of(run_case(c, way));
        EXPECT_EQ(digest, digest_of(run_case(c, way, {.seed = 1}))) << way;
        EXPECT_NE(digest, digest_of(run_case(c, way, {.seed = 2}))) << way;
    }
}

double next(double x) {
    return std::nextafter(x, std::numeric_limits<double>::infinity());
}

/// A control: the digest sees the last bit of each kind of number.
TEST(Digest, ChangesWithTheLastBitOfAnyNumber) {
    const Result result = run_case(case_called(kSmall).make(), "sources");
    ASSERT_FALSE(result.sunlit_fraction.empty());
    ASSERT_FALSE(result.ratio_values.empty());
    const std::vector<std::pair<std::string, std::function<void(Result&)>>> changes{
        {"mean", [](Result& r) { r.values.back().mean = next(r.values.back().mean); }},
        {"error",
         [](Result& r) {
             r.values.front().standard_error = next(r.values.front().standard_error);
         }},
        {"low", [](Result& r) { r.values[1].ci95_low = next(r.values[1].ci95_low); }},
        {"high", [](Result& r) { r.values[1].ci95_high = next(r.values[1].ci95_high); }},
        {"sunlit", [](Result& r) { r.sunlit_fraction[0].mean = next(r.sunlit_fraction[0].mean); }},
        {"ratio", [](Result& r) { r.ratio_values[0].mean = next(r.ratio_values[0].mean); }},
        {"emitted", [](Result& r) { r.budget[1].emitted.mean = next(r.budget[1].emitted.mean); }},
        {"escaped",
         [](Result& r) {
             r.budget[0].escaped.standard_error = next(r.budget[0].escaped.standard_error);
         }},
        {"closure", [](Result& r) { r.budget[0].closure_error = next(r.budget[0].closure_error); }},
        {"target", [](Result& r) { r.fraction_at_target = next(r.fraction_at_target); }},
        {"paths", [](Result& r) { ++r.paths; }},
        {"rays", [](Result& r) { ++r.rays; }},
        {"replicates", [](Result& r) { ++r.replicates; }},
        {"stop", [](Result& r) { r.stop = StopReason::time_limit; }},
        {"way", [](Result& r) { r.chosen.method = Method::from_organs; }},
        {"remainder", [](Result& r) { r.escaped_by_difference = !r.escaped_by_difference; }},
        {"audit", [](Result& r) { r.audit.emplace(); }}};
    std::set<std::uint64_t> digests{digest_of(result)};
    for (const auto& [what, change] : changes) {
        Result changed = result;
        change(changed);
        EXPECT_TRUE(digests.insert(digest_of(changed)).second) << what;
    }
}

TEST(Digest, IsBlindToTimesAndToTheKindOfNan) {
    Result result = run_case(case_called(kSmall).make(), "sources");
    result.values.front().ci95_low = std::numeric_limits<double>::quiet_NaN();
    const std::uint64_t digest = digest_of(result);
    result.preparation_seconds += 1;
    result.solve_seconds += 1;
    result.solve_cpu_seconds += 1;
    result.values.front().ci95_low = -std::nan("1");
    EXPECT_EQ(digest, digest_of(result));
}

/// A control: where digests don't count, the readable numbers still do.
TEST(NearlyTheSame, FailsForWhatRoundingDoesNotDo) {
    const Row row{"a", "sources", "sources", 1, 10, .1, 4096, 100000};
    const auto fails = [&](const std::function<void(Row&)>& change) {
        Row other = row;
        change(other);
        return !are_nearly_the_same(other, row);
    };
    EXPECT_FALSE(fails([](Row& r) { r.digest = 2; }));
    EXPECT_FALSE(fails([](Row& r) { r.absorbed += .004; }));
    EXPECT_TRUE(fails([](Row& r) { r.absorbed += .006; }));
    EXPECT_TRUE(fails([](Row& r) { r.absorbed = std::nan(""); }));
    EXPECT_TRUE(fails([](Row& r) { r.error -= .006; }));
    EXPECT_TRUE(fails([](Row& r) { r.rays += 101; }));
    EXPECT_TRUE(fails([](Row& r) { r.paths *= 2; }));
    EXPECT_TRUE(fails([](Row& r) { r.chosen = "organs"; }));
}

}  // namespace
}  // namespace quasimc::test
