#include <fmt/format.h>

#include "quasimc/io/run_file_source_kinds.h"

namespace quasimc {

std::optional<NotedSource> read_uniform_sky(
    TableReader& table, const std::string& name, const RunFileContext& context) {
    const auto values = table.required(
        "irradiance_horizontal",
        read_per_band(table, "irradiance_horizontal", context.bands, TableReader::kNotNegative));
    if (!values) {
        return std::nullopt;
    }
    const std::string note = fmt::format(
        "{}: uniform sky, {}", name, irradiance_words("horizontal", *values, context.bands));
    return NotedSource{make_uniform_sky(name, *values), note};
}

}  // namespace quasimc
