#pragma once

#include <exception>

namespace quasimc {

/// Thrown when standard output is a pipe whose reader has ended, for example `head`. It is no input
/// error, but nothing more can be written.
class ReaderGone : public std::exception {
  public:
    [[nodiscard]] const char* what() const noexcept override {
        return "standard output: can't be written (its reader is gone)";
    }
};

/// Opens those of standard input, output and error that are closed, so that no file opened later
/// gets their descriptors. Reading and writing them fails. Must be called before any file is
/// opened.
void open_standard_streams();

/// Whether the program was started with a standard output.
[[nodiscard]] bool has_standard_output();

/// Whether standard output is a pipe or a socket whose reader has ended.
[[nodiscard]] bool is_reader_gone();

}  // namespace quasimc
