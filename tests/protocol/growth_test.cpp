#include "growth.h"

#include <cstdlib>

#include "captures.h"
#include "session_fixture.h"

namespace quasimc::test {
namespace {

using Growth = SessionTest;

TEST_F(Growth, OfTheExampleIsPrinted) {
    const std::filesystem::path example = QUASIMC_SOURCE_DIR "/examples/03-coupled";
    for (const char* name : {"plant.py", "comm.e", "light.qmc"}) {
        std::filesystem::copy(example / name, folder_.path());
    }
    const std::string command = "cd " + folder_.path().string() +
                                " && python3 plant.py --steps 3 --program " QUASIMC_ENVIRONMENT
                                " > printed 2> err";
    EXPECT_EQ(std::system(command.c_str()), 0) << folder_.read("err");
    EXPECT_NE(folder_.read("printed").find("step  2:"), std::string::npos);
    EXPECT_TRUE(folder_.read("light0002.ply").starts_with("ply\n"));
}

/// Without a terminal, as in a test, a pipeline or a service, Enter is not awaited.
TEST_F(Growth, OfTheExampleIsViewedWithoutATerminal) {
    const std::filesystem::path example = QUASIMC_SOURCE_DIR "/examples/03-coupled";
    for (const char* name : {"plant.py", "comm.e", "light.qmc"}) {
        std::filesystem::copy(example / name, folder_.path());
    }
    const std::string command =
        "cd " + folder_.path().string() +
        " && python3 plant.py --view --steps 1 --program " QUASIMC_ENVIRONMENT
        " < /dev/null > printed 2> err";
    EXPECT_EQ(std::system(command.c_str()), 0) << folder_.read("err");
    EXPECT_NE(folder_.read("printed").find("There is no terminal"), std::string::npos);
    EXPECT_EQ(folder_.read("err").find("Traceback"), std::string::npos);
}

TEST_F(Growth, IsToldStepByStep) {
    folder_.write("comm.e", comm_text(Transport::pipes));
    folder_.write("light.qmc", "number of rays: 1024\nverbose: 2\n");
    const auto master = make_master(Transport::pipes, Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    master->send(growing_leaves(10, 1));
    static_cast<void>(master->read_all_chunks());
    master->send(kExit);
    EXPECT_EQ(master->read(), "Control: 5\n");
    master->await_last_sign();
    EXPECT_EQ(master->process().wait(), (Ending{false, 0}));
    EXPECT_NE(folder_.read("err").find("s by from_organs ("), std::string::npos)
        << folder_.read("err");
}

TEST_F(Growth, OfFiftyStepsWithTenThousandLeavesIsAnswered) {
    folder_.write("comm.e", comm_text(Transport::pipes));
    folder_.write("light.qmc", "number of rays: 1024\nreturn type: D\nverbose: 0\n");
    const auto master = make_master(Transport::pipes, Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    constexpr int kSteps = 50, kMaxLeaves = 10000;
    for (int step = 1; step <= kSteps; ++step) {
        const int leaves = kMaxLeaves * step / kSteps;
        master->send(growing_leaves(leaves, step));
        const std::string reply = master->read_all_chunks();
        ASSERT_EQ(values_of(reply).size(), leaves) << step;
    }
    master->send(kExit);
    EXPECT_EQ(master->read(), "Control: 5\n");
    master->await_last_sign();
    EXPECT_EQ(master->process().wait(), (Ending{false, 0})) << folder_.read("err");
}

}  // namespace
}  // namespace quasimc::test
