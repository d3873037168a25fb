#include "growth/language/random.h"

#include <algorithm>
#include <limits>

namespace quasimc {

void PlantRandom::srand(double n) {
    constexpr double kTwoTo32 = 4294967296.0;
    const double seed = std::isfinite(n) ? std::fmod(std::trunc(n), kTwoTo32) : 0;
    const auto bits = static_cast<std::uint64_t>(seed < 0 ? seed + kTwoTo32 : seed);
    generator = Posix48(bits << 16U | 0x330EU);
    has_second_normal = false;
}

double PlantRandom::first_normal() {
    double v1 = 0;
    double v2 = 0;
    double r = 0;
    do {
        v1 = 2 * generator.next() - 1;
        v2 = 2 * generator.next() - 1;
        r = v1 * v1 + v2 * v2;
    } while (r >= 1 || r == 0);
    const double factor = std::sqrt(-2 * std::log(r) / r);
    second_normal = v1 * factor;
    has_second_normal = true;
    return v2 * factor;
}

double PlantRandom::nonzero() {
    double u = 0;
    while (u == 0) {
        u = generator.next();
    }
    return u;
}

double PlantRandom::bran(double a, double b) {
    if (a == 0) {
        return 0;
    }
    constexpr int kMaxRounds = 1'000'000;
    const double s = a + b;
    const double smaller = std::min(a, b);
    const double lambda = smaller <= 1 ? smaller : std::sqrt((2 * a * b - s) / (s - 2));
    const double u = a + lambda;
    for (int round = 0; round < kMaxRounds; ++round) {
        const double u1 = nonzero();
        const double u2 = nonzero();
        const double v = std::log(u1 / (1 - u1)) / lambda;
        const double y = a * std::exp(v);
        const bool is_rejected =
            s * std::log(s / (b + y)) + u * v - std::log(4.0) < std::log(u1 * u1 * u2);
        if (!is_rejected) {
            return y / (b + y);
        }
    }
    return std::numeric_limits<double>::quiet_NaN();
}

double PlantRandom::biran(double n, double p) {
    constexpr double kMaxDraws = 1e9;
    if (n > kMaxDraws) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const auto draws = n >= 1 ? static_cast<std::uint64_t>(n) : 0;
    std::uint64_t count = 0;
    for (std::uint64_t i = 0; i < draws; ++i) {
        count += generator.next() <= p ? 1 : 0;
    }
    return static_cast<double>(count);
}

}  // namespace quasimc
