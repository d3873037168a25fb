#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "convert_netcdf.h"
#include "files/output_files.h"
#include "meshio/geometry_scene.h"
#include "option_flags.h"
#include "quasimc/quasimc.h"
#include "resultio/field_formats.h"
#include "resultio/write_opf.h"
#include "shown_fields.h"

namespace {

struct ConvertArguments {
    std::string input, output, from, to;
    ValueChoice choice;
};

std::vector<std::string> geometry_names() {
    std::vector<std::string> names;
    for (const quasimc::FormatEntry& entry : quasimc::format_table()) {
        names.emplace_back(entry.name);
    }
    return names;
}

[[noreturn]] void refuse_output(
    const std::string& path, const std::string& what, const std::vector<std::string>& names) {
    throw quasimc::InputError(
        {{path, fmt::format("is not a format that {} can be written in", what),
          "the format follows from the end of its name",
          fmt::format("use {}", fmt::join(names, ", "))}});
}

void write_scene(
    const ConvertArguments& arguments,
    std::span<const quasimc::InputFile> inputs,
    const std::function<void(const quasimc::TextSink&)>& write) {
    quasimc::OutputFiles output({{arguments.output, "OUTPUT"}}, inputs);
    write(output.sink(0));
    output.commit();
    output.throw_if_given_up();
}

/// Writes the triangles of a geometry or run file.
template <typename Read>
void write_triangles(const ConvertArguments& arguments, const Read& read) {
    const quasimc::FormatEntry* to = arguments.to.empty()
                                         ? quasimc::format_of_path(arguments.output)
                                         : quasimc::find_format(arguments.to);
    if (to == nullptr) {
        refuse_output(arguments.output, "geometry", quasimc::writable_formats());
    }
    print_warnings(read.warnings);
    print_warnings(quasimc::lost_when_written(*to, read.scene));
    write_scene(arguments, read.inputs, [&](const quasimc::TextSink& sink) {
        quasimc::write_geometry(*to, read.scene, sink);
    });
}

/// The only OPF file of a run.
const quasimc::InputFile& opf_of(const quasimc::RunFile& run, const std::string& output) {
    const quasimc::InputFile* found = nullptr;
    std::size_t count = 0;
    for (const quasimc::InputFile& input : run.inputs) {
        const quasimc::FormatEntry* format = quasimc::format_of_path(input.path);
        if (format != nullptr && format->name == "opf") {
            found = &input;
            ++count;
        }
    }
    if (count != 1) {
        throw quasimc::InputError(
            {{output, "the result can't be written as OPF",
              fmt::format("it goes back into the OPF file of the run, which has {}", count),
              "convert it to VTP, PLY or GLB"}});
    }
    return *found;
}

/// Writes the OPF file of a run anew, with the numbers of its organs.
void write_result_opf(const ConvertArguments& arguments, const ShownRun& shown) {
    const quasimc::InputFile& file = opf_of(shown.run, arguments.output);
    const std::string bytes = quasimc::read_file(file.absolute_path);
    const quasimc::FieldScene fields = field_scene(
        shown.run.scene, read_all_shown_values(shown, arguments.input, arguments.choice), nullptr);
    quasimc::OpfMatches matches;
    write_scene(arguments, shown.inputs, [&](const quasimc::TextSink& sink) {
        matches = quasimc::write_opf(bytes, fields, sink);
    });
    if (matches.missing > 0) {
        print_warnings(
            {{arguments.output,
              fmt::format(
                  "{} organs of the result are not nodes of {}", matches.missing, file.path)}});
    }
}

bool is_netcdf(const std::string& path) {
    return std::filesystem::path(path).extension() == ".nc";
}

void convert_result(const ConvertArguments& arguments, const ShownRun& shown) {
    const quasimc::FieldFormat* to = quasimc::field_format_of_path(arguments.output);
    const quasimc::FormatEntry* geometry = quasimc::format_of_path(arguments.output);
    const bool is_opf = geometry != nullptr && geometry->name == "opf";
    if (to == nullptr && !is_opf) {
        std::vector<std::string> names;
        for (const quasimc::FieldFormat& format : quasimc::field_format_table()) {
            names.emplace_back(format.extension);
        }
        names.emplace_back(".opf");
        names.emplace_back(".nc");
        refuse_output(arguments.output, "a result", names);
    }
    if (is_opf) {
        write_result_opf(arguments, shown);
        return;
    }
    const std::vector<ShownValues> all =
        read_all_shown_values(shown, arguments.input, arguments.choice);
    const quasimc::FieldScene fields =
        field_scene(shown.run.scene, all, &chosen_values(shown.run.scene, all, arguments.choice));
    write_scene(
        arguments, shown.inputs, [&](const quasimc::TextSink& sink) { to->write(fields, sink); });
}

Exit convert(const ConvertArguments& arguments) {
    if (const quasimc::FormatEntry* from = geometry_of(arguments.input, arguments.from)) {
        write_triangles(arguments, quasimc::read_geometry_scene(arguments.input, *from));
        return Exit::done;
    }
    if (is_netcdf(arguments.output)) {
        convert_to_netcdf(arguments.input, arguments.output, arguments.choice);
        return Exit::done;
    }
    const ShownRun shown = read_shown_run(arguments.input, arguments.choice.point);
    if (shown.result_text.empty()) {
        write_triangles(arguments, shown.run);
    } else {
        convert_result(arguments, shown);
    }
    return Exit::done;
}

}  // namespace

Command convert_command() {
    const auto arguments = std::make_shared<ConvertArguments>();
    ValueChoice& choice = arguments->choice;
    return {
        "convert",
        "write a geometry file in another format, the scene of a run file as geometry, or a "
        "result for other programs",
        {{"INPUT", &arguments->input, "geometry file, run file or JSON result", true},
         {"OUTPUT", &arguments->output, "file to write, - for standard output", true},
         {.name = "--from",
          .target = &arguments->from,
          .summary = "format of INPUT, if its name does not say it",
          .choices = geometry_names()},
         {.name = "--to",
          .target = &arguments->to,
          .summary = "geometry format of OUTPUT, if its name does not say it",
          .choices = quasimc::writable_formats()},
         {"--time", &choice.time,
          "of a result with [time]: the time step that begins so, 2024-06-21T12; default the sum"},
         {.name = "--day",
          .target = &choice.day,
          .summary = "of a result with [time]: the sum of this day, 2024-06-21, instead of --time",
          .excludes = "--time"},
         point_flag(choice.point),
         {"--quantity", &choice.quantity, "of a result as GLB: quantity that colours show"},
         {"--band", &choice.band, "of a result as GLB: its band; default the first"}},
        [arguments] { return convert(*arguments); }};
}
