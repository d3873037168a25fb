#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace quasimc::test {

/// Queries for `count` leaves around a stem, in step `step` of its growth.
inline std::string growing_leaves(int count, int step) {
    constexpr double kGoldenAngle = 2.399963229728653;
    std::string text;
    for (int i = 0; i < count; ++i) {
        const double angle = kGoldenAngle * i;
        const double c = std::cos(angle), s = std::sin(angle), size = 0.1 + 0.002 * step;
        text += fmt::format(
            "{} E(1)P({:g},{:g})\n {:g} {:g} {:g}\n {:g} 0.5 {:g}\n {:g} 0 {:g}\n {:g} -0.866025 "
            "{:g}\n",
            50 * i, size, 2 * size, 3 * c * std::sqrt(i % 97), 0.002 * i, 3 * s * std::sqrt(i % 97),
            0.866025 * c, 0.866025 * s, -s, c, 0.5 * c, 0.5 * s);
    }
    return text + fmt::format("Control: 5 {}\n", step);
}

}  // namespace quasimc::test
