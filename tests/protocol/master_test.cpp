// Tests of the simulator that the tests play, with a program that violates the protocol.

#include "session_fixture.h"

namespace quasimc::test {
namespace {

class Masters : public SessionTest, public ::testing::WithParamInterface<Transport> {};

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    Masters,
    ::testing::Values(Transport::pipes, Transport::files, Transport::memory),
    [](const auto& test) { return name_of(test.param); });

TEST_P(Masters, NoticeAProgramThatGivesNoSign) {
    const auto master = make_master(GetParam(), Client::cpfg, folder_.path());
    master->start({"--version"});
    EXPECT_THROW(master->await_sign(), MasterError);
}

TEST_P(Masters, NoticeAProgramThatDoesNotAnswer) {
    const auto master = make_master(GetParam(), Client::cpfg, folder_.path());
    master->start({"--version"});
    const auto read_twice = [&] {  // the semaphore of answers begins with 1
        static_cast<void>(master->read());
        static_cast<void>(master->read());
    };
    EXPECT_THROW(read_twice(), MasterError);
    master->clean_up();
}

}  // namespace
}  // namespace quasimc::test
