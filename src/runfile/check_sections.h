#pragma once

#include "quasimc/error.h"
#include "runfile/run_sections.h"

namespace quasimc {

/// Checks the known parts of a run.
void check_with_sources(
    const Sections& sections, const Scene& scene, Faults& faults, NoLightPolicy no_light_policy);

/// Checks that options fit the times, if all of these are known.
void check_times(const Sections& sections, const Reporter& reporter, Faults& faults);

}  // namespace quasimc
