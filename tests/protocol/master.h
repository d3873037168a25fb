#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/vlab/comm_file.h"
#include "process.h"

namespace quasimc::test {

/// Thrown when the program under test violates the protocol.
class MasterError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The plant simulator's side of a session, like that of cpfg and lpfg: starts the program, sends
/// texts, reads replies. It is made, used and destroyed in one process; if that dies, its
/// semaphores and files remain as those of a real simulator.
class Master {
  public:
    virtual ~Master() = default;
    Master() = default;
    Master(const Master&) = delete;
    Master& operator=(const Master&) = delete;

    /// Starts the program with the switches of the transport and these further words.
    virtual void start(const std::vector<std::string>& words) = 0;
    /// Waits for the program's first sign.
    virtual void await_sign() = 0;
    /// Waits for the first sign or for a refusal; returns whether it was the sign.
    virtual bool is_welcomed() = 0;
    /// Whether the sign was given; only for semaphores, which keep it.
    [[nodiscard]] virtual bool has_signed() const { return false; }
    /// Writes a text without signalling it (the same as sending for pipes and sockets).
    virtual void write(std::string_view text) = 0;
    virtual void send() = 0;
    /// The next reply, up to and with its Control line.
    virtual std::string read() = 0;
    /// Waits for the program's last sign, where there is one.
    virtual void await_last_sign() = 0;
    /// The key of the semaphores, if the transport has them.
    [[nodiscard]] virtual std::optional<long> semaphore_key() const { return std::nullopt; }
    /// Removes and closes the resources of the simulator, as a real one does at the end.
    virtual void clean_up() = 0;

    [[nodiscard]] Process& process() { return *process_; }

    void send(std::string_view text) {
        write(text);
        send();
    }
    /// A reply in one text: chunks are asked for until the last, Control lines between them left
    /// in.
    std::string read_all_chunks();
    /// Requests the next chunk of a reply.
    virtual void ask_for_next_chunk() = 0;

  protected:
    std::unique_ptr<Process> process_;
};

/// The simulator that is played; they differ in switches.
enum class Client { cpfg, lpfg };

/// @param folder  working folder of both processes
[[nodiscard]] std::unique_ptr<Master> make_master(
    Transport transport, Client client, const std::filesystem::path& folder);

/// The names of all transports, for tests over all of them.
[[nodiscard]] std::string name_of(Transport transport);

/// The text of an environment file.
[[nodiscard]] std::string comm_text(Transport transport);

}  // namespace quasimc::test
