#pragma once

// What parts and checkpoints have at their beginning, and how numbers stand in them.

#include <cstdint>
#include <string>

#include "runfile/run_file.h"

namespace quasimc {

/// What a run is made from: text that read_result_text() takes.
[[nodiscard]] std::string head_of_run(const RunFile& run);

/// Its 8 bytes, in the order of this machine.
[[nodiscard]] std::string number_bytes(std::uint64_t number);

}  // namespace quasimc
