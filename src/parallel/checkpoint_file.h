#pragma once

// The states of the runs of a file while it is computed: docs/guide/long-runs.md. Binary, in
// native byte order.
//
// The file contains the run's input, the state of the current run, and which part of a second file
// (its name plus ".done") belongs to it: the states of the completed runs. The first is replaced
// atomically each time; the second only grows. Both have checksums.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "files/descriptor.h"
#include "files/file_lock.h"
#include "run/run_state.h"
#include "runfile/run_file.h"

namespace quasimc {

/// Reads numbers and texts from bytes, in order.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
    /// Empty from the first time that too few bytes are left.
    [[nodiscard]] std::string_view take(std::uint64_t count);
    [[nodiscard]] std::uint64_t number();
    [[nodiscard]] std::string_view block() { return take(number()); }
    /// Whether all bytes were read, without errors.
    [[nodiscard]] bool is_at_end() const { return rest_.empty() && !is_cut_off_; }
    [[nodiscard]] bool is_cut_off() const { return is_cut_off_; }

  private:
    std::string_view rest_;
    bool is_cut_off_ = false;
};

/// Whether a run resumes from an existing checkpoint.
enum class CheckpointStart {
    anew,    ///< no checkpoint may exist
    resume,  ///< from its state, if it exists
};

/// Stores the states of the runs of a run file; each has an index, counted through the points of a
/// sweep and their time steps.
class CheckpointFile {
  public:
    /// @param path  of the file, or of a symbolic link to it
    /// @param every  seconds from the end of one save to the next
    /// @throws InputError  if the file is damaged, belongs to another run, is in use by another
    /// process, or exists though the run begins anew
    CheckpointFile(
        const std::string& path, const RunFile& run, double every, CheckpointStart start);

    /// Whether a checkpoint existed.
    [[nodiscard]] bool was_there() const { return was_there_; }
    [[nodiscard]] std::optional<RunState> state_of(std::size_t time_step);
    [[nodiscard]] bool has_state(std::size_t time_step) const {
        return states_.contains(time_step) || locations_.contains(time_step);
    }
    /// Whether a save is due.
    [[nodiscard]] bool is_due() const { return Clock::now() >= next_save_; }
    /// Saves the state of an incomplete run.
    void save(std::size_t time_step, const RunSnapshot& state);
    /// Records the state of a completed run; saves it when a save is due, or in flush().
    void finish(std::size_t time_step, const RunSnapshot& state);
    /// Saves all unsaved states.
    void flush();

  private:
    using Clock = std::chrono::steady_clock;
    struct Location {  ///< position in the second file
        std::uint64_t offset = 0, size = 0;
        std::string sha256;
    };
    struct State {
        std::string bytes;
        bool is_done = false;
    };

    [[noreturn]] void refuse(const std::string& problem, const std::string& why) const;
    void refuse_if_no_checkpoint(std::string_view bytes) const;
    void read();
    void read_locations(ByteReader& reader);
    void open_done();
    [[nodiscard]] std::string read_done(const Location& location) const;
    void move_to_done(std::size_t time_step, const std::string& bytes);
    void keep(std::size_t time_step, State state);
    void write();

    std::string path_;
    FileLock lock_;
    std::string head_;
    std::chrono::duration<double> every_;
    bool was_there_ = false;
    std::map<std::size_t, Location> locations_;  // of completed runs
    /// State of the current run; between two runs also of the last one.
    std::map<std::size_t, State> states_;
    std::uint64_t done_bytes_ = 0;
    std::unique_ptr<Descriptor> done_;  // the second file, once it exists
    bool is_saved_ = false;
    Clock::time_point next_save_;
};

}  // namespace quasimc
