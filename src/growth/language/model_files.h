#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quasimc {

/// Numbers read from a file by a format.
struct ScannedValues {
    /// One for each conversion of the format; empty from the first that does not match.
    std::vector<std::optional<double>> values;
    std::vector<std::string> problems;  ///< errors of the format, to be sent as warnings
};

/// The files that a model opens: fopen, fclose, fflush, fprintf and fscanf. Files are named by
/// numbers from 0. All are closed at the end.
class ModelFiles {
  public:
    static constexpr std::size_t kMaxFiles = 64;

    /// @param folder  base of relative names; by default the current folder
    /// @param max_open  number of files that may be open at a time; 0: none
    explicit ModelFiles(std::filesystem::path folder = {}, std::size_t max_open = kMaxFiles)
        : folder_(std::move(folder)), max_open_(std::min(max_open, kMaxFiles)) {}

    /// Opens a file. Devices, pipes and folders are refused, and writing outside the current
    /// folder.
    /// @param mode  as C's fopen: "r", "w", "a", with "+" and "b"
    /// @returns its number, or -1 if it can't be opened or too many are open
    double open(const std::string& name, const std::string& mode);
    /// Closes a file. @returns 0; -1 if it is not open, or its bytes could not be written
    double close(double file);
    /// Writes what is buffered. @returns 0; -1 if it is not open, or could not be written
    double flush(double file);
    /// Writes a text. @returns its bytes; -1 if the file is not open for writing
    double write(double file, std::string_view text);
    /// Reads numbers as C's fscanf with %lf, for all conversions of numbers. %s and %c skip a word
    /// and a character, and have no value.
    [[nodiscard]] ScannedValues scan(double file, std::string_view format);
    [[nodiscard]] bool is_open(double file) const { return find(file) != nullptr; }

  private:
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    enum class Action { none, reading, writing };
    struct OpenFile {
        std::unique_ptr<std::FILE, Closer> stream;
        Action last = Action::none;
    };

    [[nodiscard]] const OpenFile* find(double file) const;
    /// The file, prepared for reading or writing; null if it is not open.
    [[nodiscard]] std::FILE* prepared(double file, Action action);

    std::filesystem::path folder_;
    std::size_t max_open_ = kMaxFiles;
    std::array<OpenFile, kMaxFiles> files_;
};

}  // namespace quasimc
