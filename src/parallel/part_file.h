#pragma once

// A part of a run's sums as a file, which other parts are put together with. Binary, of one byte
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

/// Writes the sums of a part, moment by moment.
class PartWriter {
  public:
    /// Writes what the run is made from. Behind it, every sum and the end stands the SHA-256 of all
    /// bytes before.
    PartWriter(const RunFile& run, const PartNumber& number, TextSink sink);
    /// @param moment  counted through all points of a sweep, ascending
    void add(std::size_t time_step, const Sums& sums);
    void finish();

  private:
    void write(const std::string& bytes);
    void write_digest() { write(digest_.hex()); }

    TextSink sink_;
    Sha256 digest_;
};

/// Reads them, in the same order.
class PartReader {
  public:
    /// @throws InputError  if it is no such file
    explicit PartReader(std::string path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const PartNumber& number() const { return number_; }
    /// What the run was made from: text that read_result_text() takes.
    [[nodiscard]] const std::string& head() const { return head_; }
    /// The sums of a moment, which must be the next there.
    /// @throws InputError  if it isn't, or the file is cut off or damaged
    [[nodiscard]] Sums next(std::size_t time_step);
    /// @throws InputError  if there are more
    void expect_end();

  private:
    [[noreturn]] void refuse(const std::string& problem, const std::string& why) const;
    [[nodiscard]] std::string read_bytes(std::uint64_t count);
    [[nodiscard]] std::uint64_t read_number();
    [[nodiscard]] std::string read_block();
    /// @throws InputError  if the bytes before are not those that were written
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
    /// @throws InputError  if some part is missing, there twice, or of another run: each of them
    explicit PartFiles(const std::vector<std::string>& paths);

    /// The run that they are parts of.
    [[nodiscard]] StoredSweep read_runs() const;
    /// The sums of a moment, of all parts together. Moments in their order.
    /// @throws InputError
    [[nodiscard]] Sums next(std::size_t time_step);
    /// @throws InputError  if there are sums of more moments
    void expect_end();
    /// The files themselves, which no output may be.
    [[nodiscard]] std::vector<InputFile> inputs() const;

  private:
    void check_complete() const;

    std::vector<PartReader> parts_;  // in the order of their numbers
};

}  // namespace quasimc
