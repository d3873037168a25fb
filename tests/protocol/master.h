#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/vlab/comm_file.h"
#include "process.h"

namespace quasimc::test {

/// Thrown when the program under test does not do what the protocol says.
class MasterError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A plant simulator's side of the line, as libs of cpfg and lpfg play it: starts the program,
/// hands over texts, takes replies. Made, used and destroyed in one process; if that dies, its
/// semaphores and files stay as those of a real simulator do.
class Master {
  public:
    virtual ~Master() = default;
    Master() = default;
    Master(const Master&) = delete;
    Master& operator=(const Master&) = delete;

    /// Starts the program with the switches of the transport and these further words.
    virtual void start(const std::vector<std::string>& words) = 0;
    /// Waits for the sign that it is there.
    virtual void await_sign() = 0;
    /// Waits for the sign, or for the program's answer that there will be no light. Returns whether
    /// it was the sign.
    virtual bool is_welcomed() = 0;
    /// Whether the sign was given; for semaphores, which keep it.
    [[nodiscard]] virtual bool has_signed() const { return false; }
    /// Writes a text without telling that it is there (pipes and sockets: there is no difference).
    virtual void write(std::string_view text) = 0;
    virtual void send() = 0;
    /// The next reply, up to and with its Control line.
    virtual std::string read() = 0;
    /// The byte with which the program says good-bye, where there is one.
    virtual void await_last_sign() = 0;
    /// Of the semaphores, where there are any.
    [[nodiscard]] virtual std::optional<long> semaphore_key() const { return std::nullopt; }
    /// Removes and closes what a real simulator removes and closes in the end.
    virtual void clean_up() = 0;

    [[nodiscard]] Process& process() { return *process_; }

    void send(std::string_view text) {
        write(text);
        send();
    }
    /// A reply in one text: chunks are asked for until the last, Control lines between them left
    /// in.
    std::string read_all_chunks();
    /// What follows a chunk of a reply that is not the last.
    virtual void ask_for_next_chunk() = 0;

  protected:
    std::unique_ptr<Process> process_;
};

/// Who is played: they differ in switches.
enum class Client { cpfg, lpfg };

/// @param folder  the working folder of both
[[nodiscard]] std::unique_ptr<Master> make_master(
    Transport transport, Client client, const std::filesystem::path& folder);

/// The names of all transports, for tests over all of them.
[[nodiscard]] std::string name_of(Transport transport);

/// The text of an environment file.
[[nodiscard]] std::string comm_text(Transport transport);

}  // namespace quasimc::test
