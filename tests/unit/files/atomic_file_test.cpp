#include "files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "quasimc/error.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public FolderTest {
  protected:
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
    }
};

TEST_F(AtomicFileTest, IsThereWhenItIsDone) {
    AtomicFile file(folder_.path() / "a.csv");
    file.write("one");
    file.write(" two");
    EXPECT_FALSE(fs::exists(folder_.path() / "a.csv"));
    file.commit();
    EXPECT_EQ(folder_.read("a.csv"), "one two");
    EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, LeavesTheOldFileUntilThen) {
    folder_.write("a.csv", "old");
    {
        AtomicFile file(folder_.path() / "a.csv");
        file.write("half of the n");
    }
    EXPECT_EQ(folder_.read("a.csv"), "old");
    EXPECT_EQ(files(), 1U);
    AtomicFile file(folder_.path() / "a.csv");
    file.write("new");
    EXPECT_EQ(folder_.read("a.csv"), "old");
    file.commit();
    EXPECT_EQ(folder_.read("a.csv"), "new");
    EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, FollowsLinks) {
    folder_.write("real.csv", "old");
    fs::create_symlink("real.csv", folder_.path() / "link.csv");
    AtomicFile file(folder_.path() / "link.csv");
    file.write("new");
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder_.path() / "link.csv"));
    EXPECT_EQ(folder_.read("real.csv"), "new");
}

TEST_F(AtomicFileTest, DoesNotReplaceADevice) {
    AtomicFile file("/dev/null");
    file.write("nothing");
    file.commit();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, CanBeReadByThoseWhomTheUmaskLets) {
    const mode_t mask = ::umask(022);
    AtomicFile file(folder_.path() / "a.csv");
    ::umask(mask);
    file.commit();
    EXPECT_EQ(fs::status(folder_.path() / "a.csv").permissions(), static_cast<fs::perms>(0644));
}

TEST_F(AtomicFileTest, SaysAtOnceWhereItCanNotBe) {
    EXPECT_THROW(AtomicFile(folder_.path() / "none" / "a.csv"), InputError);
    EXPECT_THROW(AtomicFile{folder_.path()}, InputError);
    EXPECT_EQ(files(), 0U);
}

TEST_F(AtomicFileTest, SaysWhenTheDiskIsFull) {
    if (!fs::exists("/dev/full")) {
        GTEST_SKIP() << "no /dev/full here";
    }
    AtomicFile file("/dev/full");
    const auto fill = [&] {
        file.write("more than nothing");
        file.commit();
    };
    EXPECT_THROW(fill(), InputError);
}

}  // namespace
}  // namespace quasimc::test
