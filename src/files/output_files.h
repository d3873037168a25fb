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

/// A file that is to be written.
struct OutputPath {
    std::string path;   ///< "-" is standard output
    std::string where;  ///< who names it, for messages: "--csv"
};

/// The files that one run writes. They are opened together, so that a wrong one is told before
/// anything is computed, and get their names together at the end. One that can't be written any
/// more (a full disk, a pipe that nobody reads) is given up, and the others are written all the
/// same. Standard output whose reader has ended is given up without a fault; ReaderGone is thrown
/// if no other output is left.
class OutputFiles {
  public:
    /// @param inputs  the files that were read, which no output may be
    /// @throws InputError  if an output can't be written, is an input, or is another output
    OutputFiles(std::vector<OutputPath> outputs, std::span<const InputFile> inputs);

    /// Takes the text of an output. Throws once no output is left to be written.
    [[nodiscard]] TextSink sink(std::size_t output);
    /// Gives an output up. Throws if none is left to be written.
    void give_up(std::size_t output, const InputError& error);
    /// Brings all outputs to the disk, and then gives them their names, in their order, one
    /// straight after the other.
    void commit();

    /// The outputs that are files and were not given up, as stated.
    [[nodiscard]] std::vector<std::string> written() const;
    [[nodiscard]] bool uses_standard_output() const { return uses_standard_output_; }
    /// Why outputs were given up.
    [[nodiscard]] const Faults& faults() const { return faults_; }
    /// Whether there are outputs, but none is left.
    [[nodiscard]] bool are_all_given_up() const;
    /// @throws InputError  if outputs were given up, with the reasons
    void throw_if_given_up() const { faults_.throw_if_any(); }

  private:
    void throw_if_none_is_left() const;
    /// Does it with an output that is left.
    template <typename Action>
    void attempt(std::size_t output, Action action);

    std::vector<OutputPath> outputs_;
    std::vector<std::unique_ptr<AtomicFile>> files_;  // of outputs; none of those given up
    Faults faults_;
    bool uses_standard_output_ = false;
};

}  // namespace quasimc
