#include "parallel/part_difference.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "text/json.h"

namespace quasimc {
namespace {

/// Keys that may differ between machines: they change no result.
constexpr std::array<std::string_view, 3> kFree{
    "run_file.run.threads", "run_file.run.tally_memory_mb", "run_file.output"};

std::string in_short(const Json& value) {
    constexpr std::size_t kLongest = 40;
    const std::string text = value.is_null() ? "nothing" : json_text(value);
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

/// The content that determines results: the program, the run file without free keys, and the
/// content of the other inputs, independent of their paths.
Json deciding(const Json& head, std::span<const std::string_view> free) {
    Json run = {{"run_file", head.value("run_file", Json())}};
    for (const auto& keys : {std::span<const std::string_view>(kFree), free}) {
        for (const std::string_view key : keys) {
            std::string path = fmt::format("/{}", key);
            std::replace(path.begin(), path.end(), '.', '/');
            const Json::json_pointer at(path);
            if (run.contains(at)) {
                run.at(at.parent_pointer()).erase(at.back());
            }
        }
    }
    Json inputs = Json::object();
    for (const Json& input : head.value("inputs", Json::array())) {
        if (input.is_object() && !input.value("is_run_file", false)) {
            inputs[input.value("path", "")] = input.value("sha256", "");
        }
    }
    return {
        {"program_version", head.value("program_version", Json())},
        {"run_file", run["run_file"]},
        {"inputs", inputs}};
}

}  // namespace

std::string difference_of_runs(
    const std::string& there, const std::string& here, std::span<const std::string_view> free) {
    const Json a = Json::parse(there, nullptr, false), b = Json::parse(here, nullptr, false);
    if (!a.is_object() || !b.is_object()) {
        return "it is damaged";
    }
    const Json before = deciding(a, free);
    const Json changes = Json::diff(before, deciding(b, free));
    if (changes.empty()) {
        return "";
    }
    const Json& first = changes.front();
    std::string where = first.at("path");
    const Json::json_pointer at(where);
    std::replace(where.begin(), where.end(), '/', '.');
    for (const auto& [escape, character] : {std::pair("~1", "/"), std::pair("~0", "~")}) {
        for (std::size_t i = 0; (i = where.find(escape, i)) != std::string::npos; ++i) {
            where.replace(i, 2, character);
        }
    }
    constexpr std::string_view kOptions = ".run_file.run.";
    return fmt::format(
        "{} {}, here {}", where.substr(where.starts_with(kOptions) ? kOptions.size() : 1),
        in_short(before.contains(at) ? before.at(at) : Json()),
        in_short(first.value("value", Json())));
}

}  // namespace quasimc
