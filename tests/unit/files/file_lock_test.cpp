// A file that one process at a time may write.

#include "files/file_lock.h"

#include <filesystem>
#include <optional>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "quasimc/error.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

std::string refusal_of_lock(const std::string& path) {
    try {
        const FileLock lock(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(FileLock, NamesItsOwnerAndIsGivenUpAtTheEnd) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "c").string();
    std::optional<FileLock> lock(std::in_place, path);
    const std::string refusal = refusal_of_lock(path);
    const std::string expected =
        path + ": is in use by another run (process " + std::to_string(::getpid()) + " on ";
    EXPECT_TRUE(refusal.starts_with(expected)) << refusal;
    EXPECT_EQ(refusal_of_lock(path), refusal) << "who is refused removes nothing";
    lock.reset();
    EXPECT_FALSE(std::filesystem::exists(path + ".lock"));
    EXPECT_EQ(refusal_of_lock(path), "");
}

TEST(FileLock, IsNotHinderedByWhatADeadOwnerLeft) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "c").string();
    folder.write("c.lock", "process 1 on a machine that was switched off long ago, far from here");
    const FileLock lock(path);
    EXPECT_EQ(folder.read("c.lock").find("switched off"), std::string::npos);
}

TEST(FileLock, IsNoStrangersFile) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "c").string();
    folder.write("c.lock", "notes on locks");
    EXPECT_EQ(
        refusal_of_lock(path), path +
                                   ".lock: exists and is not a lock file (it would be overwritten "
                                   "and deleted); delete it, or name another file than " +
                                   path);
    EXPECT_EQ(folder.read("c.lock"), "notes on locks");
}

TEST(FileLock, SaysWhereItCantBeWritten) {
    EXPECT_EQ(
        refusal_of_lock("/no/such/c"),
        "/no/such/c.lock: can't be written (No such file or directory); it keeps other runs from "
        "/no/such/c");
}

}  // namespace
}  // namespace quasimc::test
