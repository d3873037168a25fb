#include "run_flags.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace {

/// What the files are, in the order of quasimc::kOutputFiles.
constexpr std::array<const char*, kOutputs> kSummaries{
    "write the table of organs here; - is standard output",
    "of a run with [time]: write the table of sums over days here; - is standard output",
    "write the table of groups of organs here; - is standard output",
    "of a run with [time]: write the table of sums of groups over days here; - is standard output",
    "draw the light that organs absorb here, PNG; `quasimc show` draws more",
    "write the scene with its numbers here, for ParaView and pyvista",
    "the same as PLY, for MeshLab and CloudCompare",
    "the same as binary glTF, coloured, for Blender",
    "write the light by organ, band and time here, for xarray and others",
    "write everything here; - is standard output"};

/// Adds the flags of what is written and told.
void add_output_flags(RunArguments& arguments, std::vector<Flag>& flags) {
    for (Output output = 0; output < kOutputs; ++output) {
        flags.push_back(
            {.name = flag_of(output),
             .target = &arguments.outputs[output],
             .summary = kSummaries[output],
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
    for (Output output = 0; output < kOutputs; ++output) {
        if (!arguments.part.empty() && !arguments.outputs[output].empty()) {
            throw UsageError(fmt::format(
                "{}: a --part has no results; `quasimc merge` writes them", flag_of(output)));
        }
    }
}

std::vector<Flag> flags_of_run(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "FILE",
         .target = &arguments.file,
         .summary = "run file (docs/formats/run-file.md); - is standard input",
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
