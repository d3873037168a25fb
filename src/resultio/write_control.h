#pragma once

#include <memory>

#include "quasimc/result_file.h"
#include "resultio/output_input.h"

namespace quasimc {

/// Makes the writer of OutputInput::table with rows of controls.
[[nodiscard]] std::unique_ptr<OutputWriter> make_control_table(const OutputInput& input);

}  // namespace quasimc
