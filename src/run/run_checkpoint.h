#pragma once

#include <optional>

#include "run/run_state.h"
#include "run/run_view.h"

namespace quasimc {

/// The state from which a run goes on, if one was kept.
/// @param states  null: none were
/// @throws InputError  if the state is of another run, or of one that would have ended before
[[nodiscard]] std::optional<RunState> state_to_go_on_from(
    StoredStates* states, const RunFacts& facts);

}  // namespace quasimc
