#include "coupling/plants/environment_program.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// The words of the line "executable:". cpfg's own sign for the background may end it.
std::vector<std::string> split_command(std::string_view line) {
    std::vector<std::string> words;
    for (auto word = take_word(line); !word.empty(); word = take_word(line)) {
        words.emplace_back(word);
    }
    if (!words.empty() && words.back() == "&") {
        words.pop_back();
    }
    return words;
}

}  // namespace

EnvironmentProgram::EnvironmentProgram(
    CommFile format, std::string comm_file, Notices& notices, const ProgramPatience& patience)
    : format_(std::move(format)),
      comm_file_(std::move(comm_file)),
      notices_(notices),
      writer_(format_) {
    connect(patience);
}

void EnvironmentProgram::connect(const ProgramPatience& patience) {
    const ProgramCommand command{split_command(format_.executable), comm_file_, patience};
    Faults faults;
    if (command.words.empty()) {
        faults.add(
            {comm_file_, "the environment program is missing", "it answers the queries of a plant",
             "add 'executable: QuasiMC light.qmc'"});
    }
    if (!format_.remote_host.empty()) {
        faults.add(
            {comm_file_, "'remote host' is not supported", "the program runs on this computer",
             "remove the line"});
    }
    faults.throw_if_any();
    name_ = program_in_messages(command.words.front());
    try {
        connection_ = connect_program(format_.transport, command);
    } catch (const ProgramNotStarted& error) {
        notices_.once(fmt::format(
            "{}: can't be started ({}); the environment is ignored, and modules keep their values",
            name_, error.what()));
    }
}

EnvironmentProgram::~EnvironmentProgram() {
    if (!connection_) {
        return;
    }
    try {
        const std::string ending = connection_->close("Control: 8 0\n");
        if (!ending.empty()) {
            notices_.once(fmt::format("{}: {}", name_, ending));
        }
    } catch (const std::exception&) {
        return;  // the program is ended with the connection
    }
}

template <typename Work>
void EnvironmentProgram::guarded(const Work& work) {
    if (failure_) {
        std::rethrow_exception(failure_);
    }
    try {
        work();
    } catch (const InputError&) {
        failure_ = std::current_exception();
        connection_.reset();
        throw;
    }
}

Drawing* EnvironmentProgram::query(const PlantQuery& query) {
    if (!connection_ && !failure_) {
        return nullptr;
    }
    guarded([&] { add_pending(); });
    writer_.append(pending_, query);
    if (!query.is_answered && (dropped_.empty() || dropped_.back() != query.id)) {
        dropped_.push_back(query.id);
    }
    has_graphics_ = format_.interprets(query.following, query.following_parameters.size());
    pending_ += has_graphics_ ? "Dbegin\n" : "";
    return has_graphics_ ? &graphics_ : nullptr;
}

std::vector<PlantAnswer> EnvironmentProgram::answers(std::int64_t step) {
    if (!connection_ && !failure_) {
        return {};
    }
    guarded([&] {
        add_pending();
        if (chunk_size_ > 0) {
            exchange(is_first_chunk_ ? ChunkPosition::only : ChunkPosition::last, step);
        }
    });
    is_first_chunk_ = true;
    dropped_.clear();
    return std::exchange(answers_, {});
}

void EnvironmentProgram::add_pending() {
    constexpr std::size_t kControlLine = 32;
    if (pending_.empty()) {
        return;
    }
    pending_ += std::exchange(has_graphics_, false) ? "Dend\n" : "";
    const std::size_t capacity = connection_->capacity() - kControlLine;
    if (pending_.size() > capacity) {
        throw InputError(
            {{comm_file_, "the shapes of a module are too large for 'communication type: memory'",
              fmt::format("{} bytes are allowed", capacity), "use pipes"}});
    }
    const bool is_full = chunk_size_ >= format_.chunk.value_or(connection_->default_chunk()) ||
                         chunk_.size() + pending_.size() > capacity;
    if (chunk_size_ > 0 && is_full) {
        exchange(is_first_chunk_ ? ChunkPosition::first : ChunkPosition::middle, 0);
        is_first_chunk_ = false;
    }
    chunk_ += pending_;
    pending_.clear();
    ++chunk_size_;
}

void EnvironmentProgram::exchange(ChunkPosition position, std::int64_t step) {
    append_master_control(chunk_, position, step);
    trace("to", chunk_);
    connection_->send(chunk_);
    chunk_.clear();
    chunk_size_ = 0;
    read_reply();
}

void EnvironmentProgram::read_reply() {
    while (true) {
        const std::string_view line = connection_->receive_line();
        trace("from", line);
        if (line.starts_with("Control")) {
            if (ends_reply(line)) {
                return;
            }
            connection_->request_chunk();
        } else if (!trimmed(line).empty()) {
            PlantAnswer answer = read_answer(line, name_);
            if (std::find(dropped_.begin(), dropped_.end(), answer.id) == dropped_.end()) {
                answers_.push_back(std::move(answer));
            }
        }
    }
}

void EnvironmentProgram::trace(std::string_view direction, std::string_view text) const {
    if (!format_.verbose) {
        return;
    }
    LineScanner lines(text);
    std::string traced;
    while (lines.next()) {
        traced += fmt::format("{} {}: {}\n", direction, name_, printable(lines.line()));
    }
    std::fwrite(traced.data(), 1, traced.size(), stderr);
}

}  // namespace quasimc
