#pragma once

#include "coupling/protocol/messages.h"

namespace quasimc {

/// Removes the values that lpfg writes after the parameters of the following module.
///
/// lpfg takes the size of a module's whole structure for the size of its parameters, so that two
/// values follow the real ones, and one where there are none; they are arbitrary memory. It is
/// recognized by how it writes numbers: %f, always six decimals, which cpfg's %g never does. An
/// lpfg with that fault sends no module with exactly two values; one that does has been corrected,
/// and nothing is removed from then on.
class TrailingValues {
  public:
    /// Takes the surplus values from the queries of a pass.
    /// @param style  of the numbers in the session so far
    void remove(Pass& pass, NumberStyle style);

  private:
    bool is_mended_ = false;
};

}  // namespace quasimc
