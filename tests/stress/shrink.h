#pragma once

#include <functional>

#include "stress/judge.h"

namespace quasimc::stress {

/// Whether a document still has the finding.
using StillFails = std::function<bool(const Node& document)>;

/// A smaller document that still fails: tables and keys removed, lists shortened, bands merged,
/// numbers rounded, up to `most_tries` attempts.
[[nodiscard]] Node shrunk(Node document, const StillFails& still_fails, unsigned most_tries);

/// A test for one finding: the same kind between the same ways, with few seeds.
[[nodiscard]] StillFails failure_like(const Finding& finding, std::uint64_t number);

}  // namespace quasimc::stress
