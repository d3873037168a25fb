#include "stress/compare.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sums/statistics.h"

namespace quasimc::stress {
namespace {

bool has_error(const Number& n) {
    return !std::isnan(n.error);
}

/// The probability of zero contributions if the expectation is the other number minus four of its
/// standard errors; the upper end of the interval of zero corresponds to three contributions.
double p_value_of_zero(const Number& nothing, const Number& other, double slack) {
    const double least = other.mean - 4 * other.error - slack;
    if (!has_error(other) || least <= 0) {
        return 1;
    }
    return nothing.high > 0 ? std::exp(-3 * least / nothing.high) : 0;
}

}  // namespace

double p_value_of(
    const Number& a, double freedom_a, const Number& b, double freedom_b, double slack) {
    if (!has_error(a) || !has_error(b)) {
        if (has_error(a) == has_error(b)) {
            return 1;
        }
        return has_error(a) ? p_value_of_zero(b, a, slack) : p_value_of_zero(a, b, slack);
    }
    const double difference = std::abs(a.mean - b.mean) - slack;
    if (difference <= 0) {
        return 1;
    }
    // Each variance as a share of both: avoids squares of tiny or huge numbers.
    const double both = std::hypot(a.error, b.error);
    if (both == 0) {
        return 0;
    }
    const double share_a = std::pow(a.error / both, 2);
    const double share_b = std::pow(b.error / both, 2);
    const double freedom = 1 / (share_a * share_a / freedom_a + share_b * share_b / freedom_b);
    return f_tail(std::pow(difference / both, 2), 1, freedom);
}

std::vector<Disagreement> disagreements(
    const Case& it, const std::vector<Answer>& answers, double level) {
    const std::vector<std::string> names = number_names(it.run.scene);
    std::vector<Disagreement> found;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        for (std::size_t k = i + 1; k < answers.size(); ++k) {
            const Answer& a = answers[i];
            const Answer& b = answers[k];
            for (std::size_t n = 0; n < a.numbers.size(); ++n) {
                const Number& x = a.numbers[n];
                const Number& y = b.numbers[n];
                if (!x.is_known || !y.is_known) {
                    continue;
                }
                const double slack = slack_between(it, n, a, b);
                const double p_value = p_value_of(x, a.freedom, y, b.freedom, slack);
                if (p_value < level) {
                    found.push_back(
                        {n, a.way, b.way, p_value,
                         fmt::format(
                             "{}: {} {:.6g} +- {:.2g} (to {:.4g}), {} {:.6g} +- {:.2g} (to "
                             "{:.4g}), p {:.1e}",
                             names[n], name_of(a.way), x.mean, x.error, x.high, name_of(b.way),
                             y.mean, y.error, y.high, p_value)});
                }
            }
        }
    }
    return found;
}

double slack_of(const Case& it, std::size_t number, double mean) {
    return it.slips[number] + it.roundings[number] * std::abs(mean);
}

double slack_between(const Case& it, std::size_t number, const Answer& a, const Answer& b) {
    const auto larger = [&](std::size_t n) {
        return std::max(std::abs(a.numbers[n].mean), std::abs(b.numbers[n].mean));
    };
    const Scene& scene = it.run.scene;
    const std::size_t bands = scene.bands().size();
    const std::size_t each = kComparedQuantities.size() * bands + 1;
    const std::size_t first_total = scene.organs().size() * each;
    const double own = slack_of(it, number, larger(number));
    if (number < first_total) {
        return own;
    }
    // Totals are sorted by band, for organs and ground; the absorbed flux is the first quantity of
    // an organ.
    const std::size_t band = (number - first_total) / 2;
    const bool is_of_ground = (number - first_total) % 2 == 1;
    double parts = 0;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const std::size_t n = i * each + band;
        const bool is_part = scene.organs()[i].is_ground == is_of_ground;
        const bool is_known = a.numbers[n].is_known && b.numbers[n].is_known;
        parts += is_part && is_known ? slack_of(it, n, larger(n)) : 0;
    }
    return std::max(own, parts);
}

std::size_t count_comparisons(const std::vector<Answer>& answers) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        for (std::size_t k = i + 1; k < answers.size(); ++k) {
            for (std::size_t n = 0; n < answers[i].numbers.size(); ++n) {
                count += answers[i].numbers[n].is_known && answers[k].numbers[n].is_known ? 1 : 0;
            }
        }
    }
    return count;
}

}  // namespace quasimc::stress
