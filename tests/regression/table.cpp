#include "regression/table.h"

#include <cmath>
#include <fstream>
#include <ios>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace quasimc::test {
namespace {

/// Of the error: how far flux and error may lie from what is expected.
constexpr double kNearly = .05;
constexpr double kNearlyRays = 1e-3;

Row row_from(const std::string& line) {
    std::istringstream words(line);
    Row row;
    words >> row.name >> row.way >> row.chosen >> std::hex >> row.digest >> std::dec >>
        row.absorbed >> row.error >> row.paths >> row.rays;
    std::string more;
    if (!words || words >> more) {
        throw std::runtime_error("not a row of the table of runs: " + line);
    }
    return row;
}

/// Both rows, and what changed.
std::string difference(const Row& now, const Row& expected) {
    const double moved = now.absorbed - expected.absorbed;
    return fmt::format(
        "             {}\n  expected:  {}\n  now:       {}\n"
        "  absorbed {:+.3g} ({:+.2g} errors), error {:+.3g} %, paths {:+}, rays {:+}\n"
        "If results were meant to change, write the table anew (see expected.txt).",
        heading(), line_of(expected), line_of(now), moved, moved / expected.error,
        100 * (now.error / expected.error - 1),
        static_cast<std::int64_t>(now.paths - expected.paths),
        static_cast<std::int64_t>(now.rays - expected.rays));
}

}  // namespace

std::filesystem::path table_file() {
    return std::filesystem::path(QUASIMC_SOURCE_DIR) / "tests/regression/expected.txt";
}

std::string why_digests_may_differ(const Case& c) {
#if defined(__x86_64__) && defined(__GNUC__)
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
        return "without AVX2 Embree rounds otherwise";
    }
    if (c.digests_need_avx512 &&
        !(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
          __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
          __builtin_cpu_supports("avx512vl"))) {
        return "without AVX-512 Embree rounds otherwise";
    }
    return "";
#else
    return "the table is of a build for x86-64";
#endif
}

std::vector<Row> read_table(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) {
        throw std::runtime_error("can't read " + file.string());
    }
    std::vector<Row> rows;
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line.front() != '#') {
            rows.push_back(row_from(line));
        }
    }
    return rows;
}

::testing::AssertionResult have_the_same_digest(const Row& now, const Row& expected) {
    if (now.digest == expected.digest) {
        return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "another digest\n" << difference(now, expected);
}

::testing::AssertionResult are_nearly_the_same(const Row& now, const Row& expected) {
    const double tolerance = kNearly * expected.error;
    const double rays = static_cast<double>(now.rays) - static_cast<double>(expected.rays);
    if (now.chosen == expected.chosen && now.paths == expected.paths &&
        std::abs(rays) <= kNearlyRays * static_cast<double>(expected.rays) &&
        std::abs(now.absorbed - expected.absorbed) <= tolerance &&
        std::abs(now.error - expected.error) <= tolerance) {
        return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "another result\n" << difference(now, expected);
}

}  // namespace quasimc::test
