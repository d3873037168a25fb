#pragma once

#include <string_view>
#include <vector>

#include "quasimc/run.h"
#include "scene/scene.h"

// The scenes whose results are held bit by bit. Only cases.cpp knows how scenes are made.

namespace quasimc::test {

/// A whole run, but for the way of tracing, the seed and the threads.
struct Case {
    Scene scene;
    Sources sources;
    RunSpec spec;
    /// The light of a near lamp depends on the last digit of where a ray hits. Embree finds that
    /// digit by approximations of its own on each vector unit; those of AVX2 and AVX-512 differ.
    bool digests_need_avx512 = false;
};

/// One row of the table of cases.
struct CaseEntry {
    std::string_view name;
    Case (*make)();
};

/// Twelve cases which together use every sampler, every kind of source, every lobe model, open and
/// periodic scenes and every option of a run that changes results. Each can be traced in every way,
/// but for ray bundles where surfaces shine.
[[nodiscard]] const std::vector<CaseEntry>& all_cases();

}  // namespace quasimc::test
