#pragma once

#include "quasimc/error.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "solvers/ray_bundles/patch_size.h"

namespace quasimc {

/// Beyond this the light of all patches takes more memory than is spent unasked, for each replicate
/// at work.
inline constexpr double kMaxBytesUnasked = 400e6;

/// Memory that ray bundles take in a scene, about: the light of the patches for each replicate at
/// work, and what is known of the triangles.
/// @param patches  PatchSize::count
[[nodiscard]] double bytes_of_bundles(const Scene& scene, const RunSpec& spec, double patches);

/// Says what ray bundles that are asked for by name take, where "auto" would not take them.
[[nodiscard]] std::vector<Warning> lint_bundle_memory(
    const Scene& scene, const RunSpec& spec, const PatchSize& size);

/// Adds a fault if ray bundles take more memory than the machine has.
void check_bundle_memory(const Scene& scene, const RunSpec& spec, Faults& faults);

}  // namespace quasimc
