#include "run_flags.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "runfile/output_catalogue.h"

namespace {

/// Adds the flags of what is written and told.
void add_output_flags(RunArguments& arguments, std::vector<Flag>& flags) {
    for (const quasimc::OutputKey& key : quasimc::output_keys()) {
        flags.push_back(
            {.name = flag_of(key.name),
             .target = &arguments.outputs[std::string(key.name)],
             .summary = std::string(key.summary),
             .type_name = "FILE"});
    }
    flags.push_back(
        {"-q,--quiet", &arguments.quiet, "print errors only: no summary, warnings or progress"});
    flags.push_back(
        {"--progress", &arguments.progress, "tell the progress even if stderr is no terminal"});
    add_choice_flags(arguments.choice, flags);
}

}  // namespace

void check_usage(const RunArguments& arguments) {
    if (arguments.file.empty() && arguments.from.empty()) {
        throw UsageError("FILE or --from RESULT is required");
    }
    if (arguments.part.empty() && !arguments.sums.empty()) {
        throw UsageError("--sums: is the file of a --part");
    }
    if (!arguments.part.empty() && arguments.view) {
        throw UsageError("--view: a --part has no results to be seen");
    }
    if (arguments.checkpoint.empty() &&
        (arguments.resume || arguments.every != RunArguments::kUsualEvery)) {
        throw UsageError("--every and --resume: are of a --checkpoint");
    }
    if (arguments.checkpoint == "-") {
        throw UsageError("--checkpoint: is a file, not standard output");
    }
    if (std::isnan(arguments.every)) {
        throw UsageError("--every: nan is no time");
    }
    for (const auto& [output, path] : arguments.outputs) {
        if (!arguments.part.empty() && !path.empty()) {
            throw UsageError(fmt::format(
                "{}: a --part has no results; `quasimc merge` writes them", flag_of(output)));
        }
    }
}

std::vector<Flag> flags_of_run(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "FILE",
         .target = &arguments.file,
         .summary = "run file (docs/reference/run-file.md); - is standard input",
         .excludes = "--from"},
        {.name = "--from",
         .target = &arguments.from,
         .summary = "repeat the run of this JSON result instead",
         .type_name = "RESULT"},
        {.name = "--part",
         .target = &arguments.part,
         .summary = "compute this part of the run alone, 3/16 the third of sixteen, for "
                    "`quasimc merge`",
         .type_name = "K/N"},
        {.name = "--sums",
         .target = &arguments.sums,
         .summary = "write the part here; by default NAME.KofN.part in the current folder",
         .type_name = "FILE"},
        {.name = "--checkpoint",
         .target = &arguments.checkpoint,
         .summary = "keep here what was computed, so that --resume can go on from it",
         .type_name = "FILE",
         .excludes = "--part"},
        {.name = "--every",
         .target = &arguments.every,
         .summary = "seconds from one checkpoint to the next",
         .type_name = "SECONDS",
         .range = std::pair(0.0, 1e6),
         .default_text = "60"},
        {"--view", &arguments.view,
         "serve a page to the browsers of this machine that follows the run; its address is "
         "printed, and Ctrl-C ends it"},
        {"--resume", &arguments.resume,
         "go on from the checkpoint, if it is there; paths, target_error, target_fraction, "
         "max_paths and "
         "max_seconds may be others than before"}};
    add_output_flags(arguments, flags);
    arguments.flags.add_to(flags);
    return flags;
}

std::vector<Flag> flags_of_merge(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "PART",
         .target = &arguments.parts,
         .summary = "files of `quasimc run --part`: all parts of one run, in any order",
         .required = true}};
    add_output_flags(arguments, flags);
    return flags;
}
