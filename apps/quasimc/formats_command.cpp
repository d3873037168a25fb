#include <cstdio>

#include <fmt/format.h>

#include "commands.h"
#include "io/meshes/formats.h"
#include "io/results/field_formats.h"
#include "netcdf/netcdf_writer.h"

namespace {

Exit print_formats() {
    fmt::print("geometry\n{:<11} {:<11} {:<11} {:<43} {}\n", "name", "extension", "", "keeps", "");
    for (const quasimc::FormatEntry& format : quasimc::format_table()) {
        fmt::print(
            "{:<11} {:<11} {:<11} {:<43} {}\n", format.name, format.extensions,
            format.write == nullptr ? "read" : "read, write",
            format.keeps.empty() ? "-" : format.keeps, format.summary);
    }
    fmt::print("\nresults (quasimc convert RESULT.json OUT)\n");
    for (const quasimc::FieldFormat& format : quasimc::field_format_table()) {
        fmt::print(
            "{:<11} {:<11} {:<11} {:<43} {}\n", format.name, format.extension, "write",
            "ids, every quantity and its error", format.summary);
    }
    fmt::print(
        "{:<11} {:<11} {:<11} {:<43} {}\n", "opf", ".opf", "write",
        "the file, every quantity and its error",
        "into the OPF file that the run was made from, as attributes of its nodes");
    fmt::print(
        "{:<11} {:<11} {:<11} {:<43} {}\n", "nc", ".nc",
        quasimc::has_netcdf() ? "write" : "not built in",
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
