#include <string_view>

#include <fmt/format.h>

#include "commands.h"
#include "io/meshes/formats.h"
#include "io/results/field_formats.h"
#include "netcdf/netcdf_writer.h"

namespace {

void print_row(
    std::string_view name,
    std::string_view extensions,
    std::string_view ways,
    std::string_view keeps,
    std::string_view summary) {
    fmt::print("{:<11} {:<11} {:<11} {:<43} {}\n", name, extensions, ways, keeps, summary);
}

Exit print_formats() {
    fmt::print("geometry\n");
    print_row("name", "extension", "", "keeps", "");
    for (const quasimc::FormatEntry& format : quasimc::format_table()) {
        print_row(
            format.name, format.extensions, format.write == nullptr ? "read" : "read, write",
            format.keeps.empty() ? "-" : format.keeps, format.summary);
    }
    fmt::print("\nresults (quasimc convert RESULT.json OUT)\n");
    for (const quasimc::FieldFormat& format : quasimc::field_format_table()) {
        print_row(
            format.name, format.extension, "write", "ids, every quantity and its error",
            format.summary);
    }
    print_row(
        "opf", ".opf", "write", "the file, every quantity and its error",
        "into the OPF file that the run was made from, as attributes of its nodes");
    print_row(
        "nc", ".nc", quasimc::has_netcdf() ? "write" : "not built in",
        "names, labels, all times, points, errors",
        "NetCDF after the CF conventions for xarray, R and others");
    return Exit::done;
}

}  // namespace

Command formats_command() {
    return {"formats", "print the formats of geometry and results, and what each keeps", {}, [] {
                return print_formats();
            }};
}
