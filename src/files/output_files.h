#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/atomic_file.h"
#include "quasimc/error.h"

namespace quasimc {

/// A file to be written.
struct OutputPath {
    std::string path;   ///< "-" is standard output
    std::string where;  ///< option or key that names it, for messages: "--csv"
};

/// The output files of one run. They are opened together, so that errors are reported before the
/// computation, and get their names together at the end. An output that can't be written (full
/// disk, pipe without a reader) is abandoned without affecting the others. Standard output whose
/// reader has ended is abandoned without a fault; ReaderGone is thrown if no other output is left.
class OutputFiles {
  public:
    /// @param inputs  files that were read; no output may be one of them
    /// @throws InputError  if an output can't be written, is an input, or is another output
    OutputFiles(std::vector<OutputPath> outputs, std::span<const InputFile> inputs);

    /// The sink of an output. Throws if no output is left.
    [[nodiscard]] TextSink sink(std::size_t output);
    /// Abandons an output. Throws if none is left.
    void give_up(std::size_t output, const InputError& error);
    /// Flushes all outputs to the disk, then gives them their names in order.
    void commit();

    /// The paths of the files that were written, as given.
    [[nodiscard]] std::vector<std::string> written() const;
    [[nodiscard]] bool uses_standard_output() const { return uses_standard_output_; }
    /// Reasons of abandoned outputs.
    [[nodiscard]] const Faults& faults() const { return faults_; }
    /// Whether all outputs, at least one, were abandoned.
    [[nodiscard]] bool are_all_given_up() const;
    /// @throws InputError  if outputs were abandoned, with the reasons
    void throw_if_given_up() const { faults_.throw_if_any(); }

  private:
    void throw_if_none_is_left() const;
    /// Applies the action to an output, unless it was abandoned.
    template <typename Action>
    void attempt(std::size_t output, Action action);

    std::vector<OutputPath> outputs_;
    std::vector<std::unique_ptr<AtomicFile>> files_;  // by output; null if abandoned
    Faults faults_;
    bool uses_standard_output_ = false;
};

}  // namespace quasimc
