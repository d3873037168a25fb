// Searches the multipliers of src/samplers/korobov_table.h and prints its rows.
//
//     quasimc_samplers_search_korobov [first m] [last m]
//
// For each n = 2^m, in two steps:
//   1. Candidates are a = 5 mod 8, whose powers have the longest period, n / 4: all up to m = 23,
//      2^20 random ones beyond. Among those with enough good dimensions, the 128 of greatest
//      spectral figure are kept, but none below 0.8 times the greatest. The figure is the minimum
//      of korobov_merit and of the merits of the coordinates that a path uses together, paths(),
//      times a weight.
//   2. Of these, the one with the smallest geometric mean of P_2 over paths(). Beyond m = 22, the
//      one of greatest figure.
// After each row: korobov_merit, and the merits of coordinates (0, 1) and (0, 1, 2, 3). Some
// minutes for all m; the same rows on every machine.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "lattice_merit.h"
#include "samplers/hash.h"
#include "samplers/korobov_table.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kCandidates = std::uint64_t{1} << 20;
constexpr std::size_t kKept = 128;
constexpr double kSlack = 0.8;
constexpr int kLargestCounted = 22;

/// Coordinates that paths use together: two for the start, two for each direction; and the weight
/// of their merits.
struct Projection {
    std::vector<std::uint32_t> coordinates;
    double weight;
};
std::vector<Projection> paths() {
    return {{{0, 1}, 0.4},       {{0, 1, 2, 3}, 0.4},        {{0, 1, 4, 5}, 0.4},
            {{0, 1, 6, 7}, 0.4}, {{0, 1, 2, 3, 4, 5}, 0.45}, {{0, 1, 2, 3, 4, 5, 6, 7}, 0.45}};
}

struct Candidate {
    std::uint64_t multiplier;
    double figure;
};

/// The required number of good dimensions. Few points can't have many: the pair at lag 2^r has the
/// dual vector 2^(m - r - 2) (1, -1).
std::uint32_t wanted_dimensions(int m) {
    if (m < 6)
        return m < 3 ? 1U : 1U << (m - 2);
    return m < 11 ? 16U : m < 16 ? 32U : 64U;
}

/// The figure of the path coordinates; stops when it is not above `floor`.
double path_figure(
    const std::vector<Projection>& paths, std::uint64_t n, std::uint64_t a, double floor) {
    std::array<std::uint64_t, 8> powers{1};
    for (std::size_t i = 1; i < powers.size(); ++i)
        powers[i] = powers[i - 1] * a;
    double figure = 1;
    for (const Projection& path : paths) {
        std::vector<std::uint64_t> z;
        for (const std::uint32_t coordinate : path.coordinates)
            z.push_back(powers[coordinate]);
        figure = std::min(figure, path.weight * spectral_merit(n, z));
        if (figure <= floor)
            break;
    }
    return figure;
}

/// The candidates of greatest figure, best first.
std::vector<Candidate> best_candidates(int m) {
    const std::uint64_t n = std::uint64_t{1} << m;
    const std::uint64_t all = std::max<std::uint64_t>(n / 8, 1);
    const std::uint32_t wanted = wanted_dimensions(m);
    const auto better = [](const Candidate& a, const Candidate& b) { return a.figure > b.figure; };
    const std::vector<Projection> projections = paths();
    std::vector<Candidate> best;
    for (std::uint64_t i = 0; i < std::min(all, kCandidates); ++i) {
        const std::uint64_t a = 8 * (all <= kCandidates ? i : mix64(i + (all << 8)) % all) + 5;
        const double floor = best.size() < kKept ? (best.empty() ? 0 : kSlack * best.front().figure)
                                                 : best.back().figure;
        const double start = path_figure(projections, n, a, floor);
        if (start <= floor)
            continue;
        const Candidate found{a, std::min(start, korobov_merit(n, a, wanted, floor))};
        if (found.figure <= floor || korobov_dimensions(n, a) < wanted)
            continue;
        best.insert(std::upper_bound(best.begin(), best.end(), found, better), found);
        while (best.size() > kKept || best.back().figure < kSlack * best.front().figure)
            best.pop_back();
    }
    return best;
}

/// Mean log of P_2 over paths(): the worst variance, under a random shift, of integrands whose
/// Fourier coefficients are at most 1 / (h_1 ... h_s). With 3 B_2(x) for each coordinate: all
/// subsets of a projection count.
double mean_log_p2(int m, std::uint64_t a) {
    const std::uint64_t n = std::uint64_t{1} << m;
    const std::vector<Projection> projections = paths();
    std::vector<double> sums(projections.size());
    std::array<double, 8> factor{};
    for (std::uint64_t i = 0; i < n; ++i) {
        std::uint64_t position = i;
        for (double& f : factor) {
            const double x = static_cast<double>(position % n) / static_cast<double>(n);
            f = 1 + 3 * (x * x - x + 1.0 / 6);
            position *= a;
        }
        for (std::size_t path = 0; path < projections.size(); ++path) {
            double product = 1;
            for (const std::uint32_t coordinate : projections[path].coordinates)
                product *= factor[coordinate];
            sums[path] += product;
        }
    }
    double total = 0;
    for (const double sum : sums)
        total += std::log(sum / static_cast<double>(n) - 1);
    return total / static_cast<double>(sums.size());
}

std::uint64_t chosen(int m, const std::vector<Candidate>& best) {
    if (m > kLargestCounted)
        return best.front().multiplier;
    std::uint64_t least = 0;
    double least_p2 = HUGE_VAL;
    for (const Candidate& candidate : best) {
        const double p2 = mean_log_p2(m, candidate.multiplier);
        if (p2 < least_p2) {
            least_p2 = p2;
            least = candidate.multiplier;
        }
    }
    return least;
}

void print_row(int m) {
    const std::vector<Candidate> best = best_candidates(m);
    if (best.empty()) {
        std::printf("no lattice of 2^%d points has enough good dimensions\n", m);
        return;
    }
    const std::uint64_t n = std::uint64_t{1} << m;
    const std::uint64_t a = chosen(m, best);
    const std::uint32_t dimensions = korobov_dimensions(n, a);
    std::printf(
        "    {%lluU, %u},  // 2^%d: %.2f %.2f %.2f\n", static_cast<unsigned long long>(a),
        dimensions, m, korobov_merit(n, a, dimensions), korobov_serial_merit(n, a, 2),
        korobov_serial_merit(n, a, 4));
    std::fflush(stdout);
}

}  // namespace
}  // namespace quasimc

int main(int argc, char** argv) {
    const int first = argc > 1 ? std::atoi(argv[1]) : 0;
    const int last = argc > 2 ? std::atoi(argv[2]) : quasimc::kMaxKorobovLog2;
    for (int m = std::max(first, 0); m <= std::min(last, quasimc::kMaxKorobovLog2); ++m)
        quasimc::print_row(m);
    return 0;
}
