// Either side of a growth is killed, at fifty times from its start on, over every transport and
// with both simulators: the other side ends or continues, and nothing is left.

#include <array>
#include <csignal>

#include <unistd.h>

#include <fmt/format.h>

#include "matrix.h"

namespace quasimc::test {
namespace {

constexpr int kKills = 50;
constexpr int kMicrosecondsBetween = 2000;

class MatrixOfKills : public SessionTest, public ::testing::WithParamInterface<Talk> {};

INSTANTIATE_TEST_SUITE_P(
    Protocol, MatrixOfKills, ::testing::ValuesIn(all_talks()), [](const auto& test) {
        return test.param.name();
    });

std::string environment_file(Talk talk) {
    const std::string two_in_a_chunk = "communication type: " + name_of(talk.transport) + " 2\n";
    return comm_text(talk.transport) + (talk.client == Client::cpfg ? two_in_a_chunk : "");
}

/// One step of three leaves; cpfg sends them, and takes the answers, in two parts.
void grow(Master& master, Talk talk, int step) {
    std::string leaf = flat_leaf(talk.client, step);
    const std::string control = leaf.substr(leaf.find("Control"));
    leaf.resize(leaf.find("Control"));
    if (talk.client == Client::cpfg) {
        master.send(leaf + leaf + "Control: 1 0\n");
        static_cast<void>(master.read());
        master.send(leaf + fmt::format("Control: 4 {}\n", step));
    } else {
        master.send(leaf + leaf + leaf + control);
    }
    static_cast<void>(master.read_all_chunks());
}

/// A growth that never ends.
[[noreturn]] void grow_on(Master& master, Talk talk) {
    master.await_sign();
    for (int step = 0;; ++step) {
        grow(master, talk, step);
    }
}

/// Data about a simulator that was killed.
struct Left {
    pid_t program = -1;
    long key = -1;
};

/// Plays a simulator in a child process and kills it after a time.
Left kill_simulator(Talk talk, const TemporaryFolder& folder, int microseconds) {
    std::array<int, 2> line{};
    require(::pipe(line.data()) == 0, "no pipe");
    const pid_t simulator = ::fork();
    if (simulator == 0) {
        try {
            const auto master = make_master(talk.transport, talk.client, folder.path());
            master->start({"light.qmc"});
            const Left left{master->process().pid(), master->semaphore_key().value_or(-1)};
            require(::write(line[1], &left, sizeof left) == sizeof left, "no pipe");
            grow_on(*master, talk);
        } catch (const std::exception&) {
            ::_exit(1);
        }
    }
    Left left;
    require(::read(line[0], &left, sizeof left) == sizeof left, "the simulator doesn't start");
    ::usleep(static_cast<useconds_t>(microseconds));
    ::kill(simulator, SIGKILL);
    require(wait_for(simulator) == Ending{true, SIGKILL}, "the simulator ended by itself");
    return left;
}

TEST_P(MatrixOfKills, OfTheSimulatorEndTheProgram) {
    const Talk talk = GetParam();
    std::vector<Case> cases;
    for (int i = 0; i < kKills; ++i) {
        cases.push_back({std::to_string(i), [=] {
                             TemporaryFolder folder;
                             folder.write("comm.e", environment_file(talk));
                             folder.write("light.qmc", kBlackLeaves);
                             const Left left =
                                 kill_simulator(talk, folder, i * kMicrosecondsBetween);
                             std::optional<Ending> ending;
                             measure_wait([&] { ending = wait_for(left.program); });
                             const std::string reported = folder.read("err");
                             require(ending == Ending{false, 1}, "not status 1: " + reported);
                             require(
                                 reported.find("has ended") != std::string::npos ||
                                     reported.find("can't be reached") != std::string::npos,
                                 reported);
                             const std::string remains = left_over(folder, left.key);
                             require(remains.empty(), remains + " is left");
                         }});
    }
    expect_all_good(cases);
}

/// Semaphores answer for a program that was killed after its first sign, so that the simulator
/// continues; it detects the end of other connections.
TEST_P(MatrixOfKills, OfTheProgramLeaveNoSimulatorWaiting) {
    const Talk talk = GetParam();
    std::vector<Case> cases;
    for (int i = 0; i < kKills; ++i) {
        cases.push_back({std::to_string(i), [=] {
                             PlayedSession c(talk, kBlackLeaves);
                             c.begin();
                             const pid_t program = c.master().process().pid();
                             const pid_t killer = ::fork();
                             if (killer == 0) {
                                 ::usleep(static_cast<useconds_t>(i * kMicrosecondsBetween));
                                 ::_exit(::kill(program, SIGKILL));
                             }
                             int step = 0;
                             std::string cut_off;
                             while (cut_off.empty() && !c.master().process().has_ended()) {
                                 try {
                                     measure_wait([&] { grow(c.master(), talk, step++); });
                                 } catch (const MasterError& error) {
                                     cut_off = error.what();
                                 }
                             }
                             require(wait_for(killer) == Ending{false, 0}, "not killed");
                             require(cut_off.empty() || !talk.has_semaphores(), cut_off);
                             for (int more = 0; talk.has_semaphores() && more < 3; ++more) {
                                 measure_wait([&] { grow(c.master(), talk, step++); });
                             }
                             c.expect_kill();
                         }});
    }
    expect_all_good(cases);
}

}  // namespace
}  // namespace quasimc::test
