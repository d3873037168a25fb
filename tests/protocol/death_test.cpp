// Either side is killed at every point of a session: the other side's process ends, and no resource
// of the program is left.

#include <algorithm>
#include <array>
#include <csignal>
#include <functional>

#include <unistd.h>

#include <sys/ipc.h>
#include <sys/prctl.h>
#include <sys/sem.h>

#include "session_fixture.h"

namespace quasimc::test {
namespace {

const std::string kThreeChunks = "communication type: ";

std::string chunk(int first, int count, const std::string& control) {
    std::string text;
    for (int i = first; i < first + count; ++i) {
        const std::string n = std::to_string(i);
        text += n + " E(1)P(0.2,0.5)\n " + n + " 1 0\n 0 0 -1\n -1 0 0\n 0 1 0\n";
    }
    return text + "Control: " + control + " 0\n";
}

/// A point of a session, and the actions of a simulator that lead there from the point before.
struct Point {
    const char* name;
    void (*go)(Master& master);
};

constexpr std::array<Point, 9> kPoints{{
    {"Started", [](Master&) {}},
    {"Greeted", [](Master& m) { m.await_sign(); }},
    {"HalfAMessage", [](Master& m) { m.write(kTwoLeaves.substr(0, kTwoLeaves.size() / 2)); }},
    {"Asked",
     [](Master& m) {
         // Pipes take the rest of the message, files and memory the whole of it.
         const bool has_semaphores = m.semaphore_key().has_value();
         m.send(has_semaphores ? kTwoLeaves : kTwoLeaves.substr(kTwoLeaves.size() / 2));
     }},
    {"Answered", [](Master& m) { static_cast<void>(m.read()); }},
    {"FirstChunkAsked", [](Master& m) { m.send(chunk(0, 2, "1")); }},
    {"FirstChunkAcknowledged", [](Master& m) { static_cast<void>(m.read()); }},
    {"LastChunkAsked", [](Master& m) { m.send(chunk(2, 2, "4")); }},
    {"FirstChunkAnswered", [](Master& m) { static_cast<void>(m.read()); }},
}};

/// Leftovers of a session that was cut off.
class Deaths : public SessionTest,
               public ::testing::WithParamInterface<std::tuple<Transport, std::size_t>> {
  protected:
    void SetUp() override {
        SessionTest::SetUp();
        folder_.write(
            "comm.e", comm_text(transport()) + kThreeChunks + name_of(transport()) + " 2\n");
        folder_.write("light.qmc", kBlackLeaves);
    }
    static Transport transport() { return std::get<0>(GetParam()); }
    static void go_to(Master& master, std::size_t point) {
        for (std::size_t i = 0; i <= point; ++i) {
            kPoints[i].go(master);
        }
    }
    /// Files in the folder that neither the test nor the program's shell created.
    [[nodiscard]] std::vector<std::string> left_over() const {
        constexpr std::array<std::string_view, 4> kOwn{"comm.e", "light.qmc", "err", "out"};
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            if (std::find(kOwn.begin(), kOwn.end(), name) == kOwn.end()) {
                names.push_back(name);
            }
        }
        return names;
    }
};

/// Data about the session of a child process, for its parent.
struct Traces {
    pid_t program = -1;
    long key = -1;
};

/// Plays the simulator in a child process, which kills itself at a point. Returns its traces; this
/// process adopts its program.
Traces play_and_die(
    const std::function<std::unique_ptr<Master>()>& make,
    std::size_t point,
    const std::function<void(Master&, std::size_t)>& go_to) {
    std::array<int, 2> line{};
    EXPECT_EQ(::pipe(line.data()), 0);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            const auto master = make();
            master->start({"light.qmc"});
            const Traces traces{master->process().pid(), master->semaphore_key().value_or(-1)};
            if (::write(line[1], &traces, sizeof traces) == sizeof traces) {
                go_to(*master, point);
                ::raise(SIGKILL);
            }
        } catch (const std::exception& error) {
            std::fprintf(stderr, "simulator: %s\n", error.what());
        }
        ::_exit(1);
    }
    ::close(line[1]);
    Traces traces;
    EXPECT_EQ(::read(line[0], &traces, sizeof traces), static_cast<ssize_t>(sizeof traces));
    ::close(line[0]);
    EXPECT_EQ(wait_for(child), (Ending{true, SIGKILL}));
    return traces;
}

