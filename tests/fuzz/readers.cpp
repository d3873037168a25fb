// The readers that are fuzzed. CMakeLists.txt reads their names from this table.

#include "readers.h"

#include <algorithm>
#include <stdexcept>

#include "fuzzing.h"
#include "meshio/formats.h"

namespace quasimc::fuzz {

std::vector<FuzzedReader> fuzzed_readers() {
    std::vector<FuzzedReader> readers{
        {"ies", fuzz_ies},
        {"model", fuzz_model},
        {"protocol", fuzz_protocol},
        {"result", fuzz_result},
        {"run_file", fuzz_run_file},
        {"sky_table", fuzz_sky_table},
        {"specification", fuzz_specification},
        {"weather", fuzz_weather},
        {"window_request", fuzz_window_request},
    };
    for (const FormatEntry& format : format_table()) {
        const std::string name(format.name);
        readers.push_back(
            {name, [name](const std::string& bytes) { read_geometry_bytes(name, bytes); }});
    }
    return readers;
}

FuzzedReader find_reader(std::string_view name) {
    for (FuzzedReader& reader : fuzzed_readers()) {
        if (reader.name == name) {
            return reader;
        }
    }
    throw std::invalid_argument("there is no reader \"" + std::string(name) + "\"");
}

}  // namespace quasimc::fuzz
