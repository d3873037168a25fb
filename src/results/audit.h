#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quasimc {

class Scene;
struct Result;

/// A right result fails an audit with at most this probability.
inline constexpr double kAuditLevel = 1e-4;

/// What two results say of each other in one band.
struct BandAudit {
    /// sum of w (a - b)^2 / sum of w (var a + var b) over the sides of all organs that both know,
    /// of the light that falls on them, w the organ's area; about 1 if both are right.
    double reduced_chi_square = 1;
    double freedom = 0;     ///< effective number of independent sides
    double chi_chance = 1;  ///< probability of a larger chi if both are right
    /// Light that all organs absorb (ground left out), first less second result: flux. NaN if
    /// not all organs are measured.
    double difference = 0, standard_error = 0;
    double difference_chance = 1;  ///< probability of a larger one, of either sign
};

/// A result compared with that of an independent run: docs/theory/audit.md.
struct Audit {
    std::uint64_t paths = 0;  ///< of the independent run, per replicate
    std::uint32_t replicates = 0;
    std::vector<BandAudit> bands;
    double chance = 1;  ///< of the most unlikely number, times how many there are; at most 1

    [[nodiscard]] bool agrees() const { return chance >= kAuditLevel; }
};

/// Compares the results of two independent runs of a scene, of at least two replicates each.
[[nodiscard]] Audit compare_results(const Scene& scene, const Result& a, const Result& b);

}  // namespace quasimc
