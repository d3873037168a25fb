// Compares every method with plain Monte Carlo light tracing, organ by organ, on stands of many
// kinds: at a level of 1e-6 for all comparisons together (Sidak 1967).

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "parts.h"
#include "quasimc/result.h"
#include "stands.h"
#include "sums/statistics.h"
#include "ways.h"

namespace quasimc::bench {
namespace {

/// All methods except the reference.
constexpr std::span<const Way> kCompared = std::span(kWays).subspan(1);

constexpr std::uint32_t kReplicates = 32;
constexpr double kLevel = 1e-6;
/// Light with a relative standard error above this, from fewer than a hundred paths, has no normal
/// errors: it counts for chi only.
constexpr double kKnown = .1;

bool is_known(const Estimate& e) {
    return e.standard_error <= kKnown * e.mean;
}

Result trace(const Scene& scene, const Way& way, std::uint64_t paths) {
    RunSpec spec;
    spec.method = way.from;
    spec.sampler = way.sampler;
    spec.paths = paths;
    spec.replicates = kReplicates;
    spec.seed = 11 + static_cast<std::uint64_t>(way.from);
    return run(scene, light_of_stands(), spec);
}

struct Comparison {
    std::vector<double> differences;  ///< in standard errors
    std::vector<double> errors;       ///< standard errors, relative to the mean light
};

/// Compares the light on one side of the organs in one band.
void compare_sides(
    const Result& plain, const Result& other, Quantity q, std::size_t band, Comparison& all) {
    const std::size_t first = all.errors.size();
    double light = 0;
    for (std::size_t i = 0; i < plain.organs(); ++i) {
        const Estimate& a = plain.at(i, q, band);
        const Estimate& b = other.at(i, q, band);
        const double error = std::hypot(a.standard_error, b.standard_error);
        if (is_known(a) && is_known(b) && error > 0) {
            all.differences.push_back(std::abs(a.mean - b.mean) / error);
            all.errors.push_back(error);
            light += a.mean;
        }
    }
    const auto count = static_cast<double>(all.errors.size() - first);
    for (std::size_t i = first; i < all.errors.size(); ++i) {
        all.errors[i] *= count / light;
    }
}

Comparison compare(const Result& plain, const Result& other) {
    Comparison comparison;
    for (std::size_t band = 0; band < plain.bands; ++band) {
        for (const Quantity q : {Quantity::incident_upper, Quantity::incident_lower}) {
            compare_sides(plain, other, q, band, comparison);
        }
    }
    return comparison;
}

double nine_in_ten(std::vector<double> values) {
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

void print_stand(StandKind kind, const Effort& effort) {
    constexpr std::uint32_t kLeaves = 200;
    const Scene scene = make_stand(kind, kLeaves);
    const Way& plain_way = kWays.front();
    const Result plain = trace(scene, plain_way, effort.plain_paths / kReplicates);
    std::printf(
        "\n%s: %zu organs, %zu triangles; plain tracing took %.0f s\n", name_of(kind).c_str(),
        scene.organs().size(), scene.triangle_count(), plain.solve_seconds);
    std::printf(
        "  %-16s %11s %14s %8s %10s %6s %14s %11s\n", "from, sampler", "comparisons",
        "largest diff.", "limit", "resolution", "chi", "totals differ", "resolution");
    const std::uint64_t paths = std::bit_ceil(effort.plain_paths / kReplicates / 32 + 1);
    for (const Way& way : kCompared) {
        const Result other = trace(scene, way, paths);
        const Comparison organs = compare(plain, other);
        const double family =
            static_cast<double>(organs.differences.size() * kCompared.size() * kStandKinds.size());
        const double limit = student_t_quantile(1 - kLevel / family / 2, kReplicates - 1);
        const double largest =
            *std::max_element(organs.differences.begin(), organs.differences.end());
        const Audit audit = compare_results(scene, other, plain);
        double total = 0;
        double total_error = 0;
        double reduced_chi_square = 0;
        for (std::size_t b = 0; b < plain.bands; ++b) {
            const BandAudit& band = audit.bands[b];
            total = std::max(total, std::abs(band.difference) / band.standard_error);
            total_error = std::max(
                total_error, limit * band.standard_error / plain.budget[b].absorbed_by_organs.mean);
            reduced_chi_square = std::max(reduced_chi_square, band.reduced_chi_square);
        }
        std::printf(
            "  %-16s %11zu %11.2f se %5.2f se %8.2f %% %6.2f %11.2f se %9.4f %%  %s\n", way.name,
            organs.differences.size(), largest, limit, 100 * limit * nine_in_ten(organs.errors),
            reduced_chi_square, total, 100 * total_error,
            largest <= limit && total <= limit ? "agrees" : "DISAGREES");
        std::fflush(stdout);
    }
}

}  // namespace

void print_agreement(const Effort& effort) {
    std::printf(
        "\n== Agreement with %.3g paths of plain Monte Carlo tracing, %u replicates: light on each "
        "side of every organ, two bands. se: standard errors of the difference. Resolution: the "
        "limit, relative to the mean light on a side (nine in ten are sharper) or to the total\n",
        static_cast<double>(effort.plain_paths), kReplicates);
    for (const StandKind kind : kStandKinds) {
        print_stand(kind, effort);
    }
}

}  // namespace quasimc::bench
