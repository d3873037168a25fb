#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "regression/cases.h"

// What a run gives, in one word and in a few numbers. Only runs.cpp knows what a result holds.

namespace quasimc::test {

/// "sources", "organs", "lit_surfaces", "bundles", "automatic": the ways in which cases are traced.
[[nodiscard]] const std::vector<std::string_view>& all_ways();
/// Those of them in which a case can be: by bundles only if all is matt.
[[nodiscard]] std::vector<std::string_view> ways_of(const Case& c);

/// A hash (FNV-1a, 64 bits) of all that a run computes: every estimate with its error and interval,
/// sunlit fractions, ratios, budgets, the audit, the way chosen, paths, rays, why it stopped. One
/// changed bit changes it; times and words do not. All NaNs are one number. Numbers are read by
/// organ, quantity and band, so that it does not depend on how a result is laid out.
[[nodiscard]] std::uint64_t digest_of(const Result& result);

/// One row of the table of runs.
struct Row {
    std::string name;    ///< of the case
    std::string way;     ///< in which it was asked to be traced
    std::string chosen;  ///< in which it was
    std::uint64_t digest = 0;
    double absorbed = 0;  ///< flux: mean over the organs that are known, and over the bands
    double error = 0;     ///< mean of their standard errors
    std::uint64_t paths = 0, rays = 0;
};

/// How a case is run here, beside what it says itself.
struct Variant {
    unsigned threads = 1;
    std::uint64_t seed = 1;
};

/// Runs a case. @param way  one of all_ways()
[[nodiscard]] Result run_case(const Case& c, std::string_view way, const Variant& variant = {});

[[nodiscard]] Row row_of(std::string_view name, std::string_view way, const Result& result);

/// The row as it stands in the table, without a newline; numbers in the fewest digits that give
/// them back.
[[nodiscard]] std::string line_of(const Row& row);
/// The names of the columns, above line_of().
[[nodiscard]] std::string heading();

}  // namespace quasimc::test
