#include "coupling/plants/program_connection.h"

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/error.h"

namespace quasimc {

std::vector<std::string> ProgramCommand::with(const std::vector<std::string>& switches) const {
    std::vector<std::string> all{words.front()};
    if (words.size() < 2 || !words[1].starts_with("-e")) {
        all.insert(all.end(), {"-e", comm_file});
    }
    all.insert(all.end(), switches.begin(), switches.end());
    all.insert(all.end(), words.begin() + 1, words.end());
    return all;
}

std::string program_in_messages(std::string_view name) {
    return fmt::format("environment program {}", shown(name));
}

void ProgramConnection::start(const std::vector<std::string>& words, int in, int out) {
    program_ = std::make_unique<ChildProgram>(words, in, out);
}

void ProgramConnection::await_sign(const std::function<bool()>& has_sign) {
    const auto until = std::chrono::steady_clock::now() + patience_.start;
    while (true) {
        const bool is_over = program_->has_ended();
        if (has_sign()) {
            return;
        }
        if (is_over) {
            throw ProgramNotStarted(program_->ending());
        }
        if (std::chrono::steady_clock::now() > until) {
            throw ProgramNotStarted(
                fmt::format("it gave no sign within {} s", patience_.start.count() / 1000));
        }
    }
}

std::string ProgramConnection::close(std::string_view last_message) {
    send_last(last_message);
    if (!program_->wait(patience_.exit)) {
        return "it did not end after the order to exit, and is ended by a signal";
    }
    return program_->has_succeeded() ? "" : program_->ending();
}

bool ProgramConnection::wait_for_end() {
    constexpr std::chrono::milliseconds kShort{1000};
    return program_->wait(kShort);
}

void ProgramConnection::fail_as_ended() {
    fail(
        wait_for_end() ? program_->ending() : "it has closed the connection",
        "the plant has no environment any more", "see its messages above");
}

void ProgramConnection::fail(std::string problem, std::string why, std::string suggestion) {
    throw InputError(
        {{program_in_messages(program_->name()), std::move(problem), std::move(why),
          std::move(suggestion)}});
}

std::unique_ptr<ProgramConnection> connect_program(
    Transport transport, const ProgramCommand& command) {
    switch (transport) {
        case Transport::pipes:
            return connect_by_pipes(command);
        case Transport::files:
            return connect_by_files(command);
        case Transport::memory:
            return connect_by_memory(command);
        case Transport::sockets:
            break;
    }
    return connect_by_sockets(command);
}

}  // namespace quasimc
