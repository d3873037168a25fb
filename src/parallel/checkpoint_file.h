#pragma once

// The states of the runs of a file while it is computed: docs/guide/long-runs.md. Binary, of
// one byte order.
//
// The file itself has what the runs are made from, the state of the run at hand, and which part of
// a second file (its name and ".done") belongs to it: the states of the runs that were done before
// that one. The first is written anew each time, to another name that replaces it; the second only
// grows. Both have checksums.

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

/// Takes numbers and texts out of bytes, in order.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
    /// Nothing, from then on, once there are too few bytes.
    [[nodiscard]] std::string_view take(std::uint64_t count);
    [[nodiscard]] std::uint64_t number();
    [[nodiscard]] std::string_view block() { return take(number()); }
    /// Whether all was taken, and nothing missed.
    [[nodiscard]] bool is_at_end() const { return rest_.empty() && !is_cut_off_; }
    [[nodiscard]] bool is_cut_off() const { return is_cut_off_; }

  private:
    std::string_view rest_;
    bool is_cut_off_ = false;
};

/// Whether a run goes on from the checkpoint that is there.
enum class CheckpointStart {
    anew,    ///< it must not be there
    resume,  ///< as far as it is there
};

/// Keeps the states of the runs of a run file; each is known by its number, counted through the
/// points of a sweep and their times.
class CheckpointFile {
  public:
    /// @param path  of the file, or of a symbolic link to it
    /// @param every  seconds from the end of one save to the next
    /// @throws InputError  if the file is damaged, of another run, in use by another process, or
    ///         there though the run begins anew
    CheckpointFile(
        const std::string& path, const RunFile& run, double every, CheckpointStart start);

    /// Whether there was one to go on from.
    [[nodiscard]] bool was_there() const { return was_there_; }
    [[nodiscard]] std::optional<RunState> state_of(std::size_t time_step);
    [[nodiscard]] bool has_state(std::size_t time_step) const {
        return states_.contains(time_step) || locations_.contains(time_step);
    }
    /// Whether it is time to save.
    [[nodiscard]] bool is_due() const { return Clock::now() >= next_save_; }
    /// Saves the state of a run on the way.
    void save(std::size_t time_step, const RunSnapshot& state);
    /// Takes note of the state of a run that is done; saves it when it is time, or in flush().
    void finish(std::size_t time_step, const RunSnapshot& state);
    /// Saves what was not saved yet.
    void flush();

  private:
    using Clock = std::chrono::steady_clock;
    struct Location {  ///< in the second file
        std::uint64_t offset = 0, size = 0;
        std::string sha256;
    };
    struct State {
        std::string bytes;
        bool is_done = false;
    };

    [[noreturn]] void refuse(const std::string& problem, const std::string& why) const;
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
    std::map<std::size_t, Location> locations_;  // of runs that are done
    /// Of the run at hand, and when a run goes on of two.
    std::map<std::size_t, State> states_;
    std::uint64_t done_bytes_ = 0;
    std::unique_ptr<Descriptor> done_;  // the second file, once there is one
    bool is_saved_ = false;
    Clock::time_point next_save_;
};

}  // namespace quasimc
