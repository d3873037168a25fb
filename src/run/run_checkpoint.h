#pragma once

#include <optional>

#include "run/run_state.h"
#include "run/run_view.h"

namespace quasimc {

/// The state from which a run resumes, if one is stored.
/// @param states  null: none are stored
/// @throws InputError  if the state belongs to another run, or to one that would have ended earlier
[[nodiscard]] std::optional<RunState> state_to_go_on_from(
    StoredStates* states, const RunFacts& facts);

}  // namespace quasimc
