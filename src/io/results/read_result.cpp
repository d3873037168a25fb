#include "io/results/read_result.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/results/json_parts.h"
#include "io/results/json_scanner.h"
#include "io/runfile/options.h"
#include "io/runfile/output_files.h"
#include "io/sha256.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& path, std::string problem, std::string why = {}) {
    throw InputError({{path, std::move(problem), std::move(why), ""}});
}

Node to_node(const Json& json, const std::string& path, int depth) {
    if (depth > kDeepestNesting) {
        refuse(path, "nested too deeply", fmt::format("{} levels at most", kDeepestNesting));
    }
    if (json.is_object()) {
        Node::Table table;
        for (const auto& [key, value] : json.items()) {
            table.push_back({key, 0, to_node(value, path, depth + 1)});
        }
        return {std::move(table)};
    }
    if (json.is_array()) {
        Node::List list;
        for (const Json& item : json) {
            list.push_back(to_node(item, path, depth + 1));
        }
        return {std::move(list)};
    }
    if (json.is_string()) {
        return {json.get<std::string>()};
    }
    if (json.is_boolean()) {
        return {json.get<bool>()};
    }
    if (json.is_number_float()) {
        return {json.get<double>()};
    }
    const bool too_large =
        json.is_number_unsigned() &&
        json.get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()};
    if (json.is_number_integer() && !too_large) {
        return {json.get<std::int64_t>()};
    }
    return {Node::Other{json.is_null() ? "null" : "too large a number"}};
}

bool is_of_organs(std::string_view key) {
    return key == "organs" || key == "groups" || key == "moments" || key == "days" ||
           key == "total" || key == "points";
}

/// A part of a result, which is JSON but for characters and numbers that are none.
/// @param place  where in the file it begins
Json parse_part(std::string_view text, std::size_t place, const std::string& path) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        refuse(
            path, fmt::format("byte {}: not JSON", place + error.byte),
            "a result that `quasimc run --json` wrote is needed");
    } catch (const Json::out_of_range&) {
        refuse(path, "it has a number too large to hold", "no result has");
    }
}

/// The result without its organs, of which there may be millions.
Json parse_head(const std::string& text, const std::string& path) {
    JsonScanner scanner(text, path);
    Json head;
    if (scanner.kind() != JsonScanner::Kind::object) {
        scanner.skip();
    } else {
        scanner.object([&](std::string_view key) {
            if (is_of_organs(key)) {
                scanner.skip();
                return;
            }
            Json& member = head[std::string(key)];
            const std::size_t place = scanner.place();
            member = parse_part(scanner.skip(), place, path);
        });
    }
    scanner.end();
    return head;
}

