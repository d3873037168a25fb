// Writes the table of runs anew, after a change that is meant to change results:
//
//     cmake --build build/release --target quasimc_write_expected_runs
//     build/release/bin/quasimc_write_expected_runs tests/regression/expected.txt
//     git diff tests/regression/expected.txt
//
// The last command shows which runs changed and by how much; the commit says why. Where digests of
// a case are others on this machine, its rows that are nearly the same stay, and others get the
// digest 0: not known.

#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "regression/table.h"

namespace {

constexpr std::string_view kPreamble =
    R"(# What whole runs give: one row for each case of tests/regression/cases.cpp and each way of tracing.
# Written by quasimc_write_expected_runs (tests/regression/write_expected.cpp), never by hand.
#
# digest    of all bits that a run computes; see digest_of in tests/regression/runs.h
# absorbed  flux: mean over the organs that are known, and over the bands
# error     mean of their standard errors
# paths     per replicate, all rounds
#
# The digests hold for x86-64 with AVX2 (lamps: AVX-512), the same for GCC 12 and clang 14; made with
# Embree 3.13 and glibc 2.36. Elsewhere, and where the digest is 0, the other columns are compared:
# docs/develop/testing.md.
)";

using namespace quasimc::test;

/// What becomes of a row whose digest would be another on other machines.
Row without_digest(Row now, const std::vector<Row>& before) {
    const auto same = std::find_if(before.begin(), before.end(), [&](const Row& row) {
        return row.name == now.name && row.way == now.way && are_nearly_the_same(now, row);
    });
    now.digest = 0;
    return same == before.end() ? now : *same;
}

std::string table_of_runs() {
    const std::vector<Row> before = read_table(table_file());
    std::string table = std::string(kPreamble) + "#\n" + heading() + "\n";
    for (const CaseEntry& entry : all_cases()) {
        const Case c = entry.make();
        const std::string why = why_digests_may_differ(c);
        for (const std::string_view way : ways_of(c)) {
            const Row now = row_of(entry.name, way, run_case(c, way));
            table += line_of(why.empty() ? now : without_digest(now, before)) + "\n";
        }
    }
    return table;
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) {
        std::cerr << "usage: quasimc_write_expected_runs FILE\n";
        return 2;
    }
    const std::string table = table_of_runs();
    std::ofstream out(argv[1], std::ios::binary);
    out << table << std::flush;
    if (!out) {
        std::cerr << "can't write " << argv[1] << "\n";
        return 1;
    }
    return 0;
} catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 3;
}
