#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "io/meshes/geometry_scene.h"
#include "io/output_files.h"
#include "option_flags.h"
#include "quasimc/quasimc.h"

namespace {

struct ExportArguments {
    std::string file, output, format;
};

const quasimc::FormatEntry& format_of(const ExportArguments& arguments) {
    const quasimc::FormatEntry* entry = arguments.format.empty()
                                            ? quasimc::format_of_path(arguments.output)
                                            : quasimc::find_format(arguments.format);
    if (entry == nullptr) {
        throw quasimc::InputError(
            {{arguments.output, "its format can't be told from its name", "",
              fmt::format(
                  "add --format, or use {}", fmt::join(quasimc::writable_formats(), ", "))}});
    }
    return *entry;
}

Exit export_scene(const ExportArguments& arguments) {
    const quasimc::FormatEntry& format = format_of(arguments);
    const quasimc::RunFile run = quasimc::read_run_file(arguments.file);
    print_warnings(run.warnings);
    print_warnings(quasimc::lost_when_written(format, run.scene));
    quasimc::OutputFiles output({{arguments.output, "OUTPUT"}}, run.inputs);
    quasimc::write_geometry(format, run.scene, output.sink(0));
    output.commit();
    output.throw_if_given_up();
    return Exit::done;
}

}  // namespace

Command export_command() {
    const auto arguments = std::make_shared<ExportArguments>();
    return {
        "export",
        "write the triangles of a scene as a geometry file",
        {{"FILE", &arguments->file, "run file; - is standard input", true},
         {"OUTPUT", &arguments->output, "geometry file; - is standard output", true},
         {.name = "--format",
          .target = &arguments->format,
          .summary = "if the name of OUTPUT does not tell",
          .choices = quasimc::writable_formats()}},
        [arguments] { return export_scene(*arguments); }};
}
