#include "meshio/ops_columns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "meshio/file_axes.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {

Affine ops_transform(const OpsNumbers& numbers, double unit, double size) {
    const double scale = numbers.scale * size;
    const double c = std::cos(numbers.twist), s = std::sin(numbers.twist);
    const Affine turned{
        {Vec3{c * scale, -s * scale, 0}, Vec3{s * scale, c * scale, 0}, Vec3{0, 0, scale}}, {}};
    // Rodrigues' formula about the horizontal axis (-sin azimuth, cos azimuth, 0), angles
    // counter-clockwise from x.
    const double x = -std::sin(numbers.azimuth), y = std::cos(numbers.azimuth);
    const double cosine = std::cos(numbers.angle), sine = std::sin(numbers.angle);
    const double rest = 1 - cosine;
    const Affine inclined{
        {Vec3{cosine + x * x * rest, x * y * rest, y * sine},
         Vec3{x * y * rest, cosine + y * y * rest, -x * sine}, Vec3{-y * sine, x * sine, cosine}},
        unit * numbers.position};
    return after(inclined, turned);
}

std::vector<std::string_view> ops_fields(std::string_view line) {
    const Separators separators = line.find('\t') == line.npos ? kBlanks : "\t";
    std::vector<std::string_view> fields;
    for (std::string_view word = take_word(line, separators); !word.empty();
         word = take_word(line, separators)) {
        fields.push_back(trimmed(word));
    }
    return fields;
}

void OpsColumns::read_comment(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of('#'), line.size()));
    if (take_word(line) != "sceneId") {
        return;
    }
    has_scale_ = false;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        has_scale_ = *has_scale_ || word == "scale";
    }
}

std::optional<OpsNumbers> OpsColumns::numbers_of(
    const std::vector<std::string_view>& fields, std::uint32_t line, Reporter& reporter) {
    constexpr std::size_t kFields = 10, kNames = 3;
    const bool may_lack_scale = !has_scale_.value_or(false);
    if (fields.size() != kFields && !(fields.size() == kFields - 1 && may_lack_scale)) {
        reporter.fault(
            line, fmt::format("{} fields", fields.size()),
            "a plant has ten: scene, plant, file, x, y, z, scale, azimuth and angle of "
            "inclination, twist; nine (without scale) in the old layout");
        return std::nullopt;
    }
    std::vector<double> numbers;
    for (std::size_t i = kNames; i < fields.size(); ++i) {
        const auto real = parse_real(fields[i]);
        if (!real || !std::isfinite(*real)) {
            reporter.fault(line, shown(fields[i]) + " is not a finite number", "");
            return std::nullopt;
        }
        numbers.push_back(*real);
    }
    return arrange(numbers, line);
}

OpsNumbers OpsColumns::arrange(const std::vector<double>& numbers, std::uint32_t line) {
    constexpr std::size_t kWithScale = 7;
    const bool is_old = numbers.size() < kWithScale || !has_scale_.value_or(numbers[3] != 0);
    const std::size_t next = is_old ? 3 : 4;
    OpsNumbers result{
        {numbers[0], numbers[1], numbers[2]},
        is_old ? 1 : numbers[3],
        numbers[next],
        numbers[next + 1],
        numbers[next + 2]};
    if (is_old && !has_scale_) {
        old_.add(line);
    }
    if (result.scale == 0) {
        result.scale = 1;
        unscaled_.add(line);
    }
    constexpr double kFullTurn = 2 * std::numbers::pi * (1 + 1e-3);  // tolerates few digits
    const double largest =
        std::max({std::abs(result.azimuth), std::abs(result.angle), std::abs(result.twist)});
    if (largest > kFullTurn) {
        turned_.add(line);
    }
    return result;
}

void OpsColumns::Notes::warn(std::string_view text, Reporter& reporter) const {
    if (count > 0) {
        reporter.warn(
            fmt::format("{} {} {}", counted(count, "plant"), count == 1 ? "has" : "have", text),
            first);
    }
}

void OpsColumns::warn(Reporter& reporter) const {
    old_.warn(
        "no scale: their lines are read in the old layout, where the azimuth of the inclination "
        "follows z",
        reporter);
    unscaled_.warn("the scale 0, and 1 is used", reporter);
    turned_.warn(
        "an angle beyond a full turn (2 pi): angles in an OPS file are radians, not degrees",
        reporter);
}

}  // namespace quasimc
