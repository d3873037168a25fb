#include <memory>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "io/atomic_file.h"
#include "io/meshes/formats.h"
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
            {{arguments.output, "its format can't be told from its name", "", "add --format"}});
    }
    return *entry;
}

Exit export_scene(const ExportArguments& arguments) {
    const quasimc::FormatEntry& format = format_of(arguments);
    const quasimc::RunFile run = quasimc::read_run_file(arguments.file);
    print_warnings(run.warnings);
    quasimc::AtomicFile output(arguments.output);
    const auto write = [&](std::string_view text) { output.write(text); };
    quasimc::write_geometry(format, run.scene, write);
    output.commit();
    return Exit::done;
}

}  // namespace

void add_export_command(CLI::App& program, Action& action) {
    const auto arguments = std::make_shared<ExportArguments>();
    std::vector<std::string> names;
    for (const quasimc::FormatEntry& entry : quasimc::format_table()) {
        names.emplace_back(entry.name);
    }
    CLI::App* command =
        program.add_subcommand("export", "write the triangles of a scene as a geometry file");
    command->add_option("FILE", arguments->file, "run file; - is standard input")->required();
    command->add_option("OUTPUT", arguments->output, "geometry file; - is standard output")
        ->required();
    command->add_option("--format", arguments->format, "if the name of OUTPUT does not tell")
        ->check(CLI::IsMember(names));
    command->callback(
        [arguments, &action] { action = [arguments] { return export_scene(*arguments); }; });
}
