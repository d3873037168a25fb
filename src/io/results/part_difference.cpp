#include "io/results/part_difference.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace quasimc {
namespace {

using Json = nlohmann::ordered_json;

/// What may differ between machines: it changes no result.
constexpr std::array<std::string_view, 3> kFree{
    "run.run.threads", "run.run.tally_memory_mb", "run.output"};

std::string in_short(const Json& value) {
    constexpr std::size_t kLongest = 40;
    const std::string text = value.is_null() ? "nothing" : value.dump();
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

Json value_of(const Json& table, const std::string& key) {
    return table.contains(key) ? table[key] : Json();
}

/// The first difference below a place, in the order of keys.
std::string difference_at(
    const std::string& place,
    const Json& there,
    const Json& here,
    std::span<const std::string_view> free) {
    const auto has = [&](const auto& list) {
        return std::find(list.begin(), list.end(), place) != list.end();
    };
    if (there == here || has(kFree) || has(free)) {
        return "";
    }
    if (!there.is_object() || !here.is_object()) {
        return fmt::format("{}: {} there, {} here", place, in_short(there), in_short(here));
    }
    Json keys = there;
    keys.update(here);
    for (const auto& item : keys.items()) {
        const std::string& key = item.key();
        std::string found = difference_at(
            fmt::format("{}.{}", place, key), value_of(there, key), value_of(here, key), free);
        if (!found.empty()) {
            return found;
        }
    }
    return "";
}

/// The inputs other than the run file itself, whose parts are compared key by key, by what they
/// hold, wherever they are.
Json contents_of_inputs(const Json& head) {
    Json contents = Json::object();
    for (const Json& input : head.value("inputs", Json::array())) {
        if (input.is_object() && !input.value("is_run_file", false)) {
            contents[input.value("path", "")] = input.value("sha256", "");
        }
    }
    return contents;
}

}  // namespace

std::string difference_of_runs(
    const std::string& there, const std::string& here, std::span<const std::string_view> free) {
    const Json a = Json::parse(there, nullptr, false), b = Json::parse(here, nullptr, false);
    if (!a.is_object() || !b.is_object()) {
        return "it is damaged";
    }
    const auto compare = [&](const std::string& place, const Json& x, const Json& y) {
        return difference_at(place, x, y, free);
    };
    std::string found = compare(
        "program_version", a.value("program_version", Json()), b.value("program_version", Json()));
    if (found.empty()) {
        found = compare("run", a.value("run", Json()), b.value("run", Json()));
    }
    if (found.empty()) {
        found = compare("inputs", contents_of_inputs(a), contents_of_inputs(b));
    }
    return found;
}

}  // namespace quasimc
