// Reads [output]: the output files, and the selection of results.

#include <array>
#include <map>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "files/file_identity.h"
#include "runfile/output_catalogue.h"
#include "runfile/run_file_sections.h"
#include "runfile/written.h"

namespace quasimc {
namespace {

/// Reports a key whose table the run file lacks.
void check_need(
    TableReader& table, TableReader& top, std::string_view key, const OutputNeed& need) {
    if (!need.table.empty() && top.any(need.table) == nullptr) {
        table.fault_at(
            key, fmt::format("{} without {}", key, need.shown), std::string(need.reason));
    }
}

/// Reads the paths of all outputs, which must be different files.
std::map<std::string, std::string, std::less<>> read_paths(
    TableReader& table, const InputFiles& files, TableReader& top) {
    std::map<std::string, std::string, std::less<>> paths;
    std::vector<std::string_view> read;
    for (const OutputKey& key : output_keys()) {
        const std::optional<std::string> path = read_output_path(table, key.name, files);
        if (!path) {
            continue;
        }
        for (const std::string_view other : read) {
            if (paths.find(other)->second == *path) {
                table.fault(fmt::format("{} and {} name the same file", other, key.name));
            }
        }
        read.push_back(key.name);
        paths.emplace(key.name, *path);
        for (const OutputNeed& need : key.needs) {
            check_need(table, top, key.name, need);
        }
    }
    return paths;
}

/// Refuses `groups`, a key of [run], because groups are computed and not only written.
void refuse_groups(TableReader& table) {
    for (const std::string_view key : {"groups", "layers", "layer_heights"}) {
        if (const Node* node = table.any(key)) {
            table.fault_at(
                *node, fmt::format("{} is an option of the run", key), "",
                "put it below [run]; groups_csv names the table of groups");
        }
    }
}

std::optional<std::array<double, 2>> read_time_of_day(TableReader& table) {
    const Node* node = table.any("time_of_day");
    const auto hours = node ? table.interval_at("time_of_day", *node, {0, 24}) : std::nullopt;
    return hours ? std::optional(std::array{hours->low, hours->high}) : std::nullopt;
}

void read_choice(TableReader& table, const std::vector<Band>& bands, OutputSpec& output) {
    output.quantities = read_selection(table, "quantities");
    output.bands = read_selection(table, "bands");
    output.include_night = table.boolean("include_night").value_or(false);
    output.time_of_day = read_time_of_day(table);
    Faults faults;
    check_written(output, bands, faults);
    for (const Fault& fault : faults.all()) {
        table.fault_at(fault.where, fault.problem, fault.why, fault.suggestion);
    }
}

/// Refuses hours with a cumulative sky.
void check_cumulative_sky(TableReader& table, TableReader& top, const OutputSpec& output) {
    const Node* time = top.any("time");
    const Node* cumulative = time != nullptr ? time->find("cumulative_sky") : nullptr;
    const auto* name = cumulative != nullptr ? cumulative->as<std::string>() : nullptr;
    if (output.time_of_day && name != nullptr && *name != "none") {
        table.fault_at(
            "time_of_day", "hours of a cumulative sky", "a day or period has one result",
            "leave time_of_day out");
    }
}

}  // namespace

std::optional<std::string> read_output_path(
    TableReader& table, std::string_view key, const InputFiles& files) {
    const std::optional<std::string> path = table.text(key);
    if (path && (path->empty() || path->find('\0') != std::string::npos)) {
        table.fault_at(key, fmt::format("{} is empty", key), "give the name of a file");
        return std::nullopt;
    }
    if (!path) {
        return std::nullopt;
    }
    std::string resolved = files.resolved(*path).string();
    const FileIdentity file = identity_of(resolved, STDOUT_FILENO);
    if (const InputFile* input = input_at(file, files.files())) {
        table.fault_at(
            key, fmt::format("{} = '{}' is an input of this run", key, *path),
            input->path == *path ? "" : fmt::format("read as '{}'", input->path),
            "name another file");
    }
    if (const std::string why = files.why_unwritable(key, resolved); !why.empty()) {
        table.fault_at(key, fmt::format("{} = '{}' can't be written", key, *path), why);
    }
    return resolved;
}

std::vector<std::string> read_selection(TableReader& table, std::string_view key) {
    std::optional<std::vector<std::string>> names = table.texts(key);
    if (names && names->empty()) {
        table.fault_at(
            key, fmt::format("{} is empty", key), "nothing would be written",
            "name some, or leave it out for all");
    }
    return std::move(names).value_or(std::vector<std::string>{});
}

std::vector<OutputKey> output_keys() {
    std::vector<OutputKey> keys;
    for_each_output([&](const OutputKey& key, auto) { keys.push_back(key); });
    return keys;
}

OutputSpec read_output(TableReader& top, const InputFiles& files, const std::vector<Band>& bands) {
    OutputSpec output;
    const Node* node = top.any("output");
    if (node == nullptr) {
        return output;
    }
    TableReader table(*node, "[output]", top.reporter());
    output.files = read_paths(table, files, top);
    read_choice(table, bands, output);
    refuse_groups(table);
    if (output.include_night) {
        check_need(
            table, top, "include_night",
            {"time", "[time]", "without [time] there are no time steps"});
    }
    if (output.time_of_day) {
        check_need(
            table, top, "time_of_day",
            {"time", "[time]", "without [time] there are no time steps"});
    }
    check_cumulative_sky(table, top, output);
    table.finish();
    return output;
}

}  // namespace quasimc
