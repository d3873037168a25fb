#include "geometry/raster/columns.h"

#include <algorithm>
#include <cmath>

#include "geometry/raster/triangle_rows.h"

namespace quasimc {
namespace {

/// Lines of a beam, at most: they are numbered, and no scene needs more.
constexpr double kMostLines = 1U << 30U;
/// Where lines are so many for each fragment, they are not counted one by one.
constexpr std::size_t kSparse = 16;

std::int64_t ceil_of(double x) {
    return static_cast<std::int64_t>(std::ceil(x));
}

/// i modulo n, 0 <= result < n.
std::int64_t wrapped(std::int64_t i, std::int64_t n) {
    const std::int64_t rest = i % n;
    return rest < 0 ? rest + n : rest;
}

}  // namespace

void Columns::draw(
    const ProjectedScene& scene,
    const Patches& patches,
    std::span<const float> least_cosines,
    const Spec& spec) {
    fragments_.clear();
    sorted_.clear();
    passed_.clear();
    first_.clear();
    set_grid(scene, spec);
    if (columns_ == 0) {
        return;
    }
    for (std::uint32_t i = 0; i < scene.mesh->triangle_count(); ++i) {
        scene.check_stop();
        if (!patches.has(i)) {
            continue;
        }
        const double along = dot(scene.mesh->across(i), spec.direction);
        if (!least_cosines.empty() && least_cosines[i] > 0 &&
            std::abs(scene.cosine(i, spec.direction)) < static_cast<double>(least_cosines[i])) {
            continue;
        }
        const Passed sensor = scene.role(i) == VisibilityRole::sensor ? kSensor : 0;
        draw_triangle(
            {patches.first(i), patches.level(i), sensor | (along > 0 ? 1U : 0U)},
            scene.seen(i, x_, y_, z_));
    }
    sort_lines();
}

/// Across an open scene lines stand on squares. Along the periods of a periodic one there is a
/// whole number of them.
void Columns::set_grid(const ProjectedScene& scene, const Spec& spec) {
    const ProjectionPlane plane(scene, spec.direction, spec.rotation, AlongPeriods::straight);
    columns_ = rows_ = 0;
    row_shift_ = 0;
    if (!(plane.size_s > 0 && plane.size_t > 0)) {
        return;  // seen edge-on
    }
    repeats_x_ = plane.repeats_s;
    repeats_y_ = plane.repeats_t;
    const double area = plane.size_s * plane.size_t * plane.area;
    const double lines = std::clamp(area / spec.line_area, 1.0, kMostLines);
    if (repeats_x_ && repeats_y_) {
        set_square_rows(plane, spec, lines);
        return;
    }
    const double pitch = std::max(
        std::sqrt(plane.size_s * plane.size_t / lines),
        std::max(plane.size_s, plane.size_t) / lines);
    const auto steps = [&](double size, bool repeats) {
        return std::max(1.0, repeats ? std::round(size / pitch) : std::ceil(size / pitch));
    };
    const double across = steps(plane.size_s, repeats_x_);
    const double up = steps(plane.size_t, repeats_y_);
    const double pitch_x = repeats_x_ ? plane.size_s / across : pitch;
    const double pitch_y = repeats_y_ ? plane.size_t / up : pitch;
    columns_ = static_cast<std::int64_t>(across);
    rows_ = static_cast<std::int64_t>(up);
    x_ = {plane.s / pitch_x, -plane.low_s / pitch_x - spec.shift_s};
    y_ = {plane.t / pitch_y, -plane.low_t / pitch_y - spec.shift_t};
    z_ = {plane.depth, 0};
    line_area_ = pitch_x * pitch_y * plane.area;
}

/// Of a layer without end: as many columns as make squares across the beam, not on the horizontal,
/// and each row so far beside the last that these are squares, not rhombs.
void Columns::set_square_rows(const ProjectionPlane& plane, const Spec& spec, double lines) {
    // Steps along s and t on the horizontal, as seen across the beam.
    const Vec3 s{plane.s.x, plane.s.y, 0};
    const Vec3 t{plane.t.x, plane.t.y, 0};
    const double along_s = dot(s, spec.direction);
    const double ss = dot(s, s) - along_s * along_s;
    const double st = dot(s, t) - along_s * dot(t, spec.direction);
    const double side = std::sqrt(plane.size_s * plane.size_t * plane.area / lines);
    const double across =
        std::clamp(std::round(plane.size_s * std::sqrt(ss) / side), 1.0, std::floor(lines));
    const double up = std::max(1.0, std::round(lines / across));
    columns_ = static_cast<std::int64_t>(across);
    rows_ = static_cast<std::int64_t>(up);
    const double pitch_x = plane.size_s / across;
    const double pitch_y = plane.size_t / up;
    x_ = {plane.s / pitch_x, -plane.low_s / pitch_x - spec.shift_s};
    y_ = {plane.t / pitch_y, -plane.low_t / pitch_y - spec.shift_t};
    z_ = {plane.depth, 0};
    row_shift_ = ss > 0 ? -pitch_y * st / ss / pitch_x : 0;
    line_area_ = pitch_x * pitch_y * plane.area;
}

void Columns::draw_triangle(const Drawn& drawn, const ProjectedTriangle& c) {
    const TrianglePlane plane(c);
    if (plane.is_edge_on()) {
        return;
    }
    const auto [low_y, high_y] = std::minmax({c.y[0], c.y[1], c.y[2]});
    std::int64_t row = ceil_of(low_y);
    std::int64_t end_row = ceil_of(high_y);
    if (!repeats_y_) {
        row = std::max<std::int64_t>(row, 0);
        end_row = std::min(end_row, rows_);
    }
    if (row >= end_row) {
        return;
    }
    const PlaneGradient z = plane.gradient(c.z[0], c.z[1] - c.z[0], c.z[2] - c.z[0]);
    const PlaneGradient u = plane.gradient(0, 1, 0);
    const PlaneGradient v = plane.gradient(0, 0, 1);
    const auto [low_z, high_z] = std::minmax({c.z[0], c.z[1], c.z[2]});
    const SidesByRow sides(c);
    for (; row < end_row; ++row) {
        const auto y = static_cast<double>(row);
        const std::int64_t in_row = repeats_y_ ? wrapped(row, rows_) : row;
        const double moved = static_cast<double>(in_row) * row_shift_;
        const double shift = moved - std::floor(moved);
        const auto [left, right] = sides.at(y);
        std::int64_t column = ceil_of(left - shift);
        std::int64_t end = ceil_of(right - shift);
        if (!repeats_x_) {
            column = std::max<std::int64_t>(column, 0);
            end = std::min(end, columns_);
        }
        std::int64_t line = repeats_x_ ? wrapped(column, columns_) : column;
        const auto first_line = static_cast<std::uint32_t>(in_row * columns_);
        for (; column < end; ++column) {
            const double x = static_cast<double>(column) + shift;
            const double depth = std::clamp(z.at + z.by_x * x + z.by_y * y, low_z, high_z);
            const std::uint32_t part = drawn.level == 0
                                           ? 0
                                           : Patches::part(
                                                 drawn.level, u.at + u.by_x * x + u.by_y * y,
                                                 v.at + v.by_x * x + v.by_y * y);
            fragments_.push_back(
                {first_line + static_cast<std::uint32_t>(line), static_cast<float>(depth),
                 drawn.mark + 2 * (drawn.first_patch + part)});
            ++line;
            line = line == columns_ && repeats_x_ ? 0 : line;
        }
    }
}

/// By line, and along each by depth.
void Columns::sort_lines() {
    const auto lines = static_cast<std::size_t>(columns_ * rows_);
    if (lines > kSparse * fragments_.size() + kSparse) {
        sort_sparse_lines();
        return;
    }
    first_.assign(lines + 1, 0);
    for (const Fragment& f : fragments_) {
        ++first_[f.line];
    }
    std::uint32_t end = 0;
    for (std::uint32_t& first : first_) {
        end += first;
        first = end;
    }
    // From the last to the first, so that what is equally deep keeps its order.
    sorted_.resize(fragments_.size());
    for (std::size_t i = fragments_.size(); i-- > 0;) {
        const Fragment& f = fragments_[i];
        sorted_[--first_[f.line]] = {f.depth, f.passed};
    }
    passed_.resize(sorted_.size());
    const auto is_before = [](const InLine& a, const InLine& b) { return a.depth < b.depth; };
    constexpr std::uint32_t kMany = 32;
    for (std::size_t line = 0; line < lines; ++line) {
        InLine* const from = sorted_.data() + first_[line];
        const std::uint32_t count = first_[line + 1] - first_[line];
        if (count > kMany) {
            std::stable_sort(from, from + count, is_before);
            continue;
        }
        for (std::uint32_t i = 1; i < count; ++i) {
            const InLine next = from[i];
            std::uint32_t at = i;
            for (; at > 0 && next.depth < from[at - 1].depth; --at) {
                from[at] = from[at - 1];
            }
            from[at] = next;
        }
    }
    std::transform(
        sorted_.begin(), sorted_.end(), passed_.begin(), [](const InLine& f) { return f.passed; });
}

void Columns::sort_sparse_lines() {
    std::stable_sort(
        fragments_.begin(), fragments_.end(), [](const Fragment& a, const Fragment& b) {
            return a.line != b.line ? a.line < b.line : a.depth < b.depth;
        });
    for (std::size_t i = 0; i < fragments_.size(); ++i) {
        if (i == 0 || fragments_[i].line != fragments_[i - 1].line) {
            first_.push_back(static_cast<std::uint32_t>(i));
        }
        passed_.push_back(fragments_[i].passed);
    }
    first_.push_back(static_cast<std::uint32_t>(fragments_.size()));
}

}  // namespace quasimc
