// The simulator that the tests play is itself tested: with a program that does not do its part.

#include "conversation.h"

namespace quasimc::test {
namespace {

class Masters : public ConversationTest, public ::testing::WithParamInterface<Transport> {};

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    Masters,
    ::testing::Values(Transport::pipes, Transport::files, Transport::memory),
    [](const auto& test) { return name_of(test.param); });

TEST_P(Masters, NoticeAProgramThatGivesNoSign) {
    // There is no comm.e: the program ends at once.
    const auto master = make_master(GetParam(), Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    EXPECT_THROW(master->await_sign(), MasterError);
}

TEST_P(Masters, NoticeAProgramThatDoesNotAnswer) {
    folder_.write("comm.e", comm_text(GetParam()));
    folder_.write("light.qmc", kBlackLeaves);
    const auto master = make_master(GetParam(), Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    master->process().kill();
    EXPECT_THROW(static_cast<void>(master->read()), MasterError);
    master->clean_up();
}

}  // namespace
}  // namespace quasimc::test
