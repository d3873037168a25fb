#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace quasimc::test {

/// A limit of time in seconds beyond which no machine is too busy.
inline constexpr double kLongestLimit = 30;

/// How a run of the program ended.
struct Outcome {
    int status = 0;  ///< exit status; 128 and more: ended by a signal
    std::string out, err;
};

/// Runs the program in a folder, with standard input from a text.
[[nodiscard]] Outcome run_program(
    const std::filesystem::path& folder,
    const std::vector<std::string>& arguments,
    const std::string& input = {});

/// Runs lines of bash in a folder; "$quasimc" is the program.
[[nodiscard]] Outcome run_shell(
    const std::filesystem::path& folder, const std::string& command, const std::string& input = {});

/// A run file without a fault: two leaves from leaves.tri, one inline.
[[nodiscard]] std::string good_run_file();
/// Its leaves.tri.
[[nodiscard]] std::string good_leaves();

/// `text` with the first `find` replaced; fails the test if there is none.
[[nodiscard]] std::string replaced(
    std::string text, const std::string& find, const std::string& replacement);

/// Tests in a folder with run.toml and leaves.tri, both good.
class ProgramTest : public FolderTest {
  protected:
    void SetUp() override;
    [[nodiscard]] Outcome run(
        const std::vector<std::string>& arguments, const std::string& input = {}) const {
        return run_program(folder_.path(), arguments, input);
    }
    [[nodiscard]] Outcome shell(const std::string& command, const std::string& input = {}) const {
        return run_shell(folder_.path(), command, input);
    }
    /// Runs the program with a limit of time, which is doubled until the program prints some words:
    /// a busy machine may need long for little.
    [[nodiscard]] Outcome run_within(
        double seconds, std::vector<std::string> arguments, const std::string& words) const;
    /// Names of the files in the folder, hidden ones too, without those that the test made.
    [[nodiscard]] std::vector<std::string> new_files() const;
};

}  // namespace quasimc::test
