#pragma once

// A part of a run's sums as a file; all parts add up to the run. Binary, in native byte
// order: docs/guide/long-runs.md.

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "files/sha256.h"
#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "quasimc/sums.h"
#include "runfile/run_file.h"

namespace quasimc {

/// "3/16": the third of sixteen parts of a run.
struct PartNumber {
    std::uint64_t part = 1, parts = 1;
};
/// @param where  location of the text, for messages
/// @throws InputError
[[nodiscard]] PartNumber read_part_number(const std::string& text, const std::string& where);

/// Writes the sums of a part, time step by time step.
class PartWriter {
  public:
    /// Writes the run's input. The SHA-256 of all previous bytes follows it, every sum and the end.
    PartWriter(const RunFile& run, const PartNumber& number, TextSink sink);
    /// @param time_step  counted through all points of a sweep, ascending
    void add(std::size_t time_step, const Sums& sums);
    void finish();

  private:
    void write(const std::string& bytes);
    void write_digest() { write(digest_.hex()); }

    TextSink sink_;
    Sha256 digest_;
};

/// Reads sums in the same order.
class PartReader {
  public:
    /// @throws InputError  if the file is not a part
    explicit PartReader(std::string path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const PartNumber& number() const { return number_; }
    /// The run's input: text for read_result_text().
    [[nodiscard]] const std::string& head() const { return head_; }
    /// The sums of a time step, which must be the next in the file.
    /// @throws InputError  if it isn't, or the file is truncated or damaged
    [[nodiscard]] Sums next(std::size_t time_step);
    /// @throws InputError  if there are more sums
    void expect_end();

  private:
    [[noreturn]] void refuse(const std::string& problem, const std::string& why) const;
    [[nodiscard]] std::string read_bytes(std::uint64_t count);
    [[nodiscard]] std::uint64_t read_number();
    [[nodiscard]] std::string read_block();
    /// @throws InputError  if the previous bytes do not match their checksum
    void check_digest();

    std::string path_;
    std::ifstream file_;
    std::uint64_t bytes_ = 0;
    Sha256 digest_;
    PartNumber number_;
    std::string head_;
};

/// The files of all parts of one run.
class PartFiles {
  public:
    /// @throws InputError  for each part that is missing, duplicate, or of another run
    explicit PartFiles(const std::vector<std::string>& paths);

    /// The run of the parts.
    [[nodiscard]] StoredSweep read_runs() const;
    /// The sums of a time step, of all parts together. Time steps in order.
    /// @throws InputError
    [[nodiscard]] Sums next(std::size_t time_step);
    /// @throws InputError  if there are sums of more time steps
    void expect_end();
    /// The part files; outputs must not overwrite them.
    [[nodiscard]] std::vector<InputFile> inputs() const;

  private:
    void check_complete() const;

    std::vector<PartReader> parts_;  // in the order of their numbers
};

}  // namespace quasimc