std::string text_of(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

void check_format(const Json& head, const std::string& path) {
    if (!head.is_object() || text_of(head, "format") != "quasimc-result") {
        refuse(path, "is no result of QuasiMC", "a file that `quasimc run --json` wrote is needed");
    }
    const auto version = head.find("format_version");
    if (version == head.end() || !version->is_number_integer() || *version < 1 ||
        *version > kResultVersion) {
        refuse(
            path, "its format_version is not known",
            fmt::format("this program knows versions up to {}", kResultVersion));
    }
}

/// Whether the run ended before its paths were done, by time or Ctrl-C.
bool is_cut_short(const Json& head) {
    const auto done = head.find("done");
    const std::string stop = done != head.end() ? text_of(*done, "stop") : "";
    return stop == stop_name(StopReason::interrupted) || stop == stop_name(StopReason::time_is_up);
}

std::vector<InputFile> stored_inputs(const Json& head) {
    std::vector<InputFile> inputs;
    const auto list = head.find("inputs");
    if (list == head.end() || !list->is_array()) {
        return inputs;
    }
    for (const Json& item : *list) {
        if (item.is_object()) {
            const auto mark = item.find("is_run_file");
            const bool is_run_file = mark != item.end() && mark->is_boolean() && mark->get<bool>();
            const auto bytes = item.find("bytes");
            const bool has_bytes = bytes != item.end() && bytes->is_number_unsigned();
            inputs.push_back(
                {text_of(item, "path"), text_of(item, "resolved"), text_of(item, "sha256"),
                 has_bytes ? bytes->get<std::uint64_t>() : 0, is_run_file});
        }
    }
    return inputs;
}

/// Where the inputs are: beside the result, or where they were.
fs::path input_folder(
    const Json& head,
    const std::vector<InputFile>& inputs,
    const fs::path& beside,
    const FileAccess& access) {
    const auto is_there = [&](const InputFile& input) {
        return input.is_run_file || access.exists(beside / input.path);
    };
    const bool all_there = std::all_of(inputs.begin(), inputs.end(), is_there);
    return all_there ? beside : fs::path(text_of(head, "folder"));
}

/// Reads inputs, and refuses those that are no longer what they were.
InputFiles::Reader checking_reader(
    const std::vector<InputFile>& inputs,
    const fs::path& folder,
    const InputFiles::Reader& reader) {
    return [inputs, names = InputFiles(folder), reader](const fs::path& file) {
        std::string bytes = reader(file);
        for (const InputFile& input : inputs) {
            if (!input.is_run_file && names.resolved(input.path) == file &&
                input.sha256 != sha256_hex(bytes)) {
                throw InputError(
                    {{file.string(), "has changed",
                      "it has changed since the result was made (another SHA-256)", ""}});
            }
        }
        return bytes;
    };
}

/// Leaves out where the run wrote to; what it wrote of its numbers stays.
void forget_outputs(Node::Table& members) {
    for (Member& member : members) {
        auto* output = std::get_if<Node::Table>(&member.node.value);
        if (member.key == "output" && output != nullptr) {
            std::erase_if(*output, [](const Member& key) {
                return std::any_of(
                    kOutputFiles.begin(), kOutputFiles.end(),
                    [&](const OutputFileKey& each) { return each.key == key.key; });
            });
        }
    }
}

}  // namespace

StoredSweep read_result_text(
    const std::string& text,
    const std::string& name,
    const fs::path& beside,
    const FileAccess& access,
    const std::vector<Override>& overrides) {
    const Json head = parse_head(text, name);
    check_format(head, name);
    const auto run = head.find("run");
    if (run == head.end() || !run->is_object()) {
        refuse(name, "holds no run");
    }
    Node document = to_node(*run, name, 0);
    auto& members = std::get<Node::Table>(document.value);
    forget_outputs(members);

    const std::vector<InputFile> inputs = stored_inputs(head);
    const fs::path folder = input_folder(head, inputs, beside, access);
    InputFiles files(folder, checking_reader(inputs, folder, access.read));
    const auto own = std::find_if(
        inputs.begin(), inputs.end(), [](const InputFile& input) { return input.is_run_file; });
    if (own != inputs.end()) {
        files.note(*own);
    }
    return {
        read_sweep_document(
            std::move(document), name, [files] { return files; }, overrides),
        text_of(head, "organs_sha256"), head.at("format_version") == kResultVersion,
        text_of(head, "program_version"), is_cut_short(head)};
}

StoredSweep read_result_sweep(const std::string& path, const std::vector<Override>& overrides) {
    return read_result_sweep(path, overrides, FileAccess());
}

StoredSweep read_result_sweep(
    const std::string& path, const std::vector<Override>& overrides, const FileAccess& access) {
    const fs::path folder = access.absolute(path).parent_path();
    return read_result_text(access.read(path), path, folder, access, overrides);
}

StoredRun read_result_file(const std::string& path, const std::vector<Override>& overrides) {
    StoredSweep stored = read_result_sweep(path, overrides);
    return {
        std::move(stored.runs).only_run(), std::move(stored.organs_sha256), stored.is_comparable};
}

}  // namespace quasimc
