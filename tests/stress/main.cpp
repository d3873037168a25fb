// Searches for scenes of which a number is wrong: docs/develop/testing.md.
//     quasimc_stress --seed 1 --scenes 1000 --seconds 600 --out FOLDER [--coverage-every 500]
// Scenes from number 1000000000000 on have light through narrow gaps.
//     quasimc_stress --judge FILE.toml       judges one run file
//     quasimc_stress --judge-gaps FILE.toml  the same with the paths of scenes of narrow gaps
//     quasimc_stress --coverage FILE.toml    prints the coverage of its intervals over 200 seeds
//     quasimc_stress --print NUMBER          prints the run file of a scene

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "files/input_files.h"
#include "stress/campaign.h"
#include "stress/grammar.h"

namespace quasimc::stress {
namespace {

int judge_file(const std::string& path, const Rules& rules) {
    const Verdict verdict = judge(read_toml(read_file(path), path), 1, rules, true);
    for (const Finding& finding : verdict.findings) {
        fmt::print("{}: {}\n", name_of(finding.kind), finding.words);
    }
    fmt::print("{} comparisons, {} findings\n", verdict.comparisons, verdict.findings.size());
    return verdict.findings.empty() ? 0 : 1;
}

int count_coverage(const std::string& path) {
    const Campaign usual;
    const Case it = make_case(read_toml(read_file(path), path));
    const std::vector<std::string> names = number_names(it.run.scene);
    for (const Coverage& c : coverage_of(it, usual.coverage, usual.coverage_seeds, 1)) {
        fmt::print(
            "{}: of {} numbers' intervals {:.4f} +- {:.4f} hold the truth, the fewest {:.3f} of "
            "{}\n",
            name_of(c.way), c.numbers, c.held, c.error, c.worst_held,
            c.numbers > 0 ? names[c.worst] : "none");
    }
    return 0;
}

int usage() {
    fmt::print(
        stderr,
        "usage: quasimc_stress [--seed N] [--scenes K] [--seconds S] [--coverage-every E]\n"
        "                      [--coverage-seeds C] --out FOLDER\n"
        "       quasimc_stress --judge FILE\n"
        "       quasimc_stress --judge-gaps FILE\n"
        "       quasimc_stress --coverage FILE\n"
        "       quasimc_stress --print NUMBER\n");
    return 2;
}

int stress(int argc, char** argv) {
    Campaign campaign;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view flag = argv[i];
        const std::string value = argv[i + 1];
        if (flag == "--judge") {
            return judge_file(value, Rules{});
        }
        if (flag == "--judge-gaps") {
            return judge_file(value, gap_rules());
        }
        if (flag == "--coverage") {
            return count_coverage(value);
        }
        if (flag == "--print") {
            fmt::print("{}", to_toml(random_run(std::stoull(value))));
            return 0;
        }
        if (flag == "--seed") {
            campaign.first = std::stoull(value);
        } else if (flag == "--scenes") {
            campaign.scenes = std::stoull(value);
        } else if (flag == "--seconds") {
            campaign.seconds = std::stod(value);
        } else if (flag == "--coverage-every") {
            campaign.coverage_every = std::stoull(value);
        } else if (flag == "--coverage-seeds") {
            campaign.coverage_seeds = static_cast<unsigned>(std::stoul(value));
        } else if (flag == "--out") {
            campaign.out = value;
        } else {
            return usage();
        }
    }
    if (argc % 2 == 0 || campaign.out.empty()) {
        return usage();
    }
    const Tally tally = run_campaign(campaign);
    fmt::print("{}\n", describe(tally));
    return tally.findings + tally.deaths == 0 ? 0 : 1;
}

}  // namespace
}  // namespace quasimc::stress

int main(int argc, char** argv) {
    try {
        return quasimc::stress::stress(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "quasimc_stress: {}\n", error.what());
        return 2;
    }
}
