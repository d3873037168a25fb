#pragma once

#include <cstdint>
#include <functional>

#include "run/simulator.h"

namespace quasimc::test {

/// Work that a run did, in units that no load of the machine changes.
struct Work {
    double bytes = 0;    ///< allocated
    double numbers = 0;  ///< drawn from the sampler
    double rays = 0;
};

/// Counts what a round of RunSpec::paths takes, prepared scene included, in one thread.
[[nodiscard]] Work work_of(const Scene& scene, const Sources& sources, const RunSpec& spec);

/// Counts what is allocated while `work` runs; no other thread may allocate.
[[nodiscard]] double bytes_allocated_by(const std::function<void()>& work);

}  // namespace quasimc::test
