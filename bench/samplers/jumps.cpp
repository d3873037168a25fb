// Variance of each sampler relative to Monte Carlo on discontinuous functions, like light at the
// edges of leaves.
//
//     quasimc_samplers_jumps [log2 of the number of points]
//
// Thirty functions for each set of coordinates: random half-spaces, boxes and balls, each 1 inside
// and 0 outside. Prints p (1 - p) / n over the variance among replicates: geometric mean and, in
// brackets, the minimum of the thirty. The coordinates are the start of a path with one or two of
// its directions.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "samplers/catalogue.h"
#include "samplers/monte_carlo.h"

namespace quasimc {
namespace {

constexpr int kFunctions = 30;
constexpr std::uint32_t kReplicates = 48;

using Coordinates = std::vector<std::uint32_t>;
using Points = std::vector<std::vector<double>>;  // [coordinate][point]

/// Random numbers for functions.
class Draws {
  public:
    double uniform() { return random_number({.seed = 77}, next_++, 0); }
    double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(6.283185307179586 * uniform());
    }

  private:
    std::uint64_t next_ = 0;
};

enum class Shape { half_space, box, ball };

struct Jump {
    Shape shape;
    std::vector<double> position;  ///< normal of the half-space, else centre
    double size;

    double operator()(const Points& x, std::size_t point) const {
        double sum = 0;
        double greatest = 0;
        for (std::size_t k = 0; k < position.size(); ++k) {
            const double distance = x[k][point] - position[k];
            sum += shape == Shape::half_space ? position[k] * (x[k][point] - 0.5)
                                              : distance * distance;
            greatest = std::max(greatest, std::min(std::abs(distance), 1 - std::abs(distance)));
        }
        switch (shape) {
            case Shape::half_space:
                return sum < size ? 1 : 0;
            case Shape::box:
                return greatest < size ? 1 : 0;
            case Shape::ball:
                return sum < size * size ? 1 : 0;
        }
        return 0;
    }
};

std::vector<Jump> draw_jumps(std::size_t order) {
    Draws draws;
    const auto s = static_cast<double>(order);
    std::vector<Jump> jumps;
    for (int i = 0; i < kFunctions; ++i) {
        Jump jump{.shape = static_cast<Shape>(i % 3), .position = {}, .size = 0};
        for (std::size_t k = 0; k < order; ++k)
            jump.position.push_back(
                jump.shape == Shape::half_space ? draws.normal() : draws.uniform());
        if (jump.shape == Shape::half_space)
            jump.size = 0.3 * draws.normal();
        else if (jump.shape == Shape::box)
            jump.size = 0.5 * std::pow(0.1 + 0.3 * draws.uniform(), 1 / s);
        else
            jump.size = 0.22 * std::sqrt(s) * (0.8 + 0.5 * draws.uniform());
        jumps.push_back(jump);
    }
    return jumps;
}

struct Gains {
    double mean, least;
};

Gains gains(const Sampler& sampler, const Coordinates& coordinates, std::uint64_t n) {
    const std::vector<Jump> jumps = draw_jumps(coordinates.size());
    std::vector<double> sums(jumps.size());
    std::vector<double> squares(jumps.size());
    Points x(coordinates.size(), std::vector<double>(n));
    for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
        const Stream stream{.seed = 3, .replicate = replicate, .count = n};
        for (std::size_t k = 0; k < coordinates.size(); ++k)
            sampler.coordinates(stream, 0, coordinates[k], x[k]);
        for (std::size_t i = 0; i < jumps.size(); ++i) {
            double sum = 0;
            for (std::uint64_t point = 0; point < n; ++point)
                sum += jumps[i](x, point);
            sums[i] += sum / static_cast<double>(n);
            squares[i] += std::pow(sum / static_cast<double>(n), 2);
        }
    }
    Gains result{0, HUGE_VAL};
    int counted = 0;
    for (std::size_t i = 0; i < jumps.size(); ++i) {
        const double p = sums[i] / kReplicates;
        const double variance =
            (squares[i] / kReplicates - p * p) * kReplicates / (kReplicates - 1);
        if (p < 0.01 || p > 0.99 || variance <= 0)
            continue;
        const double gain = p * (1 - p) / static_cast<double>(n) / variance;
        result.mean += std::log(gain);
        result.least = std::min(result.least, gain);
        ++counted;
    }
    result.mean = std::exp(result.mean / counted);
    return result;
}

void print_gains(int m) {
    const std::array<Coordinates, 5> sets{
        {{0, 1}, {0, 1, 2, 3}, {0, 1, 4, 5}, {0, 1, 6, 7}, {0, 1, 2, 3, 4, 5}}};
    std::printf("2^%d points", m);
    for (const Coordinates& set : sets) {
        std::string name;
        for (const std::uint32_t coordinate : set)
            name += (name.empty() ? "" : ",") + std::to_string(coordinate);
        std::printf(" | %15s", name.c_str());
    }
    std::printf("\n");
    for (const SamplerEntry& entry : sampler_catalogue()) {
        std::printf("%-11s", std::string(entry.name).c_str());
        for (const Coordinates& set : sets) {
            const Gains found = gains(*entry.make(), set, std::uint64_t{1} << m);
            std::printf(" | %7.1f (%5.1f)", found.mean, found.least);
        }
        std::printf("\n");
    }
}

}  // namespace
}  // namespace quasimc

int main(int argc, char** argv) {
    quasimc::print_gains(argc > 1 ? std::atoi(argv[1]) : 14);
    return 0;
}
