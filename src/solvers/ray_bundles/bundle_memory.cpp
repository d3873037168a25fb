#include "solvers/ray_bundles/bundle_memory.h"

#include <algorithm>
#include <limits>

#ifdef __linux__
#include <sys/sysinfo.h>
#endif

#include <fmt/format.h>

#include "base/parallel.h"
#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/patch_light.h"
#include "solvers/ray_bundles/solved_bands.h"

namespace quasimc {
namespace {

unsigned replicates_at_work(const RunSpec& spec) {
    return std::min(thread_count(spec.threads), static_cast<unsigned>(spec.replicates));
}

/// Infinite if unknown.
double bytes_of_machine() {
#ifdef __linux__
    struct sysinfo machine {};
    if (::sysinfo(&machine) == 0) {
        return static_cast<double>(machine.totalram) * static_cast<double>(machine.mem_unit);
    }
#endif
    return std::numeric_limits<double>::infinity();
}

std::string gigabytes(double bytes) {
    constexpr double kBytesOfGigabyte = 1e9;
    return fmt::format("{:.1f} GB", bytes / kBytesOfGigabyte);
}

}  // namespace

double bytes_of_bundles(
    const Scene& scene, std::size_t bands, const RunSpec& spec, double patches) {
    constexpr double kBytesOfTriangle = 270;
    return bytes_of_patch_light(patches, bands) * replicates_at_work(spec) +
           kBytesOfTriangle * static_cast<double>(scene.triangle_count());
}

std::vector<Warning> lint_bundle_memory(
    const Scene& scene, const Sources& sources, const RunSpec& spec, const PatchSize& size) {
    const std::size_t bands = count_solved_bands(scene, sources, spec.origins);
    if (bytes_of_patch_light(size.count, bands) <= kMaxBytesUnasked) {
        return {};
    }
    return {
        {"scene", fmt::format(
                      "ray_bundles needs about {} of memory for {:.0f} patches and {} simultaneous "
                      "replicates; fewer threads need less, and method = \"first_hits\" much less",
                      gigabytes(bytes_of_bundles(scene, bands, spec, size.count)), size.count,
                      replicates_at_work(spec))}};
}

void check_bundle_memory(
    const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults) {
    constexpr double kMinPatchesOfTriangle = 4;
    const double patches = std::max(
        patches_for(spec.paths),
        kMinPatchesOfTriangle * static_cast<double>(scene.triangle_count()));
    const double bytes =
        bytes_of_bundles(scene, count_solved_bands(scene, sources, spec.origins), spec, patches);
    const double all = bytes_of_machine();
    if (bytes > all) {
        faults.add(
            {"method",
             fmt::format(
                 "ray_bundles needs about {} of memory for {:.0f} patches and {} simultaneous "
                 "replicates",
                 gigabytes(bytes), patches, replicates_at_work(spec)),
             "the machine has " + gigabytes(all), "use fewer threads, or method = \"first_hits\""});
    }
}

}  // namespace quasimc
