#include <thread>

#include <fmt/format.h>

#include "captures.h"
#include "session_fixture.h"

namespace quasimc::test {
namespace {

class Transports : public SessionTest, public ::testing::WithParamInterface<Transport> {
  protected:
    void SetUp() override {
        SessionTest::SetUp();
        folder_.write("comm.e", comm_text(GetParam()));
        folder_.write("light.qmc", kBlackLeaves);
    }
    std::unique_ptr<Master> started(Client client = Client::cpfg) {
        auto master = make_master(GetParam(), client, folder_.path());
        master->start({"light.qmc"});
        master->await_sign();
        return master;
    }
    static void expect_full_light(const std::string& reply) {
        EXPECT_EQ(structure_of(reply), "0 E(#)\nControl: 5\n");
        // The window of the light is a little larger than the leaf.
        constexpr double kMargin = 1e-4;
        EXPECT_NEAR(values_of(reply)[0], 1, kMargin);
    }
    void end(Master& master, const std::string& order = kExit) {
        master.send(order);
        EXPECT_EQ(master.read(), "Control: 5\n");
        master.await_last_sign();
        EXPECT_EQ(master.process().wait(), (Ending{false, 0})) << folder_.read("err");
        master.clean_up();
    }
};

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    Transports,
    ::testing::Values(Transport::pipes, Transport::files, Transport::memory, Transport::sockets),
    [](const auto& test) { return name_of(test.param); });

TEST_P(Transports, BringEachStepItsLight) {
    const auto master = started();
    for (int step = 0; step < 3; ++step) {
        master->send(kTwoLeaves);
        expect_full_light(master->read());
    }
    end(*master);
    EXPECT_EQ(folder_.read("err"), "");
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(name == "comm.e" || name == "light.qmc" || name == "err" || name == "out")
            << name;
    }
    if (GetParam() != Transport::pipes) {
        EXPECT_EQ(folder_.read("out"), "");
    }
}

/// A row of `count` leaves, one for each number.
std::string row_of_leaves(int first, int count) {
    std::string text;
    for (int i = first; i < first + count; ++i) {
        text += fmt::format("{} E(1,)P(0.2,0.5)\n {} 1 0\n 0 0 -1\n -1 0 0\n 0 1 0\n", 50 * i, i);
    }
    return text;
}

TEST_P(Transports, TakeAndGiveChunks) {
    folder_.write("light.qmc", kBlackLeaves + "quantities: absorbed_flux_density\n");
    folder_.write(
        "comm.e",
        comm_text(GetParam()) + fmt::format("communication type: {} 3\n", name_of(GetParam())));
    const auto master = started();
    master->send(row_of_leaves(0, 3) + "Control: 1 0\n");
    EXPECT_EQ(master->read(), "Control: 5\n");
    master->send(row_of_leaves(3, 3) + "Control: 0 0\n");
    EXPECT_EQ(master->read(), "Control: 5\n");
    master->send(row_of_leaves(6, 2) + "Control: 4 7\n");
    const std::string reply = master->read_all_chunks();
    EXPECT_EQ(
        structure_of(reply),
        "0 E(#,)\n50 E(#,)\n100 E(#,)\nControl: 1\n150 E(#,)\n200 E(#,)\n250 E(#,)\nControl: 0\n"
        "300 E(#,)\n350 E(#,)\nControl: 4\n");
    end(*master);
}

TEST_P(Transports, CarryAThousandAnswers) {
    const auto master = started();
    constexpr int kLeaves = 1000, kChunk = 300;  // capacity of the shared memory
    for (int i = 0; i < kLeaves; i += kChunk) {
        const int count = std::min(kChunk, kLeaves - i);
        const bool is_last = i + count == kLeaves;
        master->send(
            row_of_leaves(i, count) + fmt::format(
                                          "Control: {} 0\n", is_last  ? 4
                                                             : i == 0 ? 1
                                                                      : 0));
        const std::string reply = master->read_all_chunks();
        if (!is_last) {
            EXPECT_EQ(reply, "Control: 5\n");
        } else {
            EXPECT_EQ(values_of(reply).size(), kLeaves);
        }
    }
    end(*master);
}

TEST_P(Transports, AnswerAStepWithoutQueries) {
    const auto master = started();
    master->send("Control: 5 0\n");
    EXPECT_EQ(master->read(), "Control: 5\n");
    end(*master);
}

TEST_P(Transports, EndAtTheOrderOfLpfg) {
    const auto master = started(Client::lpfg);
    master->send("Control: 9 0\nControl: 5 0\n");
    EXPECT_EQ(master->read(), "Control: 5\n");
    EXPECT_EQ(master->process().wait(), (Ending{false, 0}));
    master->clean_up();
}

TEST_P(Transports, WaitForASimulatorThatIsLate) {
    const auto master = started();
    std::this_thread::sleep_for(std::chrono::milliseconds(250));  // it checks every 100 ms
    master->send(kTwoLeaves);
    expect_full_light(master->read());
    end(*master);
}

TEST_P(Transports, TellWhatIsWrongWithAMessageAndLetTheSimulatorGoOn) {
    const auto master = started();
    master->send("0 E(1)P(0.5,2)\n 0 1\nControl: 5 0\n");
    EXPECT_EQ(master->read(), "Control: 5\n");
    master->send(kTwoLeaves);
    expect_full_light(master->read());
    master->send(kExit);
    EXPECT_EQ(master->read(), "Control: 5\n");
    EXPECT_EQ(master->process().wait(), (Ending{false, 1}));
    EXPECT_NE(folder_.read("err").find("line 2"), std::string::npos) << folder_.read("err");
    master->clean_up();
}

class FileTransport : public SessionTest {};

/// The simulator is woken up, whatever the file contains, and the next step is answered again.
TEST_F(FileTransport, GoesOnAfterAnAnswerThatCantBeWritten) {
    namespace fs = std::filesystem;
    folder_.write("comm.e", comm_text(Transport::files));
    folder_.write("light.qmc", kBlackLeaves);
    const auto master = make_master(Transport::files, Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    fs::path answers;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
        if (entry.path().filename().string().starts_with(".from_field")) {
            answers = entry.path();
        }
    }
    ASSERT_FALSE(answers.empty());
    fs::remove(answers);
    fs::create_directory(answers);
    master->send(kTwoLeaves);
    EXPECT_EQ(master->read(), "");
    fs::remove(answers);
    master->send(kTwoLeaves);
    EXPECT_EQ(structure_of(master->read()), "0 E(#)\nControl: 5\n");
    master->send(kExit);
    EXPECT_EQ(master->read(), "Control: 5\n");
    EXPECT_EQ(master->process().wait(), (Ending{false, 1}));
    EXPECT_NE(folder_.read("err").find("can't be written"), std::string::npos);
    master->clean_up();
}

}  // namespace
}  // namespace quasimc::test
