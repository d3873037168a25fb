// Files that get their names together, also when the program is killed on the way.

#include "io/output_files.h"

#include <csignal>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "io/commit_record.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;

class OutputFilesTest : public FolderTest {
  protected:
    [[nodiscard]] std::vector<OutputPath> paths() const {
        return {
            {(folder_.path() / "out.csv").string(), "--csv"},
            {(folder_.path() / "out.json").string(), "--json"}};
    }
    void write_old() {
        folder_.write("out.csv", "old");
        folder_.write("out.json", "old");
    }
    [[nodiscard]] std::string both() const {
        return folder_.read("out.csv") + " " + folder_.read("out.json");
    }
    [[nodiscard]] std::size_t hidden_files() const {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            count += entry.path().filename().string().starts_with(".") ? 1 : 0;
        }
        return count;
    }
    /// As a program that dies between the names of the two.
    void die_between_names() {
        const pid_t child = ::fork();
        if (child == 0) {
            AtomicFile csv(paths()[0].path), json(paths()[1].path);
            csv.write("new");
            json.write("new");
            csv.prepare();
            json.prepare();
            const std::vector<PendingName> names{*csv.pending_name(), *json.pending_name()};
            const CommitRecord record(names);
            csv.put_in_place();
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status));
    }
};

TEST_F(OutputFilesTest, GetTheirNamesTogether) {
    write_old();
    OutputFiles outputs(paths(), {});
    outputs.sink(0)("new");
    outputs.sink(1)("new");
    EXPECT_EQ(both(), "old old");
    outputs.commit();
    EXPECT_EQ(both(), "new new");
    EXPECT_EQ(hidden_files(), 0U);
}

TEST_F(OutputFilesTest, OfAKilledProgramAreFinishedByTheNext) {
    write_old();
    die_between_names();
    EXPECT_EQ(both(), "new old") << "what the record is for";
    {
        // It need not name both, nor come to an end.
        const OutputFiles outputs({paths()[1]}, {});
        EXPECT_EQ(both(), "new new");
    }
    EXPECT_EQ(hidden_files(), 0U);
}

TEST_F(OutputFilesTest, OfAKilledProgramAreFinishedWhereNoneWereBefore) {
    die_between_names();
    EXPECT_FALSE(fs::exists(folder_.path() / "out.json"));
    const OutputFiles outputs(paths(), {});
    EXPECT_EQ(both(), "new new");
}

TEST_F(OutputFilesTest, ThatSomebodyElseWroteSinceAreLeftAlone) {
    write_old();
    die_between_names();
    folder_.write("out.json", "of somebody else");
    const OutputFiles outputs(paths(), {});
    EXPECT_EQ(both(), "new of somebody else");
}

TEST_F(OutputFilesTest, OfOthersAreNotTouched) {
    write_old();
    die_between_names();
    {
        const OutputFiles outputs({{(folder_.path() / "other.csv").string(), "--csv"}}, {});
        EXPECT_EQ(both(), "new old");
    }
    // Nor are those of a program that is at it.
    AtomicFile csv(paths()[0].path), json(paths()[1].path);
    csv.write("newer");
    json.write("newer");
    csv.prepare();
    json.prepare();
    finish_commits({paths()[1].path});  // of the dead one
    const std::vector<PendingName> names{*csv.pending_name(), *json.pending_name()};
    const CommitRecord record(names);
    csv.put_in_place();
    finish_commits({paths()[1].path});
    EXPECT_EQ(both(), "newer new");
    json.put_in_place();
    EXPECT_EQ(both(), "newer newer");
}

TEST_F(OutputFilesTest, AreNotDisturbedByRecordsThatAreNone) {
    write_old();
    folder_.write(".quasimc.commit.abcdef", "nonsense");
    folder_.write(".quasimc.commit.broken", std::string("QuasiMC commit 1\0a\0b\0", 21));
    fs::create_directory(folder_.path() / ".quasimc.commit.folder");
    const OutputFiles outputs(paths(), {});
    EXPECT_EQ(both(), "old old");
}

}  // namespace
}  // namespace quasimc::test
