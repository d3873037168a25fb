#include "growth/view/splines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/view/view_lines.h"

namespace quasimc {
namespace {

/// The least number of control points of a cubic B-spline that is not closed.
constexpr std::size_t kMinSplinePoints = 4;

// The files of functions, curves and contours have lines "label: value", of which "points: n" is
// one, and then n lines with points.

/// Files of functions have points "x y" and no line "type:"; those of the others have it, and
/// points "x y z".
enum class SplineKind { function, curve, contour };

/// Content of a file with a spline.
struct SplineFile {
    std::optional<std::string> type;
    int samples = 0;
    int lines = 0;             ///< the number after "points:"
    std::vector<Vec3> points;  ///< repeated by their multiplicity
};

/// Reads the lines up to "points:" and, if there is one, "type:". Unknown ones are skipped.
SplineFile read_spline_header(ViewLines& lines, SplineKind kind) {
    SplineFile file;
    while (file.lines == 0 || (kind != SplineKind::function && !file.type)) {
        lines.need(file.lines == 0 ? "a line 'points: number'" : "a line 'type: type'");
        const std::optional<std::string> label = lines.take_label();
        if (label == "type") {
            file.type = lines.word();
        } else if (label == "points") {
            file.lines = lines.integer("the number of points", {1, kMaxControlPoints});
        } else if (label == "samples" && kind == SplineKind::function) {
            file.samples = lines.integer("the number of samples", {0, kMaxViewSamples});
        }
    }
    return file;
}

/// Reads a spline from the next line on.
SplineFile read_spline(ViewLines& lines, SplineKind kind) {
    SplineFile file = read_spline_header(lines, kind);
    for (int i = 1; i <= file.lines; ++i) {
        do {
            lines.need(fmt::format("point {} of {}", i, file.lines));
        } while (i == 1 && lines.line().find(':') != std::string_view::npos);
        const double x = lines.number("the x of a point"), y = lines.number("the y of a point");
        const double z = kind == SplineKind::function ? 0 : lines.number("the z of a point");
        const Vec3 p{x, y, kind == SplineKind::curve ? z : 0};
        const int times =
            lines.has_word() ? lines.integer("the multiplicity", {1, kMaxControlPoints}) : 1;
        file.points.insert(file.points.end(), static_cast<std::size_t>(times), p);
        if (file.points.size() > std::size_t{kMaxControlPoints}) {
            lines.fail(
                "there are too many points",
                fmt::format("at most {} are allowed, repeated ones included", kMaxControlPoints));
        }
    }
    const bool is_closed = kind == SplineKind::contour && file.type->starts_with('c');
    const std::size_t least = kMinSplinePoints - (is_closed ? 1 : 0);
    if (file.points.size() < least) {
        lines.fail(
            fmt::format("there are only {} points", file.points.size()),
            fmt::format("at least {} are needed, repeated ones included", least));
    }
    return file;
}

/// Reads the first line of a file, which begins with a word and a version.
void need_first_line(ViewLines& lines, std::string_view line) {
    if (!lines.next() || !lines.line().starts_with(line.substr(0, line.find(' ')))) {
        lines.fail("this is another kind of file", fmt::format("its first line is '{}'", line));
    }
}

/// A value of a cubic B-spline with clamped uniform knots (de Boor 1972).
/// @param d  0 to 1, along its parameter
double clamped_spline(const std::vector<double>& points, double d) {
    const std::size_t spans = points.size() - 3;
    const double u = d * static_cast<double>(spans);
    const std::size_t k = std::min(static_cast<std::size_t>(u), spans - 1);
    const auto knot = [&](std::size_t i) {
        return static_cast<double>(std::min(i < 3 ? 0 : i - 3, spans));
    };
    std::array<double, 4> p{points[k], points[k + 1], points[k + 2], points[k + 3]};
    for (std::size_t round = 1; round <= 3; ++round) {
        for (std::size_t j = 3; j >= round; --j) {
            const double low = knot(j + k), high = knot(j + k + 4 - round);
            const double alpha = (u - low) / (high - low);
            p[j] = (1 - alpha) * p[j - 1] + alpha * p[j];
        }
    }
    return p[3];
}

/// The value at x, by bisection from the middle with cpfg's tolerance.
double function_by_bisection(const PlantFunction& function, double x) {
    constexpr double kTolerance = 0.001;
    constexpr int kMaxHalvings = 60;  // x may be no value of the spline
    double low = 0, high = 1, d = 0.5;
    for (int i = 0; i < kMaxHalvings; ++i) {
        const double difference = clamped_spline(function.x, d) - x;
        if (std::abs(difference) <= kTolerance) {
            break;
        }
        (difference < 0 ? low : high) = d;
        d = 0.5 * (low + high);
    }
    return clamped_spline(function.y, d);
}

/// Reads a function from the next line on, and tabulates it if it has more than two samples.
/// @param samples  0: those of the file
PlantFunction read_one_function(ViewLines& lines, int samples) {
    const SplineFile file = read_spline(lines, SplineKind::function);
    PlantFunction function;
    for (const Vec3& p : file.points) {
        function.x.push_back(p.x);
        function.y.push_back(p.y);
    }
    const int used = samples > 0 ? samples : file.samples;
    for (int i = 0; used > 2 && i < used; ++i) {
        function.table.push_back(
            function_by_bisection(function, static_cast<double>(i) / (used - 1)));
    }
    return function;
}

/// A point of a uniform cubic B-spline. @param u  in spans; a closed spline repeats its points
Vec3 uniform_spline(const std::vector<Vec3>& points, std::size_t spans, double u) {
    const std::size_t k = std::min(static_cast<std::size_t>(u), spans - 1);
    const double f = u - static_cast<double>(k), g = 1 - f;
    const auto p = [&](std::size_t i) { return points[(k + i) % points.size()]; };
    return g * g * g / 6 * p(0) + ((3 * f - 6) * f * f + 4) / 6 * p(1) +
           (((3 - 3 * f) * f + 3) * f + 1) / 6 * p(2) + f * f * f / 6 * p(3);
}

/// A point of a curve. @param s  0 to 1, along its parameter
Vec3 curve_point(const std::vector<Vec3>& points, double s) {
    constexpr double kInside = 1e-6;  // keeps the end within the last span, as in cpfg
    const std::size_t spans = points.size() - 3;
    return uniform_spline(points, spans, s * (static_cast<double>(spans) - kInside));
}

/// Sums of the distances between points, up to each of them. @param point_at  gives a point
template <typename PointAt>
std::vector<double> chord_lengths(std::size_t count, const PointAt& point_at) {
    std::vector<double> lengths(count);
    Vec3 previous = point_at(0);
    for (std::size_t i = 1; i < count; ++i) {
        const Vec3 p = point_at(i);
        lengths[i] = lengths[i - 1] + length(p - previous);
        previous = p;
    }
    return lengths;
}

/// The index of a length in a list of at least two, interpolated.
double index_of_length(const std::vector<double>& lengths, double target) {
    const auto after = std::lower_bound(lengths.begin() + 1, lengths.end() - 1, target);
    const double low = *(after - 1), high = *after;
    const double within = high > low ? std::min((target - low) / (high - low), 1.0) : 0;
    return static_cast<double>(after - 1 - lengths.begin()) + within;
}

}  // namespace

double PlantFunction::value(double at) const {
    if (x.size() < kMinSplinePoints || y.size() != x.size()) {
        return 0;
    }
    const double clamped = at > 0 ? std::min(at, 1.0) : 0;
    if (table.size() <= 2) {
        return function_by_bisection(*this, clamped);
    }
    const double position = clamped * static_cast<double>(table.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(position), table.size() - 2);
    return table[i] + (position - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

Vec3 PlantCurve::at(double t) const {
    if (points.size() < kMinSplinePoints || lengths.size() < 2) {
        return {};
    }
    const double index = index_of_length(lengths, t > 0 ? std::min(t, 1.0) * length : 0);
    return curve_point(points, index / static_cast<double>(lengths.size() - 1));
}

std::vector<ContourPoint> Contour::divided(int sides) const {
    if (points.empty()) {
        return {};
    }
    // Lengths are measured between points of a tenth of a span. An open contour ends a tenth before
    // its end, as in cpfg.
    constexpr std::size_t kParts = 10;
    const std::size_t spans = is_open ? points.size() - 3 : points.size();
    const auto point = [&](double index) { return uniform_spline(points, spans, index / kParts); };
    const std::vector<double> lengths = chord_lengths(
        kParts * spans + (is_open ? 0 : 1),
        [&](std::size_t i) { return point(static_cast<double>(i)); });
    std::vector<ContourPoint> corners;
    for (int k = 0; k <= sides; ++k) {
        const Vec3 p = point(index_of_length(lengths, lengths.back() * k / sides));
        corners.push_back({p.x, p.y});
    }
    return corners;
}

PlantFunction read_function_file(const NamedFile& file, int samples) {
    ViewLines lines(file);
    return read_one_function(lines, samples);
}

std::vector<PlantFunction> read_function_set_file(const NamedFile& file) {
    ViewLines lines(file);
    need_first_line(lines, "funcgalleryver 1 1");
    do {
        lines.need("a line 'items: number'");
    } while (lines.take_label() != "items");
    const int count = lines.integer("the number of functions", {0, kMaxFunctionsOfSet});
    std::vector<PlantFunction> functions;
    functions.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        functions.push_back(read_one_function(lines, 0));
    }
    return functions;
}

PlantCurve read_curve_file(const NamedFile& file, int samples) {
    ViewLines lines(file);
    if (ViewLines first = lines; first.next() && first.line().starts_with("cver")) {
        return {};
    }
    PlantCurve curve;
    curve.points = read_spline(lines, SplineKind::curve).points;
    curve.lengths = chord_lengths(static_cast<std::size_t>(samples), [&](std::size_t i) {
        return curve_point(curve.points, static_cast<double>(i) / (samples - 1));
    });
    curve.length = curve.lengths.back();
    return curve;
}

Contour read_contour_file(const NamedFile& file) {
    ViewLines lines(file);
    need_first_line(lines, "cver 1 3");
    SplineFile read = read_spline(lines, SplineKind::contour);
    const bool is_open = read.type->starts_with('o');
    if (!is_open && !read.type->starts_with('c')) {
        lines.fail("the type is " + shown(*read.type), "it begins with o (open) or c (closed)");
    }
    return {std::move(read.points), is_open};
}

}  // namespace quasimc