TEST_P(Deaths, OfTheSimulatorEndTheProgramAndLeaveNothing) {
    const Traces traces = play_and_die(
        [&] { return make_master(transport(), Client::cpfg, folder_.path()); },
        std::get<1>(GetParam()), go_to);
    EXPECT_EQ(wait_for(traces.program), (Ending{false, 1}));
    const std::string reported = folder_.read("err");
    const bool names_the_loss = reported.find("has ended") != std::string::npos ||
                                reported.find("can't be reached") != std::string::npos;
    EXPECT_TRUE(names_the_loss) << reported;
    EXPECT_EQ(left_over(), std::vector<std::string>());
    if (traces.key >= 0) {
        EXPECT_EQ(::semget(static_cast<key_t>(traces.key), 2, 0600), -1);
    }
}

TEST_P(Deaths, OfTheProgramLeaveNothingThatTheSimulatorDoesNotRemove) {
    const auto master = make_master(transport(), Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    go_to(*master, std::get<1>(GetParam()));
    master->process().kill();
    EXPECT_EQ(master->process().wait(), (Ending{true, SIGKILL}));
    master->clean_up();
    EXPECT_EQ(left_over(), std::vector<std::string>());
}

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    Deaths,
    ::testing::Combine(
        ::testing::Values(
            Transport::pipes, Transport::files, Transport::memory, Transport::sockets),
        ::testing::Range(std::size_t{0}, kPoints.size())),
    [](const auto& test) {
        return name_of(std::get<0>(test.param)) + "_" + kPoints[std::get<1>(test.param)].name;
    });

class LongComputations : public SessionTest, public ::testing::WithParamInterface<Transport> {};

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    LongComputations,
    ::testing::Values(Transport::pipes, Transport::files, Transport::memory, Transport::sockets),
    [](const auto& test) { return name_of(test.param); });

/// The computation would take a day, and exceed the time limit of the test.
TEST_P(LongComputations, EndWhenTheSimulatorDies) {
    folder_.write("comm.e", comm_text(GetParam()));
    folder_.write("light.qmc", "number of rays: 1073741824\nnumber of runs: 10000\nverbose: 0\n");
    const Traces traces = play_and_die(
        [&] { return make_master(GetParam(), Client::cpfg, folder_.path()); }, 0,
        [](Master& master, std::size_t) {
            master.await_sign();
            master.send(kTwoLeaves);
            ::usleep(300'000);  // into the computation
        });
    EXPECT_EQ(wait_for(traces.program), (Ending{false, 1}));
    EXPECT_NE(folder_.read("err").find("has ended"), std::string::npos);
}

class Vanishing : public LongComputations {};

INSTANTIATE_TEST_SUITE_P(
    Protocol,
    Vanishing,
    ::testing::Values(Transport::files, Transport::memory),
    [](const auto& test) { return name_of(test.param); });

TEST_P(Vanishing, SemaphoresEndTheProgram) {
    folder_.write("comm.e", comm_text(GetParam()));
    folder_.write("light.qmc", kBlackLeaves);
    const auto master = make_master(GetParam(), Client::cpfg, folder_.path());
    master->start({"light.qmc"});
    master->await_sign();
    const int set = ::semget(static_cast<key_t>(*master->semaphore_key()), 2, 0600);
    ASSERT_EQ(::semctl(set, 0, IPC_RMID), 0);
    EXPECT_EQ(master->process().wait(), (Ending{false, 1}));
    EXPECT_NE(folder_.read("err").find("semaphores were removed"), std::string::npos);
}

}  // namespace
}  // namespace quasimc::test
