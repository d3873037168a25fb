#pragma once

// The beginning of parts and checkpoints, and the format of their numbers.

#include <cstdint>
#include <string>

#include "runfile/run_file.h"

namespace quasimc {

/// The run's input: text for read_result_text().
[[nodiscard]] std::string head_of_run(const RunFile& run);

/// The 8 bytes of a number, in native byte order.
[[nodiscard]] std::string number_bytes(std::uint64_t number);

}  // namespace quasimc
