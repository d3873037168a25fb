#include <cstdlib>

#include "captures.h"
#include "session_fixture.h"

namespace quasimc::test {
namespace {

using MonteCarloProgram = SessionTest;

/// With that name, vectors of lights point to the light instead of along its travel, and the first
/// material has number 1.
TEST_F(MonteCarloProgram, ReadsFilesOfMonteCarlo) {
    folder_.write("comm.e", comm_text(Transport::pipes));
    folder_.write(
        "light.mc",
        "light source: 0 1 0 1\nleaf material (top): 0 0 0 0\nleaf material (bottom): 1 0 0 0\n"
        "method: light_tracing\n");
    folder_.write(
        "in", "0 E(1)P(0.5,2,1,2)\n 0 1 0\n 0 0 -1\n -1 0 0\n 0 1 0\nControl: 5 0\n" + kExit);
    const auto folder_of = std::filesystem::path(QUASIMC_ENVIRONMENT).parent_path();
    for (const auto& [name, expected] : {std::pair{"MonteCarlo", 1.0}, {"QuasiMC", 0.0}}) {
        const std::string command = "cd " + folder_.path().string() + " && " +
                                    (folder_of / name).string() +
                                    " -e comm.e light.mc < in > out 2> err";
        EXPECT_EQ(std::system(command.c_str()), 0) << folder_.read("err");
        const std::string out = folder_.read("out");
        const std::string first = out.substr(1, out.find('\n'));  // after the first sign
        EXPECT_NEAR(values_of(first).at(0), expected, 1e-3) << name;
    }
}

}  // namespace
}  // namespace quasimc::test
