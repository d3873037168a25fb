#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "regression/runs.h"

// The table of runs in expected.txt, and what it means to give what it says.

namespace quasimc::test {

/// Where the table lies.
[[nodiscard]] std::filesystem::path table_file();

/// The rows of a table; lines that begin with # are left out.
/// @throws std::runtime_error  if there is no such file, or a line that is no row
[[nodiscard]] std::vector<Row> read_table(const std::filesystem::path& file);

/// Why the digests of a case in this build on this machine can't be expected to be those of the
/// table; empty if they can.
[[nodiscard]] std::string why_digests_may_differ(const Case& c);

/// Whether two rows are of the same digest. On failure both are shown with what changed, by how
/// much.
[[nodiscard]] ::testing::AssertionResult have_the_same_digest(const Row& now, const Row& expected);

/// Whether two rows are as like as those of one run with other roundings: the same way and paths,
/// rays to 0.1 %, flux and error to a twentieth of the error. (The same paths are followed but for
/// a few that a last digit turns aside. Seen between vector units: 2e-8 of the error.)
[[nodiscard]] ::testing::AssertionResult are_nearly_the_same(const Row& now, const Row& expected);

}  // namespace quasimc::test
