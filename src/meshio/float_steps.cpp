#include "meshio/float_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace quasimc {
namespace {

/// About the number of values of a large file that are checked.
constexpr std::size_t kSampledValues = 10000;

/// The distance from a number to the next one of single precision.
double float_step(double x) {
    constexpr int kDigits = std::numeric_limits<float>::digits;
    return std::ldexp(1, std::ilogb(x) + 1 - kDigits);
}

struct AxisStep {
    double step = 0, at = 0;
};

/// The largest step of single precision on an axis if its numbers use them: nearly all lie on such
/// steps, and the last bit is set in at least a quarter of them, not in half of them by chance.
/// Whole numbers, for example, do not need their last bits: they are exact.
AxisStep step_along(std::span<const Vec3> points, std::size_t axis) {
    constexpr double kOnStep = 1.0 / 16, kNearlyAll = 0.99;
    AxisStep largest;
    std::size_t checked = 0, on_step = 0, odd = 0;
    const std::size_t stride = points.size() / kSampledValues + 1;
    for (std::size_t i = 0; i < points.size(); i += stride) {
        const Vec3& p = points[i];
        const double x = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
        ++checked;
        if (x == 0 || !std::isfinite(x)) {
            ++on_step;
            continue;
        }
        const double step = float_step(x), steps = x / step, whole = std::nearbyint(steps);
        const bool is_on_step = std::abs(steps - whole) < kOnStep;
        on_step += is_on_step ? 1 : 0;
        odd += is_on_step && std::fmod(whole, 2) != 0 ? 1 : 0;
        largest = step > largest.step ? AxisStep{step, x} : largest;
    }
    const bool is_used =
        static_cast<double>(on_step) >= kNearlyAll * static_cast<double>(checked) &&
        4 * odd >= checked;
    return is_used ? largest : AxisStep{};
}

/// The median height of triangles above their longest edges. A triangle that rounding has flattened
/// counts by its edge.
double median_height(std::span<const Vec3> points, std::span<const std::span<const Face>> parts) {
    std::size_t count = 0;
    for (const auto& faces : parts) {
        count += faces.size();
    }
    const std::size_t stride = count / kSampledValues + 1;
    std::vector<double> heights;
    std::size_t number = 0;
    for (const auto& faces : parts) {
        for (const auto& [a, b, c] : faces) {
            if (number++ % stride != 0) {
                continue;
            }
            const Triangle t{points[a], points[b], points[c]};
            const double edge =
                std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
            const double height = edge > 0 ? 2 * area(t) / edge : 0;
            heights.push_back(height > 0 ? height : edge);
        }
    }
    if (heights.empty()) {
        return 0;
    }
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::nth_element(heights.begin(), middle, heights.end());
    return *middle;
}

}  // namespace

std::string describe_float_steps(
    std::span<const Vec3> points, std::span<const std::span<const Face>> parts) {
    constexpr double kCoarse = 0.01;
    constexpr std::array<char, 3> kAxes{'x', 'y', 'z'};
    std::size_t worst_axis = 0;
    AxisStep worst;
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
        const AxisStep along = step_along(points, axis);
        worst_axis = along.step > worst.step ? axis : worst_axis;
        worst = along.step > worst.step ? along : worst;
    }
    const double height = median_height(points, parts);
    if (worst.step == 0 || worst.step <= kCoarse * height) {
        return "";
    }
    return fmt::format(
        "its coordinates are in single precision, with steps of {:.2g} near {} = {:.7g}, and its "
        "median triangle is {:.2g} high: rounding changes shapes and areas; subtract an origin "
        "before writing the file, or write it in double precision (PLY with property double, OBJ "
        "with all digits)",
        worst.step, kAxes[worst_axis], worst.at, height);
}

}  // namespace quasimc
