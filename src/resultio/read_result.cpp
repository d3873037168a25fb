#include "resultio/read_result.h"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "files/sha256.h"
#include "resultio/json_parts.h"
#include "resultio/read_rows.h"
#include "runfile/output_catalogue.h"

namespace quasimc {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, std::string problem, std::string why = {}) {
    throw InputError({{path, std::move(problem), std::move(why), ""}});
}

void check_format(const Node& head, const std::string& path) {
    if (text_in(head, "format") != "quasimc-result") {
        refuse(
            path, "is not a result of QuasiMC",
            "it must be a file written by `quasimc run --json`");
    }
    const Node* version = head.find("format_version");
    const auto* number = version == nullptr ? nullptr : version->as<std::int64_t>();
    if (number == nullptr || *number != kResultVersion) {
        refuse(
            path, "its format_version is unknown",
            fmt::format("this program reads version {}", kResultVersion));
    }
}

/// Whether the run ended before its paths were done, by time or Ctrl-C.
bool is_cut_short(const Node& head) {
    const Node* completed = head.find("completed");
    const std::string stop = completed != nullptr ? text_in(*completed, "stop") : "";
    return stop == stop_name(StopReason::interrupted) || stop == stop_name(StopReason::time_limit);
}

std::vector<InputFile> stored_inputs(const Node& head) {
    std::vector<InputFile> inputs;
    const Node* found = head.find("inputs");
    const auto* list = found == nullptr ? nullptr : found->as<Node::List>();
    for (const Node& item : list == nullptr ? Node::List() : *list) {
        const Node *mark = item.find("is_run_file"), *size = item.find("bytes");
        const auto* is_run_file = mark == nullptr ? nullptr : mark->as<bool>();
        const auto* bytes = size == nullptr ? nullptr : size->as<std::int64_t>();
        inputs.push_back(
            {text_in(item, "path"), text_in(item, "absolute_path"), text_in(item, "sha256"),
             bytes != nullptr && *bytes > 0 ? static_cast<std::uint64_t>(*bytes) : 0,
             is_run_file != nullptr && *is_run_file});
    }
    return inputs;
}

/// Where the inputs are: beside the result, or where they were.
fs::path input_folder(
    const Node& head,
    const std::vector<InputFile>& inputs,
    const fs::path& beside,
    const FileAccess& access) {
    const auto is_there = [&](const InputFile& input) {
        return input.is_run_file || access.exists(beside / input.path);
    };
    const bool all_there = std::all_of(inputs.begin(), inputs.end(), is_there);
    return all_there ? beside : fs::path(text_in(head, "directory"));
}

/// Reads inputs, and refuses those that have changed since.
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
                      "it has changed: its SHA-256 differs from that in the result", ""}});
            }
        }
        return bytes;
    };
}

/// Whether a key of [output] names a file.
bool names_a_file(const Member& key) {
    const std::vector<OutputKey> keys = output_keys();
    return std::any_of(
        keys.begin(), keys.end(), [&](const OutputKey& output) { return output.name == key.key; });
}

/// Removes the paths of [output], which flags name again; tables and the choice of quantities and
/// bands stay.
void forget_outputs(Node::Table& members) {
    for (Member& member : members) {
        auto* output = std::get_if<Node::Table>(&member.node.value);
        if (member.key == "output" && output != nullptr) {
            std::erase_if(*output, names_a_file);
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
    const Node head = read_rows(text, name, {.rest = RowsQuery::Rest::head}, {});
    check_format(head, name);
    const Node* run = head.find("run_file");
    if (run == nullptr || run->as<Node::Table>() == nullptr) {
        refuse(name, "contains no run file");
    }
    Node document = *run;
    forget_outputs(std::get<Node::Table>(document.value));
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
        text_in(head, "organs_sha256"), text_in(head, "program_version"), is_cut_short(head)};
}

StoredSweep read_result_sweep(const std::string& path, const std::vector<Override>& overrides) {
    return read_result_sweep(path, overrides, FileAccess());
}

StoredSweep read_result_sweep(
    const std::string& path, const std::vector<Override>& overrides, const FileAccess& access) {
    const fs::path folder = access.absolute(path).parent_path();
    return read_result_text(access.read(path), path, folder, access, overrides);
}

}  // namespace quasimc
