#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "at_once.h"
#include "session_fixture.h"

namespace quasimc::test {

/// A column of the matrix: simulator and transport.
struct Talk {
    Transport transport = Transport::pipes;
    Client client = Client::cpfg;

    [[nodiscard]] bool has_semaphores() const {
        return transport == Transport::files || transport == Transport::memory;
    }
    /// "cpfg_files"
    [[nodiscard]] std::string name() const;
};

/// cpfg over all transports, lpfg over files.
[[nodiscard]] std::vector<Talk> all_talks();

/// A leaf in the format of a simulator, with its Control line: flat in full sun, or upright like
/// the first organ of a plant, edge-on to light from above.
[[nodiscard]] std::string flat_leaf(Client client, int step);
[[nodiscard]] std::string upright_leaf(Client client, int step);
/// The order to exit.
[[nodiscard]] std::string goodbye(Client client);

/// One session in a temporary folder, from the start of the program to its end.
class PlayedSession {
  public:
    /// Writes the environment file and the specification. @param comm  more lines of the former
    PlayedSession(Talk talk, const std::string& specification, const std::string& comm = {});
    /// Starts the program. @param words  before the name of the specification
    void start(std::vector<std::string> words = {});
    /// start(), and waits for the sign.
    void begin();
    /// Sends a text and returns the whole reply; measures the wait for it.
    std::string ask(const std::string& text);
    /// Orders the exit. cpfg closes its connection as soon as it is acknowledged; lpfg requests no
    /// answer and waits for the end of the program.
    void say_goodbye();
    /// The values of the two semaphores.
    [[nodiscard]] std::array<int, 2> semaphores() const;
    /// Waits for the end of the program and requires this status; then nothing may be left.
    void expect_end(int status);
    /// expect_end() for a program that was killed.
    void expect_kill();
    /// Throws unless the program reported this text on stderr the given number of times.
    void expect_reported(const std::string& words, int times = 1) const;

    [[nodiscard]] Master& master() { return *master_; }
    [[nodiscard]] std::string reported() const { return folder_.read("err"); }
    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }
    [[nodiscard]] Talk talk() const { return talk_; }

  private:
    void expect(const Ending& expected);

    Talk talk_;
    TemporaryFolder folder_;
    std::unique_ptr<Master> master_;
    long key_ = -1;
};

/// Leftovers of a session: a file in the folder that is not from the test, semaphores of the key,
/// or memory; "" if there are none.
[[nodiscard]] std::string left_over(const TemporaryFolder& folder, long key);

/// Longest wait of a correct program, also on a loaded machine, s.
inline constexpr double kLongestWait = 20;

/// Plays the cases, a few at a time; fails for each that fails. Prints the longest wait.
void expect_all_good(const std::vector<Case>& cases);

}  // namespace quasimc::test
