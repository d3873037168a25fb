#include "parallel/checkpoint_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "files/atomic_file.h"
#include "files/file_identity.h"
#include "files/input_files.h"
#include "files/sha256.h"
#include "parallel/part_difference.h"
#include "parallel/run_head.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

constexpr std::string_view kFirstCheckpointLine = "QuasiMC checkpoint, format 4\n";
constexpr std::size_t kSha256Digits = 64;
/// Keys that may change when a run is resumed: its end.
constexpr std::array<std::string_view, 5> kEnds{
    "run_file.run.paths", "run_file.run.target_error", "run_file.run.target_fraction",
    "run_file.run.max_paths", "run_file.run.max_seconds"};

std::string block_of(std::string_view bytes) {
    return number_bytes(bytes.size()).append(bytes);
}

/// The file behind symbolic links: it has one lock and one second file, under any name.
std::string without_links(const std::string& path) {
    std::error_code error;
    return std::filesystem::is_symlink(path, error) ? followed(path).string() : path;
}

std::string done_path(const std::string& path) {
    return path + ".done";
}

/// Writes all bytes. @returns false  with errno, if it fails
bool write_at(int descriptor, std::string_view bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno != EINTR) {
            return false;
        }
        const auto written = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        bytes.remove_prefix(written);
        offset += written;
    }
    return true;
}

}  // namespace

std::string_view ByteReader::take(std::uint64_t count) {
    is_cut_off_ = is_cut_off_ || count > rest_.size();
    if (is_cut_off_) {
        return {};
    }
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
}

std::uint64_t ByteReader::number() {
    std::uint64_t number = 0;
    const std::string_view bytes = take(sizeof number);
    std::memcpy(&number, bytes.data(), bytes.size());
    return number;
}

CheckpointFile::CheckpointFile(
    const std::string& path, const RunFile& run, double every, CheckpointStart start)
    : path_(without_links(path)), lock_(path_), head_(head_of_run(run)), every_(every) {
    std::error_code error;
    was_there_ = std::filesystem::exists(path_, error);
    if (was_there_ && start == CheckpointStart::anew) {
        refuse_if_no_checkpoint(read_file(path_));
        throw InputError({{path_, "exists", "", "use --resume to continue it, or delete it"}});
    }
    if (!was_there_ && std::filesystem::exists(done_path(path_), error)) {
        throw InputError(
            {{done_path(path_), "exists without " + path_, "",
              "delete it, or name another checkpoint"}});
    }
    if (was_there_) {
        read();
    }
    write();
}

void CheckpointFile::refuse(const std::string& problem, const std::string& why) const {
    throw InputError({{path_, problem, why, ""}});
}

void CheckpointFile::refuse_if_no_checkpoint(std::string_view bytes) const {
    if (!bytes.starts_with(kFirstCheckpointLine)) {
        throw InputError(
            {{path_, "is not a checkpoint",
              "it must be a file written by `quasimc run --checkpoint`", "name another file"}});
    }
}

void CheckpointFile::read() {
    const std::string bytes = read_file(path_);
    refuse_if_no_checkpoint(bytes);
    const std::size_t size = bytes.size() - std::min(bytes.size(), kSha256Digits);
    if (sha256_hex(std::string_view(bytes).substr(0, size)) != bytes.substr(size)) {
        refuse("is damaged", "its checksum is wrong");
    }
    ByteReader reader(std::string_view(bytes).substr(0, size));
    static_cast<void>(reader.take(kFirstCheckpointLine.size()));
    const std::string difference = difference_of_runs(std::string(reader.block()), head_, kEnds);
    if (!difference.empty()) {
        refuse("belongs to another run", difference);
    }
    read_locations(reader);
    for (std::uint64_t left = reader.number(); left > 0 && !reader.is_cut_off(); --left) {
        const std::uint64_t time_step = reader.number();
        const bool is_done = reader.number() != 0;
        states_[time_step] = {std::string(reader.block()), is_done};
    }
    if (!reader.is_at_end()) {
        refuse("is damaged", "its length is wrong");
    }
}

void CheckpointFile::read_locations(ByteReader& reader) {
    done_bytes_ = reader.number();
    for (std::uint64_t left = reader.number(); left > 0 && !reader.is_cut_off(); --left) {
        const std::uint64_t time_step = reader.number();
        const std::uint64_t offset = reader.number();
        const std::uint64_t size = reader.number();
        locations_[time_step] = {offset, size, std::string(reader.take(kSha256Digits))};
    }
    if (!locations_.empty()) {
        open_done();
        for (const auto& [time_step, location] : locations_) {
            static_cast<void>(read_done(location));
        }
    }
}

