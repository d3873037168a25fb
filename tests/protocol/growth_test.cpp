#include "growth.h"

#include "captures.h"
#include "conversation.h"

namespace quasimc::test {
namespace {

using Growth = ConversationTest;

TEST_F(Growth, OfFiftyStepsWithTenThousandLeavesIsAnswered) {
    folder_.write("comm.e", comm_text(Transport::pipes));
    folder_.write("light.qmc", "number of rays: 1024\nreturn type: D\nverbose: 0\n");
    const auto master = make_master(Transport::pipes, Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    constexpr int kSteps = 50, kMostLeaves = 10000;
    for (int step = 1; step <= kSteps; ++step) {
        const int leaves = kMostLeaves * step / kSteps;
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
