#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace quasimc::test {

/// A new, empty folder that is deleted, with all that is in it, at the end of the object's life.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Writes a file, bytes as they are, making the folders it lies in. Returns its path.
    std::filesystem::path write(std::string_view name, std::string_view content) const;

    /// The bytes of a file of the folder.
    [[nodiscard]] std::string read(std::string_view name) const;

  private:
    std::filesystem::path path_;
};

/// For tests that write: each has a folder of its own.
class FolderTest : public ::testing::Test {
  protected:
    TemporaryFolder folder_;
};

}  // namespace quasimc::test
