#include "stress/checks.h"

#include <bit>
#include <cmath>

#include <fmt/format.h>

namespace quasimc::stress {
namespace {

/// Tolerance of the energy balance: rounding to 2^-28 of a path's light.
constexpr double kClosure = 1e-6;

/// Number of standard errors by which a mean may exceed the end of its interval if that is a
/// physical limit; among 1e9 means of 16 replicates about one does.
constexpr double kNoise = 12;
/// Relative excess that is allowed as well, because corners are rounded; areas of thinner triangles
/// are exact.
constexpr double kBlur = 1e-3;

/// The fault of a number, or "". A low end below 0 is no fault, as intervals are symmetric.
std::string fault_of(const Number& n) {
    if (!n.is_known) {
        return "";
    }
    if (!std::isfinite(n.mean) || std::isinf(n.error) || std::isinf(n.high)) {
        return "is not finite";
    }
    if (n.mean < 0) {
        return "is negative";
    }
    const bool is_above = n.high < n.mean * (1 - kBlur) - kNoise * n.error;
    if (n.error < 0 || n.low > n.mean || is_above) {
        return "lies outside its interval";
    }
    if (std::isnan(n.error) && n.mean != 0) {
        return "has no error";
    }
    return "";
}

Way way_of(Method method) {
    switch (method) {
        case Method::from_organs:
            return Way::from_organs;
        case Method::first_hits:
            return Way::first_hits;
        case Method::ray_bundles:
            return Way::ray_bundles;
        default:
            return Way::light_tracing;
    }
}

}  // namespace

std::vector<std::string> impossible_numbers(
    const Answer& answer, const std::vector<std::string>& names) {
    std::vector<std::string> faults;
    for (std::size_t i = 0; i < answer.numbers.size(); ++i) {
        const Number& n = answer.numbers[i];
        std::string fault = fault_of(n);
        const bool is_fraction = names[i].find("sunlit_fraction") != std::string::npos;
        if (fault.empty() && n.is_known && is_fraction && n.high > 1 && n.low <= 1) {
            fault = "reaches above all of it";
        }
        if (!fault.empty()) {
            faults.push_back(fmt::format(
                "{} {}: {:.6g} +- {:.2g}, {:.6g} to {:.6g}, {}", name_of(answer.way), names[i],
                n.mean, n.error, n.low, n.high, fault));
        }
    }
    if (!answer.result) {
        return faults;
    }
    for (const BandBudget& budget : answer.result->budget) {
        if (!(budget.closure_error < kClosure)) {
            faults.push_back(fmt::format(
                "{} the energy budget stays open by {:.2g}", name_of(answer.way),
                budget.closure_error));
        }
        if (!std::isfinite(budget.emitted.mean) || budget.emitted.mean < 0) {
            faults.push_back(
                fmt::format("{} emitted is {:.6g}", name_of(answer.way), budget.emitted.mean));
        }
    }
    return faults;
}

bool same_bits(const Answer& a, const Answer& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) ||
               (std::isnan(x) && std::isnan(y));
    };
    for (std::size_t i = 0; i < a.numbers.size(); ++i) {
        const Number& x = a.numbers[i];
        const Number& y = b.numbers[i];
        if (!same(x.mean, y.mean) || !same(x.error, y.error) || !same(x.low, y.low) ||
            !same(x.high, y.high)) {
            return false;
        }
    }
    return a.numbers.size() == b.numbers.size();
}

std::vector<std::string> faults_of_identity(const Case& it, const Effort& effort) {
    std::vector<std::string> faults;
    const Answer chosen = compute(it, Way::automatic, effort);
    const Method method = chosen.result->chosen.method;
    if (!same_bits(chosen, compute(it, way_of(method), effort))) {
        faults.push_back("auto differs from the method that it names: " + name_of(way_of(method)));
    }
    Effort wide = effort;
    wide.threads = 3;
    if (!same_bits(chosen, compute(it, Way::automatic, wide))) {
        faults.push_back("three threads give other numbers than one: " + name_of(way_of(method)));
    }
    return faults;
}

}  // namespace quasimc::stress
