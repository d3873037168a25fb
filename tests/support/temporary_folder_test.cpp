#include "support/temporary_folder.h"

#include <optional>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

TEST(TemporaryFolder, IsNewAndEmpty) {
    const TemporaryFolder a;
    const TemporaryFolder b;
    EXPECT_NE(a.path(), b.path());
    EXPECT_TRUE(std::filesystem::is_empty(a.path()));
}

TEST(TemporaryFolder, VanishesWithAllThatIsInIt) {
    std::optional<TemporaryFolder> folder(std::in_place);
    const std::filesystem::path file = folder->write("deep/er/file.txt", "x");
    EXPECT_TRUE(std::filesystem::exists(file));
    const std::filesystem::path path = folder->path();
    folder.reset();
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(TemporaryFolder, KeepsBytesAsTheyAre) {
    const TemporaryFolder folder;
    const std::string bytes("a\r\n\0b\n", 6);
    folder.write("file", bytes);
    EXPECT_EQ(folder.read("file"), bytes);
}

TEST(TemporaryFolder, RefusesToReadWhatIsNotThere) {
    const TemporaryFolder folder;
    EXPECT_THROW(static_cast<void>(folder.read("nothing")), std::runtime_error);
}

TEST_F(FolderTest, HasAFolder) {
    EXPECT_TRUE(std::filesystem::is_directory(folder_.path()));
}

}  // namespace
}  // namespace quasimc::test
