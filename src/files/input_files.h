#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "quasimc/error.h"

namespace quasimc {

/// The absolute path of a file. Pipes and "-" count as files in the current folder.
[[nodiscard]] std::filesystem::path absolute_path(const std::string& given);

/// Reads a file; "-" is standard input. @throws InputError  if it can't be read
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Access to run files and the files that they name: by default on the disk.
struct FileAccess {
    std::function<std::string(const std::filesystem::path&)> read = read_file;
    std::function<bool(const std::filesystem::path&)> exists = [](const std::filesystem::path& p) {
        std::error_code error;
        return std::filesystem::exists(p, error);
    };
    /// The absolute path of a path on the command line.
    std::function<std::filesystem::path(const std::string& given)> absolute = absolute_path;
    /// The reason why an output can't be written; empty: none, or it will not be written.
    /// @param key  that names it: "csv"
    std::function<std::string(std::string_view key, const std::filesystem::path&)> why_unwritable =
        [](std::string_view, const std::filesystem::path&) { return std::string(); };
};

/// Reads the files that a run file names, and records their identities and digests.
class InputFiles {
  public:
    using Reader = std::function<std::string(const std::filesystem::path&)>;

    /// @param folder  base of relative paths
    explicit InputFiles(std::filesystem::path folder, Reader reader = read_file)
        : folder_(std::move(folder)), reader_(std::move(reader)) {}
    InputFiles(std::filesystem::path folder, const FileAccess& access)
        : folder_(std::move(folder)),
          reader_(access.read),
          why_unwritable_(access.why_unwritable) {}

    /// The bytes of the file at `path`. @throws InputError  if it can't be read
    [[nodiscard]] std::string read(const std::string& path);
    /// Records a file that was read by other means.
    void note(
        const std::string& path, const std::filesystem::path& resolved, std::string_view bytes);

    void note(const InputFile& file) { files_.push_back(file); }
    /// Marks the first recorded file as the run file.
    void mark_run_file() { files_.front().is_run_file = true; }
    /// Replaces the reader. @param reader  makes it from the previous one
    void read_through(const std::function<Reader(Reader)>& reader) {
        reader_ = reader(std::move(reader_));
    }

    /// See FileAccess::why_unwritable.
    [[nodiscard]] std::string why_unwritable(
        std::string_view key, const std::filesystem::path& output) const {
        return why_unwritable_(key, output);
    }

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::filesystem::path resolved(const std::string& path) const;
    /// In the order of reading, each once.
    [[nodiscard]] const std::vector<InputFile>& files() const { return files_; }

  private:
    std::filesystem::path folder_;
    Reader reader_;
    decltype(FileAccess::why_unwritable) why_unwritable_ = FileAccess().why_unwritable;
    std::vector<InputFile> files_;
};

}  // namespace quasimc
