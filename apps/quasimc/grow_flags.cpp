#include "grow_flags.h"

#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

namespace {

/// The flags that cpfg has as well.
std::vector<Flag> shared_flags(GrowArguments& arguments) {
    const std::string kCpfg = "Flags of cpfg";
    return {
        {.name = "--string-binary",
         .target = &arguments.binary_string,
         .summary = "write the string with parameters in binary; -strb",
         .type_name = "FILE",
         .group = kCpfg},
        {.name = "--box",
         .target = &arguments.box,
         .summary = "write the bounding box; -vv",
         .type_name = "FILE",
         .group = kCpfg},
        {.name = "--drawing",
         .target = &arguments.drawing,
         .summary = "write the shapes as lines of text; -ray",
         .type_name = "FILE",
         .group = kCpfg},
        {.name = "-g", .target = &arguments.is_batch, .summary = "no effect", .group = kCpfg},
        {.name = "-m",
         .target = &arguments.color_map,
         .summary = "no effect",
         .type_name = "FILE",
         .group = kCpfg},
        {.name = "-M",
         .target = &arguments.material_map,
         .summary = "no effect",
         .type_name = "FILE",
         .group = kCpfg},
        {.name = "-s",
         .target = &arguments.string_bytes,
         .summary = "no effect: strings have no fixed size",
         .group = kCpfg}};
}

/// The flags of files to write.
std::vector<Flag> output_flags(GrowArguments& arguments) {
    const std::string kOutput = "Output";
    return {
        {.name = "-o,--output",
         .target = &arguments.output,
         .summary =
             "write the final plant in a geometry format, as VTP, as a picture (.png), or as "
             "a table of its organs (.csv), by the end of the name; %03d in a name is the "
             "number of the step, and every step is written",
         .type_name = "FILE",
         .group = kOutput},
        {.name = "--series",
         .target = &arguments.series,
         .summary = "write every step in this folder: step_000.glb, step_000.txt, and steps.csv",
         .type_name = "FOLDER",
         .group = kOutput},
        {.name = "--string",
         .target = &arguments.string,
         .summary = "write the string of modules, - or stdout for standard output; -str",
         .type_name = "FILE",
         .group = kOutput},
        {.name = "--homomorphism",
         .target = &arguments.homomorphism,
         .summary = "write strings with their homomorphism; -homo",
         .group = kOutput},
        {.name = "-q,--quiet",
         .target = &arguments.quiet,
         .summary = "print errors only",
         .group = kOutput},
        {.name = "-v,--verbose",
         .target = &arguments.verbose,
         .summary = "print a line for every step",
         .group = kOutput}};
}

}  // namespace

GrowArguments with_default_files(GrowArguments arguments) {
    const auto beside_model = [&](const char* extension) {
        const std::filesystem::path file =
            std::filesystem::path(arguments.model).replace_extension(extension);
        std::error_code error;
        return std::filesystem::exists(file, error) ? file.string() : "";
    };
    if (arguments.view_file.empty()) {
        arguments.view_file = beside_model(".v");
    }
    if (arguments.light.empty() && arguments.environment.empty()) {
        arguments.light = beside_model(".qmc");
    }
    return arguments;
}

std::vector<Flag> flags_of_grow(GrowArguments& arguments) {
    std::vector<Flag> flags{
        {"MODEL", &arguments.model, "L-system in cpfg's language", true},
        {"VIEW", &arguments.view_file,
         "view file; default the file with the model's name and .v, if there is one"},
        {.name = "--light",
         .target = &arguments.light,
         .summary = "compute the light on the plant by this specification of an environment, or in "
                    "the stand of this run file (.toml); default "
                    "the file with the model's name and .qmc, if there is one",
         .type_name = "FILE",
         .excludes = "-e"},
        {.name = "-e,--environment",
         .target = &arguments.environment,
         .summary = "start the environment program of this environment file",
         .type_name = "FILE"},
        {.name = "--steps",
         .target = &arguments.steps,
         .summary = "derivation steps; default those of the model",
         .range = std::pair(0.0, 0x1p31 - 1)},
        {.name = "--seed",
         .target = &arguments.seed,
         .summary =
             "choose other productions of a stochastic model; default those of cpfg's batch mode",
         .type_name = "N",
         .range = std::pair(0.0, 65535.0)},
        {.name = "--string-limit",
         .target = &arguments.string_limit,
         .summary = "largest size of the string, MiB; a larger one is an error",
         .range = std::pair(1.0, 16384.0),
         .default_text = "1024"},
        {.name = "--view",
         .target = &arguments.view,
         .summary = "show the steps in a browser of this computer; Ctrl-C ends"},
        {.name = "--port",
         .target = &arguments.port,
         .summary = "port of 127.0.0.1 for --view (0: any that is free)",
         .range = std::pair(0.0, 65535.0),
         .default_text = "0"}};
    for (std::vector<Flag> more :
         {output_flags(arguments), view_flags(arguments.picture), shared_flags(arguments)}) {
        std::move(more.begin(), more.end(), std::back_inserter(flags));
    }
    return flags;
}

std::vector<OldFlag> cpfg_flags() {
    return {
        {"-homo", "--homomorphism"},
        {"-str", "--string"},
        {"-strb", "--string-binary"},
        {"-vv", "--box"},
        {"-ray", "--drawing"}};
}

void check_usage(const GrowArguments& arguments) {
    if (arguments.port != 0 && !arguments.view) {
        throw UsageError("--port needs --view");
    }
}
