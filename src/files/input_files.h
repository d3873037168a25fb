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

/// Where a stated file is: one that comes through a pipe, or "-", is as if in the current folder.
[[nodiscard]] std::filesystem::path absolute_path(const std::string& given);

/// The whole of a file; "-" is standard input. @throws InputError  if it can't be read
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// How run files, and the files that they name, are reached: by default on the disk.
struct FileAccess {
    std::function<std::string(const std::filesystem::path&)> read = read_file;
    std::function<bool(const std::filesystem::path&)> exists = [](const std::filesystem::path& p) {
        std::error_code error;
        return std::filesystem::exists(p, error);
    };
    /// Of a path that was stated on the command line. What comes through a pipe is in the current
    /// folder.
    std::function<std::filesystem::path(const std::string& given)> absolute = absolute_path;
};

/// Reads the files that a run file names, and keeps what is needed to know them again.
class InputFiles {
  public:
    using Reader = std::function<std::string(const std::filesystem::path&)>;

    /// @param folder  where stated paths are relative to
    explicit InputFiles(std::filesystem::path folder, Reader reader = read_file)
        : folder_(std::move(folder)), reader_(std::move(reader)) {}

    /// The bytes of the file at `path` (stated). @throws InputError  if it can't be read
    [[nodiscard]] std::string read(const std::string& path);
    /// Notes a file that was read by other means.
    void note(
        const std::string& path, const std::filesystem::path& resolved, std::string_view bytes);

    void note(const InputFile& file) { files_.push_back(file); }
    /// What was noted first is the run file.
    void mark_run_file() { files_.front().is_run_file = true; }
    /// Reads by other means from now on. @param reader  given how it was read before
    void read_through(const std::function<Reader(Reader)>& reader) {
        reader_ = reader(std::move(reader_));
    }

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::filesystem::path resolved(const std::string& path) const;
    /// In the order of reading, each once.
    [[nodiscard]] const std::vector<InputFile>& files() const { return files_; }

  private:
    std::filesystem::path folder_;
    Reader reader_;
    std::vector<InputFile> files_;
};

}  // namespace quasimc
