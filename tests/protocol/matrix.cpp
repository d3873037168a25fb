#include "matrix.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <iostream>

#include <fmt/format.h>
#include <sys/ipc.h>
#include <sys/sem.h>
#include <sys/shm.h>

namespace quasimc::test {
namespace {

std::size_t count_of(std::string_view text, std::string_view words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string_view::npos;
         at = text.find(words, at + 1)) {
        ++count;
    }
    return count;
}

/// The lines of a leaf; the turtle's left is -x.
std::string leaf(Client client, const char* heading, const char* up, int step) {
    const char* query = client == Client::lpfg
                            ? "24 E(1.000000)P(0.500000,2.000000,0.000000,0.000000)"
                            : "24 E(1)P(0.5,2)";
    return fmt::format(
        "{}\n 0 1 0\n {}\n -1 0 0\n {}\nControl: 5 {}\n", query, heading, up,
        client == Client::lpfg ? 0 : step);
}

}  // namespace

std::string Talk::name() const {
    return (client == Client::lpfg ? "lpfg_" : "cpfg_") + name_of(transport);
}

std::vector<Talk> all_talks() {
    return {
        {Transport::pipes, Client::cpfg},
        {Transport::files, Client::cpfg},
        {Transport::memory, Client::cpfg},
        {Transport::sockets, Client::cpfg},
        {Transport::files, Client::lpfg}};
}

std::string flat_leaf(Client client, int step) {
    return leaf(client, "0 0 -1", "0 1 0", step);
}

std::string upright_leaf(Client client, int step) {
    return leaf(client, "0 1 0", client == Client::lpfg ? "0 0 1" : "0 0 -1", step);
}

std::string goodbye(Client client) {
    return client == Client::lpfg ? "Control: 9 0\nControl: 5 0\n" : "Control: 8 0\n";
}

PlayedSession::PlayedSession(Talk talk, const std::string& specification, const std::string& comm)
    : talk_(talk) {
    folder_.write("comm.e", comm_text(talk.transport) + comm);
    folder_.write("light.qmc", specification);
    master_ = make_master(talk.transport, talk.client, folder_.path());
    key_ = master_->semaphore_key().value_or(-1);
}

void PlayedSession::start(std::vector<std::string> words) {
    words.emplace_back("light.qmc");
    master_->start(words);
}

void PlayedSession::begin() {
    start();
    measure_wait([&] { master_->await_sign(); });
}

std::string PlayedSession::ask(const std::string& text) {
    std::string reply;
    measure_wait([&] {
        master_->send(text);
        reply = master_->read_all_chunks();
    });
    return reply;
}

void PlayedSession::say_goodbye() {
    if (talk_.client == Client::lpfg) {
        master_->send(goodbye(talk_.client));
        measure_wait([&] { require(master_->process().wait_for_end(), "it does not end"); });
    } else {
        require(ask(goodbye(talk_.client)) == kEmptyAnswer, "the goodbye is not acknowledged");
    }
    master_->clean_up();
}

std::array<int, 2> PlayedSession::semaphores() const {
    const int set = ::semget(static_cast<key_t>(key_), 2, 0);
    return {::semctl(set, 0, GETVAL), ::semctl(set, 1, GETVAL)};
}

void PlayedSession::expect_end(int status) {
    expect({false, status});
}

void PlayedSession::expect_kill() {
    expect({true, SIGKILL});
}

void PlayedSession::expect(const Ending& expected) {
    std::optional<Ending> ending;
    measure_wait([&] { ending = master_->process().wait(); });
    require(ending.has_value(), "the program does not end");
    require(
        *ending == expected,
        fmt::format(
            "{} {}: {}", ending->by_signal ? "signal" : "status", ending->status, reported()));
    master_->clean_up();
    master_.reset();
    const std::string left = left_over(folder_, key_);
    require(left.empty(), left + " is left");
}

void PlayedSession::expect_reported(const std::string& words, int times) const {
    require(
        count_of(reported(), words) == static_cast<std::size_t>(times),
        fmt::format("'{}' must be reported {} times: {}", words, times, reported()));
}

std::string left_over(const TemporaryFolder& folder, long key) {
    constexpr std::array<std::string_view, 5> kOwn{"comm.e", "light.qmc", "err", "out", "bad.e"};
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        if (std::find(kOwn.begin(), kOwn.end(), name) == kOwn.end()) {
            return name;
        }
    }
    if (key >= 0 && ::semget(static_cast<key_t>(key), 2, 0600) >= 0) {
        return "a pair of semaphores";
    }
    if (key >= 0 && ::shmget(static_cast<key_t>(key - 1), 1, 0600) >= 0) {
        return "shared memory";
    }
    return "";
}

void expect_all_good(const std::vector<Case>& cases) {
    constexpr unsigned kAtOnce = 16;  // they mostly wait
    const Played played = play_at_once(cases, kAtOnce);
    for (const std::string& failure : played.failures) {
        ADD_FAILURE() << failure;
    }
    EXPECT_LT(played.longest_seconds, kLongestWait);
    std::cout << fmt::format(
        "{} sessions, longest wait {:.3f} s\n", cases.size(), played.longest_seconds);
}

}  // namespace quasimc::test
