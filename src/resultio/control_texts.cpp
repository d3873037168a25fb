#include "resultio/control_texts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "resultio/describe_series.h"

namespace quasimc {
namespace {

constexpr double kHour = 3600;

const std::string& unit_of_control(const RunFile& run, const LampControl& control) {
    return run.scene.bands()[control.band].unit;
}

/// "hps" for "hps *".
std::string short_name(const LampControl& control) {
    const std::size_t end = control.sources.find_last_not_of(" *");
    return one_line(
        end == std::string::npos ? control.sources : control.sources.substr(0, end + 1));
}

/// The hour of the day of a time "2024-06-21T12:30+02:00".
double clock_hour(const std::string& time) {
    const std::size_t at = time.find('T') + 1;
    return std::stod(time.substr(at, 2)) + std::stod(time.substr(at + 3, 2)) / 60;
}

std::string clock_text(double hour) {
    const auto minutes = static_cast<int>(std::lround(hour * 60));
    return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

/// "04:00-11:00, 13:00-19:38". Lamps that are on for a part of a time are on at its end if they
/// are on afterwards and were off before.
std::string describe_hours(const TimeSeries& series, const ControlOutcome& outcome) {
    constexpr double kGap = 1e-6;
    std::vector<std::pair<double, double>> hours;
    for (std::size_t i = 0; i < outcome.steps.size(); ++i) {
        const auto is_on = [&](std::size_t step) { return outcome.steps[step].on > 0; };
        if (!is_on(i)) {
            continue;
        }
        const double length = series.time_steps[i].seconds / kHour;
        const double on = outcome.steps[i].on * length;
        const bool is_at_end =
            !(i > 0 && is_on(i - 1)) && i + 1 < outcome.steps.size() && is_on(i + 1);
        const double begin = clock_hour(series.notes[i].time) + (is_at_end ? length - on : 0);
        if (!hours.empty() && std::abs(hours.back().second - begin) < kGap) {
            hours.back().second = begin + on;
        } else {
            hours.emplace_back(begin, begin + on);
        }
    }
    std::vector<std::string> texts;
    texts.reserve(hours.size());
    for (const auto& [from, to] : hours) {
        texts.push_back(clock_text(from) + "-" + clock_text(to));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// A number with three digits: "12.0", "170".
std::string three_digits(double number) {
    const int before_point = number >= 1 ? static_cast<int>(std::log10(number)) + 1 : 1;
    return fmt::format("{:.{}f}", number, std::max(0, 3 - before_point));
}

/// The sums of all days.
ControlDay sum_of_days(const ControlOutcome& outcome) {
    ControlDay sum;
    for (const ControlDay& day : outcome.days) {
        sum.hours_on += day.hours_on;
        sum.kwh += day.kwh;
        sum.hours_near_threshold += day.hours_near_threshold;
        sum.light.mean += day.light.mean;
    }
    return sum;
}

std::string describe_control(
    const RunFile& run, const LampControl& control, const ControlOutcome& outcome) {
    const auto days = static_cast<double>(std::max<std::size_t>(outcome.days.size(), 1));
    const ControlDay sum = sum_of_days(outcome);
    const SummedUnit unit = summed_unit(unit_of_control(run, control));
    const std::string per_day = days > 1 ? " a day" : "";
    std::string text = short_name(control) + ": ";
    if (sum.hours_on == 0) {
        text += "off";
    } else {
        const std::string hours = days > 1 ? "" : describe_hours(*run.series, outcome) + ", ";
        text += fmt::format("on {}{:.1f} h{}", hours, sum.hours_on / days, per_day);
    }
    if (control.electrical_power_w > 0) {
        text += fmt::format(", {} kWh{}", three_digits(sum.kwh / days), per_day);
    }
    text += fmt::format(
        ", {} {}{}", three_digits(unit.factor * sum.light.mean / days), unit.name, per_day);
    if (sum.hours_near_threshold > 0) {
        text += fmt::format(
            "; daylight is within 2 standard errors of on_below for {:.3g} h",
            sum.hours_near_threshold);
    }
    return text;
}

}  // namespace

std::vector<std::string> describe_controls(const RunFile& run) {
    std::vector<std::string> texts;
    for (std::size_t k = 0; run.series && k < run.series->outcomes.size(); ++k) {
        texts.push_back(describe_control(run, run.series->controls[k], run.series->outcomes[k]));
    }
    return texts;
}

}  // namespace quasimc
