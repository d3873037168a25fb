#include "files/output_files.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;

using OutputFilesTest = FolderTest;

TEST_F(OutputFilesTest, GetTheirNamesTogether) {
    folder_.write("out.csv", "old");
    folder_.write("out.json", "old");
    const auto both = [&] { return folder_.read("out.csv") + " " + folder_.read("out.json"); };
    const fs::path csv = folder_.path() / "out.csv", json = folder_.path() / "out.json";
    OutputFiles outputs({{csv.string(), "--csv"}, {json.string(), "--json"}}, {});
    outputs.sink(0)("new");
    outputs.sink(1)("new");
    EXPECT_EQ(both(), "old old");
    outputs.commit();
    EXPECT_EQ(both(), "new new");
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
        EXPECT_TRUE(entry.path() == csv || entry.path() == json) << entry.path();
    }
}

}  // namespace
}  // namespace quasimc::test
