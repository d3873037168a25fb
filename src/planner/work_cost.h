#pragma once

#include "quasimc/sums.h"
#include "scene/scene.h"
#include "sums/work_unit.h"

namespace quasimc {

/// The cost of a unit of work on a common machine, ns; of a ray, for each halving of the triangles.
[[nodiscard]] double nanoseconds_of(WorkUnit unit);

/// The processor time of the work of all replicates counted in one unit of this cost, s.
[[nodiscard]] double seconds_of_unit(
    const Sums& sums, const Scene& scene, WorkUnit unit, double nanoseconds);

/// The processor time of the work of all replicates on a common machine, s. The same on every
/// machine.
[[nodiscard]] double seconds_of_work(const Sums& sums, const Scene& scene);

}  // namespace quasimc
