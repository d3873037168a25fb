#include "files/output_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>

#include "files/file_identity.h"
#include "files/standard_streams.h"

namespace quasimc {
namespace {

/// Refuses outputs that are inputs, or that are one file.
void check_apart(
    const std::vector<OutputPath>& outputs, std::span<const InputFile> inputs, Faults& faults) {
    std::vector<FileIdentity> files;
    for (const OutputPath& output : outputs) {
        const FileIdentity file = identity_of(output.path, STDOUT_FILENO);
        if (const InputFile* input = input_at(file, inputs)) {
            faults.add(
                {output.where, fmt::format("'{}' is an input of this run", output.path),
                 input->path == output.path ? "" : fmt::format("read as '{}'", input->path),
                 "name another file"});
        }
        const auto same = std::find(files.begin(), files.end(), file);
        if (same != files.end() && !file.is_discard) {
            const OutputPath& other =
                outputs[static_cast<std::size_t>(std::distance(files.begin(), same))];
            faults.add(
                {output.where, fmt::format("'{}' is the file of another output", output.path),
                 fmt::format("{} names it", other.where), "name another file"});
        }
        files.push_back(file);
    }
}

/// An error of a file, with the key or flag that names it.
InputError named(const InputError& error, const OutputPath& output) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) {
        const std::filesystem::path folder = std::filesystem::path(output.path).parent_path();
        std::error_code unknown;
        const bool has_folder = folder.empty() || std::filesystem::exists(folder, unknown);
        fault.suggestion = fmt::format(
            "{} names it; {}name another file", output.where,
            has_folder ? "" : "make its folder, or ");
    }
    return InputError(std::move(faults));
}

}  // namespace

OutputFiles::OutputFiles(std::vector<OutputPath> outputs, std::span<const InputFile> inputs)
    : outputs_(std::move(outputs)) {
    Faults faults;
    check_apart(outputs_, inputs, faults);
    faults.throw_if_any();
    const FileIdentity standard = identity_of_descriptor(STDOUT_FILENO);
    for (const OutputPath& output : outputs_) {
        // A file that standard output already writes to is not replaced, under any path.
        const FileIdentity file = identity_of(output.path, STDOUT_FILENO);
        const bool is_standard = output.path == "-" || (file == standard && !file.is_discard);
        uses_standard_output_ = uses_standard_output_ || is_standard;
        try {
            files_.push_back(std::make_unique<AtomicFile>(is_standard ? "-" : output.path));
        } catch (const InputError& error) {
            faults.add(named(error, output));
        }
    }
    faults.throw_if_any();
}

template <typename Action>
void OutputFiles::attempt(std::size_t output, Action action) {
    if (!files_[output]) {
        return;
    }
    try {
        action(*files_[output]);
    } catch (const ReaderGone&) {
        files_[output].reset();
        throw_if_none_is_left();
    } catch (const InputError& error) {
        give_up(output, named(error, outputs_[output]));
    }
}

TextSink OutputFiles::sink(std::size_t output) {
    return [this, output](std::string_view text) {
        attempt(output, [text](AtomicFile& file) { file.write(text); });
    };
}

void OutputFiles::give_up(std::size_t output, const InputError& error) {
    if (files_[output]) {
        files_[output].reset();
        faults_.add(error);
    }
    throw_if_none_is_left();
}

bool OutputFiles::are_all_given_up() const {
    const auto is_left = [](const auto& file) { return file != nullptr; };
    return !files_.empty() && std::none_of(files_.begin(), files_.end(), is_left);
}

void OutputFiles::throw_if_none_is_left() const {
    if (are_all_given_up()) {
        throw_if_given_up();
        throw ReaderGone();
    }
}

void OutputFiles::commit() {
    for (std::size_t i = 0; i < files_.size(); ++i) {
        attempt(i, [](AtomicFile& file) { file.prepare(); });
    }
    for (std::size_t i = 0; i < files_.size(); ++i) {
        attempt(i, [](AtomicFile& file) { file.take_name(); });
    }
    for (std::size_t i = 0; i < files_.size(); ++i) {
        attempt(i, [](AtomicFile& file) { file.sync_name(); });
    }
}

std::vector<std::string> OutputFiles::written() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (files_[i] && outputs_[i].path != "-") {
            names.push_back(outputs_[i].path);
        }
    }
    return names;
}

}  // namespace quasimc
