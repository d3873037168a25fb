#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "at_once.h"
#include "conversation.h"

namespace quasimc::test {

/// A column of the matrix: who talks to the program, over what.
struct Talk {
    Transport transport = Transport::pipes;
    Client client = Client::cpfg;

    [[nodiscard]] bool has_semaphores() const {
        return transport == Transport::files || transport == Transport::memory;
    }
    /// "cpfg_files"
    [[nodiscard]] std::string name() const;
};

/// cpfg over everything, lpfg over files.
[[nodiscard]] std::vector<Talk> all_talks();

/// A leaf as its simulator writes it: flat in full sun, or upright as the first organ of a plant
/// stands, edge-on to light from above. With its Control line.
[[nodiscard]] std::string flat_leaf(Client client, int step);
[[nodiscard]] std::string upright_leaf(Client client, int step);
/// The order to exit.
[[nodiscard]] std::string goodbye(Client client);

/// One conversation in a folder of its own, from the start of the program to its end.
class Conversing {
  public:
    /// Writes the environment file and the specification. @param comm  more lines of the former
    Conversing(Talk talk, const std::string& specification, const std::string& comm = {});
    /// Starts the program. @param words  before the name of the specification
    void start(std::vector<std::string> words = {});
    /// start(), and waits for the sign.
    void begin();
    /// Sends a text and gives the whole reply to it, the wait for which is measured.
    std::string ask(const std::string& text);
    /// The order to exit. cpfg closes its line as soon as it is acknowledged; lpfg asks for no
    /// answer and waits for the end of the program.
    void say_goodbye();
    /// The values of the two semaphores.
    [[nodiscard]] std::array<int, 2> semaphores() const;
    /// Waits for the end of the program and requires this status; then nothing may be left.
    void expect_end(int status);
    /// The same of a program that was killed.
    void expect_kill();
    /// Throws unless the program told this on stderr, so often.
    void expect_told(const std::string& words, int times = 1) const;

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

/// What a conversation has left: a name in the folder that is none of the test's, semaphores of the
/// key, memory; or nothing.
[[nodiscard]] std::string left_over(const TemporaryFolder& folder, long key);

/// No wait is longer, unless something is wrong; the machine may be loaded.
inline constexpr double kLongestWait = 20;

/// Plays the cases, a few at a time; fails for each that fails. Prints the longest wait.
void expect_all_good(const std::vector<Case>& cases);

}  // namespace quasimc::test
