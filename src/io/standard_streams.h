#pragma once

namespace quasimc {

/// Opens what the program was started without of standard input, output and error, so that no file
/// that is opened later takes their place. Nothing can be read from or written to these then. To be
/// called before anything is opened.
void open_standard_streams();

/// Whether the program was started with a standard output.
[[nodiscard]] bool has_standard_output();

}  // namespace quasimc
