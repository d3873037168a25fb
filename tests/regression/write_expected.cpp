// Writes the table of runs anew, after a change that is meant to change results:
//
//     cmake --build build/release --target quasimc_write_expected_runs
//     build/release/bin/quasimc_write_expected_runs tests/regression/expected.txt
//     git diff tests/regression/expected.txt
//
// The last command shows which runs changed and by how much; the commit says why.

#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

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
# Embree 3.13 and glibc 2.36. Elsewhere the other columns are compared: docs/develop/testing.md.
)";

std::string table_of_runs() {
    using namespace quasimc::test;
    std::string table = std::string(kPreamble) + "#\n" + heading() + "\n";
    for (const CaseEntry& entry : all_cases()) {
        const Case c = entry.make();
        if (const std::string why = why_digests_may_differ(c); !why.empty()) {
            throw std::runtime_error("not written: " + why);
        }
        for (const std::string_view way : ways_of(c)) {
            table += line_of(row_of(entry.name, way, run_case(c, way))) + "\n";
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
