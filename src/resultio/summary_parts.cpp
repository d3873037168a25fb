#include "resultio/summary_parts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "results/groups.h"

namespace quasimc {
namespace {

/// Numbers that are parts of a whole, all with the digits that six of the whole reach to.
class PartFormat {
  public:
    explicit PartFormat(double whole) : rounding_(kRounding * std::abs(whole)) {
        constexpr int kDigits = 6;
        constexpr double kLargest = 1e6, kSmallest = 1e-4;
        if (whole >= kSmallest && whole < kLargest) {
            decimals_ = kDigits - 1 - static_cast<int>(std::floor(std::log10(whole)));
        }
    }

    [[nodiscard]] std::string operator()(double part) const {
        if (std::abs(part) < rounding_) {
            return "0";
        }
        if (decimals_ <= 0) {
            return fmt::format("{:.6g}", part + 0.0);
        }
        std::string text = with_decimals(part, decimals_);
        text.erase(text.find_last_not_of('0') + 1);  // 7.00 is 7
        return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
    }
    [[nodiscard]] std::string operator()(const Estimate& part) const {
        const bool has_error = std::isfinite(part.standard_error) &&
                               part.standard_error > kRounding * std::abs(part.mean);
        return (*this)(part.mean) +
               (has_error ? " +- " + error_text(part.standard_error) : std::string());
    }

  private:
    /// Relative standard error below which a value is exact: replicates differ by rounding alone.
    static constexpr double kRounding = 1e-13;

    double rounding_;
    int decimals_ = -1;
};

}  // namespace

ErrorStatistics error_statistics(const Scene& scene, const Result& result) {
    ErrorStatistics errors;
    std::vector<double> relative;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        if (!scene.organs()[i].measured || scene.organs()[i].is_ground) {
            continue;
        }
        ++errors.organs;
        bool is_known = true;
        double worst = 0;
        for (std::size_t b = 0; b < scene.bands().size(); ++b) {
            const Estimate& e = result.at(i, Quantity::absorbed_flux, b);
            if (!std::isfinite(e.standard_error) || e.mean == 0) {
                is_known = false;
                continue;
            }
            relative.push_back(e.standard_error / e.mean);
            worst = std::max(worst, relative.back());
        }
        if (worst >= errors.worst && worst > 0) {
            errors.worst = worst;
            errors.worst_id = scene.organs()[i].id;
        }
        errors.unknown += is_known ? 0 : 1;
        errors.badly_known += worst > kBadlyKnown ? 1 : 0;
    }
    if (!relative.empty()) {
        const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
        std::nth_element(relative.begin(), middle, relative.end());
        errors.median = *middle;
    }
    return errors;
}

std::string format_percent(double part) {
    constexpr double kWhole = 10;  // percent from which on there are no decimals
    const double percent = 100 * part;
    return percent < kWhole ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

std::string advice_on_error(const RunFile& run, double median) {
    constexpr double kLarge = 0.1;
    if (!(median > kLarge) || run.spec.target_error > 0) {
        return "";
    }
    // By how much more paths lower an error depends on the method, which `auto` may change then.
    return run.spec.time_method == TimeMethod::daylight_coefficients
               ? "more paths make errors smaller"
               : fmt::format(
                     "to reach {}: --target-error {}", format_percent(kLarge / 2), kLarge / 2);
}

std::string describe_errors(const ErrorStatistics& errors) {
    if (!errors.has_median()) {
        return "absorbed flux: no standard error could be estimated";
    }
    std::string text = fmt::format(
        "absorbed flux, relative standard error: median {}", format_percent(errors.median));
    text +=
        errors.badly_known > 0
            ? fmt::format(
                  ", above {:.0f} % for {} of {} (largest: organ {})", 100 * kBadlyKnown,
                  errors.badly_known, counted(errors.organs, "organ"), errors.worst_id)
            : fmt::format(", largest {} (organ {})", format_percent(errors.worst), errors.worst_id);
    if (errors.unknown > 0) {
        text += fmt::format(
            "; none for {} (no absorbed light found)", counted(errors.unknown, "organ"));
    }
    return text;
}

std::string describe_sensors(const Result& sensors) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < sensors.organs(); ++i) {
        for (std::size_t b = 0; b < sensors.bands; ++b) {
            const Estimate above = sensors.at(i, Quantity::incident_upper, b);
            const Estimate below = sensors.at(i, Quantity::incident_lower, b);
            const Estimate& brighter = above.mean >= below.mean ? above : below;
            const double error = brighter.standard_error / brighter.mean;
            if (std::isfinite(error)) {
                errors.push_back(error);
            }
        }
    }
    const std::string count = counted(sensors.organs(), "sensor");
    if (errors.empty()) {
        return count + ": no standard error could be estimated";
    }
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return fmt::format(
        "{}, brighter side: relative standard error: median {}, largest {}", count,
        format_percent(*middle), format_percent(*std::max_element(middle, errors.end())));
}

namespace {

/// The light of a target: "organs and sensors".
std::string_view target_text(const Scene& scene, TargetScope target) {
    const auto& organs = scene.organs();
    switch (target) {
        case TargetScope::groups:
            return "groups";
        case TargetScope::sensors:
            return "sensors";
        case TargetScope::organs:
            return "organs";
        default:
            return !scene.sensors().empty() ||
                           std::any_of(
                               organs.begin(), organs.end(),
                               [&](const Organ& organ) {
                                   return organ.measured && is_sensor(scene, organ);
                               })
                       ? "organs and of the sensors"
                       : "organs";
    }
}

}  // namespace

std::string describe_target(const RunFile& run, const Result& result) {
    const RunSpec& spec = run.spec;
    const bool is_reached =
        result.stop == StopReason::target_reached || result.stop == StopReason::no_light;
    std::string text = is_reached ? "reached: " : "not reached: ";
    const std::string quantity =
        spec.target_quantity == "auto" ? "" : fmt::format(" in {}", spec.target_quantity);
    if (spec.target == TargetScope::total) {
        return text + fmt::format(
                          "the total is {}within {:.6g} %{}", is_reached ? "" : "not ",
                          100 * spec.target_error, quantity);
    }
    return text + fmt::format(
                      "{:.3g} % of the {} are within {:.6g} %{} ({:.3g} % required)",
                      100 * result.fraction_at_target, target_text(run.scene, spec.target),
                      100 * spec.target_error, quantity, 100 * spec.target_fraction);
}

std::string describe_energy(
    const BandBudget& budget, const std::string& unit, bool escaped_by_difference) {
    const PartFormat number(budget.emitted.mean);
    std::string text = fmt::format("[{}]: emitted {}", unit, number(budget.emitted));
    if (std::isnan(budget.escaped.mean)) {
        return text + "; the rest is unknown: not all organs are measured";
    }
    if (budget.imbalance.mean != 0) {
        text += ", imbalance " + number(budget.imbalance.mean);
    }
    return text + fmt::format(
                      "; organs {}, ground {}, escaped {}{}, cut off {}",
                      number(budget.absorbed_by_organs), number(budget.absorbed_by_ground),
                      number(budget.escaped.mean), escaped_by_difference ? " (by difference)" : "",
                      number(budget.cut_off.mean));
}

}  // namespace quasimc
