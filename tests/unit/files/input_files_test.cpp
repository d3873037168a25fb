#include "files/input_files.h"

#include <gtest/gtest.h>

#include "files/sha256.h"
#include "quasimc/error.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

class InputFilesTest : public FolderTest {};

TEST_F(InputFilesTest, ReadsPathsFromItsFolderAndNotesEachFileOnce) {
    folder_.write("sub/a.tri", "abc");
    InputFiles files(folder_.path());
    EXPECT_EQ(files.read("sub/a.tri"), "abc");
    EXPECT_EQ(files.read("sub/../sub/a.tri"), "abc");
    ASSERT_EQ(files.files().size(), 1U);
    EXPECT_EQ(files.files()[0].path, "sub/a.tri");
    EXPECT_EQ(files.files()[0].absolute_path, (folder_.path() / "sub/a.tri").string());
    EXPECT_EQ(files.files()[0].sha256, sha256_hex("abc"));
}

TEST_F(InputFilesTest, ReadsAbsolutePathsAndBytesAsTheyAre) {
    const std::string bytes("\0\r\n\xff", 4);
    const std::string path = folder_.write("b", bytes).string();
    InputFiles files("/nowhere");
    EXPECT_EQ(files.read(path), bytes);
}

TEST_F(InputFilesTest, RefusesWhatIsNoFile) {
    InputFiles files(folder_.path());
    for (const char* path : {"", "none", ".", "/dev/zero", "none/none"}) {
        EXPECT_THROW(static_cast<void>(files.read(path)), InputError) << path;
    }
    EXPECT_TRUE(files.files().empty());
}

}  // namespace
}  // namespace quasimc::test