void CheckpointFile::open_done() {
    const int create = locations_.empty() ? O_CREAT | O_TRUNC : 0;
    constexpr mode_t kReadable = 0666;  // without the process's umask
    done_ = std::make_unique<Descriptor>(
        ::open(done_path(path_).c_str(), O_RDWR | O_CLOEXEC | create, kReadable));
    if (!done_->is_open()) {
        throw InputError(
            {{done_path(path_), locations_.empty() ? "can't be written" : "can't be read",
              std::generic_category().message(errno), "it belongs to " + path_}});
    }
}

std::string CheckpointFile::read_done(const Location& location) const {
    std::string bytes(std::min(location.size, done_bytes_), '\0');
    std::size_t count = 0;
    ssize_t more = 1;
    while (count < bytes.size() && more > 0) {
        more = ::pread(
            done_->number(), bytes.data() + count, bytes.size() - count,
            static_cast<off_t>(location.offset + count));
        count += static_cast<std::size_t>(std::max<ssize_t>(more, 0));
    }
    bytes.resize(count);
    if (sha256_hex(bytes) != location.sha256) {
        throw InputError(
            {{done_path(path_), "is damaged", "a checksum is wrong", "it belongs to " + path_}});
    }
    return bytes;
}

std::optional<RunState> CheckpointFile::state_of(std::size_t time_step) {
    const auto state = states_.find(time_step);
    const auto location = locations_.find(time_step);
    if (state == states_.end() && location == locations_.end()) {
        return std::nullopt;
    }
    try {
        return load_state(
            state != states_.end() ? state->second.bytes : read_done(location->second));
    } catch (const std::invalid_argument& error) {
        refuse("is damaged or has another version", error.what());
    }
}

void CheckpointFile::save(std::size_t time_step, const RunSnapshot& state) {
    keep(time_step, {save_state(state), false});
    write();
}

void CheckpointFile::finish(std::size_t time_step, const RunSnapshot& state) {
    keep(time_step, {save_state(state), true});
    if (is_due()) {
        write();
    }
}

void CheckpointFile::flush() {
    if (!is_saved_) {
        write();
    }
}

/// Runs end in the order of their indices: the states of completed ones go to the second file.
void CheckpointFile::keep(std::size_t time_step, State state) {
    const auto location = locations_.find(time_step);
    if (state.is_done && location != locations_.end() &&
        location->second.sha256 == sha256_hex(state.bytes)) {
        return;
    }
    states_[time_step] = std::move(state);
    is_saved_ = false;
    while (states_.begin()->first < time_step && states_.begin()->second.is_done) {
        move_to_done(states_.begin()->first, states_.begin()->second.bytes);
        states_.erase(states_.begin());
    }
}

void CheckpointFile::move_to_done(std::size_t time_step, const std::string& bytes) {
    if (!done_) {
        open_done();
    }
    if (!write_at(done_->number(), bytes, done_bytes_)) {
        throw InputError(
            {{done_path(path_), "can't be written", std::generic_category().message(errno), ""}});
    }
    locations_[time_step] = {done_bytes_, bytes.size(), sha256_hex(bytes)};
    done_bytes_ += bytes.size();
}

void CheckpointFile::write() {
    // File systems without sync (EINVAL) have written the data.
    if (done_ && ::fsync(done_->number()) != 0 && errno != EINVAL) {
        throw InputError(
            {{done_path(path_), "can't be written", std::generic_category().message(errno), ""}});
    }
    std::string bytes(kFirstCheckpointLine);
    bytes += block_of(head_) + number_bytes(done_bytes_) + number_bytes(locations_.size());
    for (const auto& [time_step, location] : locations_) {
        bytes += number_bytes(time_step) + number_bytes(location.offset) +
                 number_bytes(location.size) + location.sha256;
    }
    bytes += number_bytes(states_.size());
    for (const auto& [time_step, state] : states_) {
        bytes +=
            number_bytes(time_step) + number_bytes(state.is_done ? 1 : 0) + block_of(state.bytes);
    }
    AtomicFile file(path_);
    file.write(bytes);
    file.write(sha256_hex(bytes));
    file.commit();
    is_saved_ = true;
    next_save_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(every_);
}

}  // namespace quasimc
