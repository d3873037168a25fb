#include "io/results/window_head.h"

#include <nlohmann/json.hpp>

#include "io/results/json_parts.h"

namespace quasimc {

std::string window_run_head(const RunFile& run) {
    Json head = json_head(run);
    head.update(json_warnings(run));
    return json_text(head);
}

std::string window_light_head(const RunFile& run, const Result& result) {
    const JsonNames names = json_names(run, written_columns(run));
    std::string groups;
    for (std::size_t i = 0; i < result.groups.groups.size(); ++i) {
        groups += (groups.empty() ? "" : ",") + json_group(result.groups, i, names);
    }
    return json_text_with(json_light(run, result), "groups", "[" + groups + "]");
}

std::string window_light_head(
    std::span<const Band> bands, const std::string& length_unit, const Result& result) {
    return json_text(json_light(bands, length_unit, result));
}

}  // namespace quasimc
