// Errors in a growth x every transport x both simulators: the remaining process detects it at once,
// continues or ends as the manual says, and nothing is left. (Kills: matrix_kills_test.cpp.)

#include "matrix.h"

#include <array>
#include <cmath>
#include <csignal>

#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>

#include "captures.h"

namespace quasimc::test {
namespace {

class Matrix : public SessionTest {};

/// One session over every transport.
std::vector<Case> over_all_lines(const std::function<void(Talk)>& play) {
    std::vector<Case> cases;
    for (const Talk talk : all_talks()) {
        cases.push_back({talk.name(), [=] { play(talk); }});
    }
    return cases;
}

void require_light(const std::string& reply) {
    const bool is_one = structure_of(reply) == "24 E(#)\nControl: 5\n";
    constexpr double kMargin = 1e-4;  // the window of the light is a little larger than the leaf
    require(is_one && std::abs(values_of(reply)[24] - 1) < kMargin, "no light: " + reply);
}

void require_empty(const std::string& reply) {
    require(reply == kEmptyAnswer, "no empty answer: " + reply);
}

TEST_F(Matrix, NormalEnd) {
    std::vector<Case> cases;
    for (int i = 0; i < 15; ++i) {
        for (const Case& one : over_all_lines([](Talk talk) {
                 PlayedSession c(talk, kBlackLeaves);
                 c.begin();
                 for (int step = 0; step < 2; ++step) {
                     require_light(c.ask(flat_leaf(talk.client, step)));
                 }
                 c.say_goodbye();
                 c.expect_end(0);
                 require(c.reported().empty(), c.reported());
             })) {
            cases.push_back(one);
        }
    }
    expect_all_good(cases);
}

/// The state of the semaphores at the end of lpfg: an answer that it does not take, and room to add
/// one.
void require_room(const PlayedSession& c, int most) {
    const auto [questions, answers] = c.semaphores();
    require(
        questions == 0 && answers > 0 && answers <= most,
        fmt::format("the semaphores are {} and {}", questions, answers));
}

TEST_F(Matrix, NothingIsOwedToSemaphoresAfterTheOrderToExit) {
    expect_all_good(over_all_lines([](Talk talk) {
        if (!talk.has_semaphores()) {
            return;
        }
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        require_light(c.ask(flat_leaf(talk.client, 0)));
        c.master().send(goodbye(talk.client));
        measure_wait([&] { require(c.master().process().wait_for_end(), "it does not end"); });
        require_room(c, 1);
        c.expect_end(0);
    }));
}

TEST_F(Matrix, SemaphoresHaveRoomAfterEveryOtherEnd) {
    constexpr int kHalf = 16384;  // of what one counts to
    for (const int signal : {SIGTERM, SIGKILL}) {
        expect_all_good(over_all_lines([signal](Talk talk) {
            if (!talk.has_semaphores()) {
                return;
            }
            PlayedSession c(talk, kBlackLeaves);
            c.begin();
            require_light(c.ask(flat_leaf(talk.client, 0)));
            c.master().process().send(signal);
            measure_wait([&] { require(c.master().process().wait_for_end(), "it does not end"); });
            require_room(c, kHalf);
            signal == SIGKILL ? c.expect_kill() : c.expect_end(128 + signal);
        }));
    }
}

/// cpfg closes its connection after one byte of the answer; here it closes before there is any.
TEST_F(Matrix, EndOfASimulatorThatDoesNotWait) {
    expect_all_good(over_all_lines([](Talk talk) {
        if (talk.has_semaphores()) {
            return;  // there is no connection to close
        }
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        c.master().process().send(SIGSTOP);
        c.master().send(goodbye(talk.client));
        c.master().clean_up();
        c.master().process().send(SIGCONT);
        c.expect_end(0);
        require(c.reported().empty(), c.reported());
    }));
}

TEST_F(Matrix, NoLight) {
    expect_all_good(over_all_lines([](Talk talk) {
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        for (int step = 0; step < 2; ++step) {
            const std::string reply = c.ask(upright_leaf(talk.client, step));
            require(reply == "24 E(0)\nControl: 5\n", "no zero: " + reply);
        }
        require_light(c.ask(flat_leaf(talk.client, 2)));
        c.say_goodbye();
        c.expect_end(0);
        c.expect_reported("no light reaches the plant");
    }));
}

/// In whatever step, light is computed again when the message is right again.
TEST_F(Matrix, FaultOfAMessage) {
    expect_all_good(over_all_lines([](Talk talk) {
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        const std::string bad = "24 E(1)P(0.5,2)\n 0 1\nControl: 5 2\n";
        for (int step = 0; step < 2; ++step) {
            require_light(c.ask(flat_leaf(talk.client, step)));
        }
        require_empty(c.ask(bad));
        require_empty(c.ask(bad));
        require_empty(c.ask("no query\nControl: 5 4\n"));
        require_light(c.ask(flat_leaf(talk.client, 5)));
        require_empty(c.ask("24 E(1)P(0.5,2)\n 0 1\nControl: 1 0\n"));  // a chunk; more follow
        require_empty(c.ask(flat_leaf(talk.client, 6)));
        c.say_goodbye();
        c.expect_end(1);
        c.expect_reported("step 2: ");
        c.expect_reported("step 3: ", 0);
        c.expect_reported("step 4: ");
        c.expect_reported("step 5: answers continue");
        c.expect_reported("step 6: ");
    }));
}

/// The answers are sent even if a file can't be written.
TEST_F(Matrix, FaultOfAFile) {
    expect_all_good(over_all_lines([](Talk talk) {
        PlayedSession c(talk, kBlackLeaves + "output file: yes nowhere/light.dat\n");
        c.begin();
        for (int step = 0; step < 3; ++step) {
            require_light(c.ask(flat_leaf(talk.client, step)));
        }
        c.say_goodbye();
        c.expect_end(1);
        c.expect_reported("nowhere/light", 3);  // another file at each step
    }));
}

/// A refused simulator continues alone if the transport has a refusal; otherwise it receives empty
/// answers until its order to exit.
void grow_in_the_dark(PlayedSession& c, const std::string& words, int status) {
    const bool goes_on = !c.talk().has_semaphores();
    bool is_welcomed = false;
    measure_wait([&] { is_welcomed = c.master().is_welcomed(); });
    require(is_welcomed != goes_on, "the simulator receives the wrong first sign");
    if (!goes_on) {
        c.expect_reported(words);  // at once
        for (int step = 0; step < 3; ++step) {
            require_empty(c.ask(flat_leaf(c.talk().client, step)));
        }
        c.say_goodbye();
    }
    c.expect_end(status);
    c.expect_reported(words);
}

TEST_F(Matrix, RefusedSpecification) {
    expect_all_good(over_all_lines([](Talk talk) {
        PlayedSession c(talk, "number of rays: none\n");
        c.start();
        grow_in_the_dark(c, "light.qmc:1", 1);
    }));
}

TEST_F(Matrix, RefusedEnvironmentFile) {
    expect_all_good(over_all_lines([](Talk talk) {
        PlayedSession c(talk, kBlackLeaves, "binary data: on\n");
        c.start();
        grow_in_the_dark(c, "comm.e:8: binary data", 1);
    }));
}

TEST_F(Matrix, RefusedCommandLine) {
    expect_all_good(over_all_lines([](Talk talk) {
        PlayedSession c(talk, kBlackLeaves);
        c.start({"-windows"});
        grow_in_the_dark(c, "-windows is not a switch", 2);
    }));
}

/// The semaphores answer a simulator with nothing after the end of the program.
void grow_alone(PlayedSession& c) {
    if (c.talk().has_semaphores()) {
        for (int step = 0; step < 3; ++step) {
            require_empty(c.ask(flat_leaf(c.talk().client, step)));
        }
        require_empty(c.ask(goodbye(c.talk().client)));
    }
}

void stop(PlayedSession& c, int signal) {
    c.master().process().send(signal);
    measure_wait([&] { require(c.master().process().wait_for_end(), "it does not end"); });
}

std::vector<Case> stopped(const std::function<void(Talk, int)>& play) {
    std::vector<Case> cases;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        for (const Talk talk : all_talks()) {
            cases.push_back(
                {fmt::format("{} {}", talk.name(), signal), [=] { play(talk, signal); }});
        }
    }
    return cases;
}

TEST_F(Matrix, SignalWhileWaiting) {
    expect_all_good(stopped([](Talk talk, int signal) {
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        require_light(c.ask(flat_leaf(talk.client, 0)));
        stop(c, signal);
        grow_alone(c);
        c.expect_end(128 + signal);
        c.expect_reported("ended by SIG");
    }));
}

/// The computation would take a day.
TEST_F(Matrix, SignalWhileComputing) {
    expect_all_good(stopped([](Talk talk, int signal) {
        PlayedSession c(talk, "number of rays: 1073741824\nnumber of runs: 10000\nverbose: 0\n");
        c.begin();
        c.master().send(flat_leaf(talk.client, 0));
        ::usleep(200'000);  // into the computation
        c.master().process().send(signal);
        std::string reply;
        measure_wait([&] { reply = c.master().read(); });
        require_empty(reply);
        grow_alone(c);
        c.expect_end(128 + signal);
    }));
}

/// Signals of a terminal are ignored in a program that a shell started in the background.
TEST_F(Matrix, SignalThatIsIgnored) {
    expect_all_good(over_all_lines([](Talk talk) {
        std::signal(SIGINT, SIG_IGN);
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        c.master().process().send(SIGINT);
        ::usleep(50'000);
        require_light(c.ask(flat_leaf(talk.client, 0)));
        c.say_goodbye();
        c.expect_end(0);
    }));
}

/// The simulators leave their descriptors open to the program; if it held one, the end of that
/// connection would never be detected.
TEST_F(Matrix, NothingIsInherited) {
    expect_all_good(over_all_lines([](Talk talk) {
        std::array<int, 2> line{};
        require(::pipe(line.data()) == 0, "no pipe");
        PlayedSession c(talk, kBlackLeaves);
        c.begin();
        ::close(line[1]);
        pollfd end{line[0], POLLIN, 0};
        require(::poll(&end, 1, 0) == 1 && (end.revents & POLLHUP) != 0, "it holds the line");
        c.say_goodbye();
        c.expect_end(0);
    }));
}

TEST_F(Matrix, ItselfFailsWhereSomethingIsLeft) {
    const Played played = play_at_once(
        {{"reason", [] { require(false, "it is so"); }},
         {"process",
          [] {
              if (::fork() == 0) {
                  ::pause();
              }
          }},
         {"crash", [] { std::raise(SIGKILL); }},
         {"good", [] { measure_wait([] { ::usleep(2000); }); }}},
        2);
    EXPECT_EQ(
        played.failures, (std::vector<std::string>{
                             "reason: it is so", "process: a process is left",
                             "crash: it ended without an outcome"}));
    EXPECT_GE(played.longest_seconds, .002);
}

}  // namespace
}  // namespace quasimc::test
