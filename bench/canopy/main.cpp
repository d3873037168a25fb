// The canopy benchmark: CPU time of a result for a given variance.
//
//     ./dev bench                      everything, some minutes
//     ./dev bench efficiency engine    some parts
//     ./dev bench --quick              rough numbers, quickly
//     ./dev bench agreement --paths N  against N paths of plain tracing instead of 1e9
//     ./dev bench bars --cases bundles targets of ray bundles
//     ./dev bench bundles --cases NIR errors and times of ray bundles
//     ./dev bench width --truths DIR   errors and intervals in hard scenes; truths in the folder
//     ./dev bench corners              coverage of intervals in hard cases, an hour
//     ./dev bench choice --files A B   method = "auto" against all methods; with run files
//     ./dev bench costs                processor time of each unit of work

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/parallel.h"
#include "parts.h"
#include "quasimc/version.h"

int main(int argc, char** argv) {
    using namespace quasimc::bench;
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // lines appear at once, in files too
    std::vector<std::string> files;
    std::string words;
    const std::vector<std::pair<std::string, std::function<void(const Effort&)>>> parts{
        {"efficiency", print_efficiency}, {"bars", print_bars},
        {"choice", print_choice},         {"costs", print_costs},
        {"bundles", print_bundles},       {"corners", print_corners},
        {"coverage", print_coverage},     {"agreement", print_agreement},
        {"ratio", print_band_ratio},      {"bands", print_band_cost},
        {"engine", print_engine_speed},   {"day", print_day},
        {"scaling", print_scaling},       {"width", print_width},
    };
    std::vector<std::string> names;
    for (const auto& part : parts) {
        names.push_back(part.first);
    }
    CLI::App app("QuasiMC canopy benchmark");
    std::vector<std::string> asked;
    bool quick = false;
    app.add_option("parts", asked, "which parts (default: all)")->check(CLI::IsMember(names));
    app.add_flag("--quick", quick, "fewer replicates and smaller scenes");
    std::uint64_t plain_paths = 0;
    app.add_option("--paths", plain_paths, "agreement: paths of plain tracing, 1e9 if not given");
    app.add_option("--files", files, "choice: run files with further scenes");
    app.add_option(
        "--cases", words,
        "bars, bundles, choice, costs, width: only cases whose name contains this text");
    std::string truths, method;
    std::uint64_t only_paths = 0;
    std::uint32_t runs = 0;
    app.add_option("--truths", truths, "width: folder where truths are stored");
    app.add_option("--method", method, "width: method of the runs (default: automatic)")
        ->check(CLI::IsMember({"light_tracing", "first_hits", "from_organs", "ray_bundles"}));
    app.add_option("--only-paths", only_paths, "width: paths per replicate (default: 4096, 65536)");
    app.add_option("--runs", runs, "width: number of seeds, 100 if not given");
    CLI11_PARSE(app, argc, argv);

    Effort effort;
    if (quick) {
        effort = {
            .replicates = 8,
            .paths = 16384,
            .most_leaves = 10000,
            .repeats = 3,
            .repetitions = 50,
            .corner_runs = 50,
            .plain_paths = 10'000'000,
            .cases = {},
            .files = {},
            .truths = {},
            .method = {},
            .width_runs = 10,
            .truth_divisor = 64};
    }
    effort.cases = words;
    effort.files = files;
    effort.truths = truths;
    effort.method = method;
    effort.only_paths = only_paths;
    effort.width_runs = runs > 0 ? runs : effort.width_runs;
    effort.plain_paths = plain_paths > 0 ? plain_paths : effort.plain_paths;
    std::printf(
        "QuasiMC %s, %u threads available. CPU times are of one thread unless noted.\n",
        std::string(quasimc::version()).c_str(), quasimc::thread_count(0));
    for (const auto& [name, print] : parts) {
        if (asked.empty() || std::find(asked.begin(), asked.end(), name) != asked.end()) {
            print(effort);
            std::fflush(stdout);
        }
    }
    return 0;
}
