#include "run_flags.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "runfile/output_catalogue.h"

namespace {

/// Adds the flags of outputs.
void add_output_flags(RunArguments& arguments, std::vector<Flag>& flags) {
    for (const quasimc::OutputKey& key : quasimc::output_keys()) {
        flags.push_back(
            {.name = flag_of(key.name),
             .target = &arguments.outputs[std::string(key.name)],
             .summary = std::string(key.summary),
             .type_name = "FILE",
             .group = "Output"});
    }
    add_choice_flags(arguments.choice, flags);
    flags.push_back(
        {.name = "-q,--quiet",
         .target = &arguments.quiet,
         .summary = "print errors only",
         .group = "Output"});
    flags.push_back(
        {.name = "--progress",
         .target = &arguments.progress,
         .summary = "show progress in log files too",
         .group = "Output"});
}

}  // namespace

void check_usage(const RunArguments& arguments) {
    if (arguments.file.empty() && arguments.from.empty()) {
        throw UsageError("FILE or --repeat RESULT is required");
    }
    if (arguments.part.empty() && !arguments.sums.empty()) {
        throw UsageError("--part-file needs --part");
    }
    if (!arguments.part.empty() && arguments.view) {
        throw UsageError("--view: a part has no results to show");
    }
    if (arguments.checkpoint.empty() &&
        (arguments.resume || arguments.checkpoint_interval != RunArguments::kDefaultInterval)) {
        throw UsageError("--checkpoint-interval and --resume need --checkpoint");
    }
    if (arguments.checkpoint == "-") {
        throw UsageError("--checkpoint: name a file, not standard output");
    }
    for (const auto& [output, path] : arguments.outputs) {
        if (!arguments.part.empty() && !path.empty()) {
            throw UsageError(fmt::format(
                "{}: a part has no results; `quasimc merge` writes them", flag_of(output)));
        }
    }
}

std::vector<Flag> flags_of_run(RunArguments& arguments) {
    const std::string kWays = "Long runs, many machines";
    std::vector<Flag> flags{
        {.name = "FILE",
         .target = &arguments.file,
         .summary = "run file, - for standard input",
         .excludes = "--repeat"},
        {.name = "--repeat",
         .target = &arguments.from,
         .summary = "repeat the run stored in a JSON result, instead of FILE",
         .type_name = "RESULT",
         .group = "Options"},
        {.name = "--view",
         .target = &arguments.view,
         .summary = "show the run in a browser of this computer; Ctrl-C ends both"}};
    add_output_flags(arguments, flags);
    arguments.flags.add_to(flags);
    flags.insert(
        flags.end(),
        {{.name = "--checkpoint",
          .target = &arguments.checkpoint,
          .summary = "save progress in this file",
          .type_name = "FILE",
          .excludes = "--part",
          .group = kWays},
         {.name = "--checkpoint-interval",
          .target = &arguments.checkpoint_interval,
          .summary = "seconds between saves",
          .range = std::pair(0.0, 1e6),
          .group = kWays,
          .default_text = "60"},
         {.name = "--resume",
          .target = &arguments.resume,
          .summary = "continue from the checkpoint file; paths, target_error, "
                     "target_fraction, max_paths and max_seconds may change",
          .group = kWays},
         {.name = "--part",
          .target = &arguments.part,
          .summary = "compute part K of N (3/16) only; join the parts with `quasimc merge`",
          .type_name = "K/N",
          .group = kWays},
         {.name = "--part-file",
          .target = &arguments.sums,
          .summary = "file for the part",
          .type_name = "FILE",
          .group = kWays,
          .default_text = "NAME.KofN.part"}});
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
