#include "view/exponential_fit.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace quasimc {
namespace {

double squared_deviations(
    const ExponentialCurve& curve, std::span<const double> x, std::span<const double> y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double deviation = y[i] - curve.at(x[i]);
        sum += deviation * deviation;
    }
    return sum;
}

/// The step of Gauss and Newton; a step of 0 where it can't be told.
ExponentialCurve step_from(
    const ExponentialCurve& curve, std::span<const double> x, std::span<const double> y) {
    double aa = 0, ar = 0, rr = 0, ga = 0, gr = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double by_amount = std::exp(-curve.rate * x[i]);
        const double by_rate = -curve.amount * x[i] * by_amount;
        const double deviation = y[i] - curve.amount * by_amount;
        aa += by_amount * by_amount;
        ar += by_amount * by_rate;
        rr += by_rate * by_rate;
        ga += by_amount * deviation;
        gr += by_rate * deviation;
    }
    const double determinant = aa * rr - ar * ar;
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) {
        return {};
    }
    return {(ga * rr - gr * ar) / determinant, (gr * aa - ga * ar) / determinant};
}

}  // namespace

double ExponentialCurve::at(double x) const {
    return amount * std::exp(-rate * x);
}

std::optional<ExponentialCurve> fit_exponential(
    std::span<const double> x, std::span<const double> y) {
    const auto is_finite = [](double value) { return std::isfinite(value); };
    const bool is_good = std::all_of(x.begin(), x.end(), is_finite) &&
                         std::all_of(y.begin(), y.end(), is_finite) &&
                         std::set<double>(x.begin(), x.end()).size() > 2;
    if (!is_good) {
        return std::nullopt;
    }
    double sum = 0;
    for (const double value : y) {
        sum += value;
    }
    ExponentialCurve curve{sum / static_cast<double>(y.size()), 0};
    double least = squared_deviations(curve, x, y);
    constexpr int kSteps = 200;
    constexpr double kShortest = 1e-9;
    for (int i = 0; i < kSteps; ++i) {
        const ExponentialCurve step = step_from(curve, x, y);
        ExponentialCurve next = curve;
        double deviations = least;
        for (double part = 1; !(deviations < least) && part > kShortest; part /= 2) {
            next = {curve.amount + part * step.amount, curve.rate + part * step.rate};
            deviations = squared_deviations(next, x, y);
        }
        if (!(deviations < least)) {
            break;
        }
        curve = next;
        least = deviations;
    }
    return curve;
}

}  // namespace quasimc
