#pragma once

#include "quasimc/error.h"
#include "quasimc/run_spec.h"
#include "quasimc/source.h"
#include "scene/scene.h"
#include "solvers/ray_bundles/patch_size.h"

namespace quasimc {

/// The memory for the light of all patches up to which `auto` chooses ray bundles, for each
/// replicate in progress.
inline constexpr double kMaxBytesUnasked = 400e6;

/// Approximate memory of ray bundles in a scene: the light of the patches for each replicate in
/// progress, and data of the triangles.
/// @param bands  number of solved bands
/// @param patches  PatchSize::count
[[nodiscard]] double bytes_of_bundles(
    const Scene& scene, std::size_t bands, const RunSpec& spec, double patches);

/// Warns about the memory of ray bundles that are requested by name, if "auto" would not choose
/// them.
[[nodiscard]] std::vector<Warning> lint_bundle_memory(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const PatchSize& size);

/// Adds a fault if ray bundles take more memory than the machine has.
void check_bundle_memory(
    const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults);

}  // namespace quasimc
