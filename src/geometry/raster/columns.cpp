#include "geometry/raster/columns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace quasimc {
namespace {

/// Lines of a beam, at most: they are numbered, and no scene needs more.
constexpr double kMostLines = 1U << 30U;
/// Where lines are so many for each fragment, they are not counted one by one.
constexpr std::size_t kSparse = 16;

/// The smallest integer >= x. Without a call of the library.
std::int64_t ceil_of(double x) {
    const auto whole = static_cast<std::int64_t>(x);
    return whole + (static_cast<double>(whole) < x ? 1 : 0);
}

/// Whether a direction lies within the field of view of a sensor.
bool is_in_view(const ColumnTriangle& triangle, const Vec3& direction) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3 across = cross(b - a, c - a);
    return std::abs(dot(across, direction)) >=
           static_cast<double>(triangle.least_cosine) * length(across);
}

/// i modulo n, 0 <= result < n.
std::int64_t wrapped(std::int64_t i, std::int64_t n) {
    if (i >= 0 && i < n) {
        return i;
    }
    const std::int64_t rest = i % n;
    return rest < 0 ? rest + n : rest;
}

}  // namespace

std::vector<ColumnTriangle> column_triangles(
    const ProjectedScene& scene, const Patches& patches, std::span<const float> least_cosines) {
    std::vector<ColumnTriangle> triangles;
    for (std::uint32_t i = 0; i < patches.triangles(); ++i) {
        if (!patches.has(i)) {
            continue;
        }
        const LocalMesh& mesh = *scene.mesh;
        triangles.push_back(
            {.corners = {mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2)},
             .first_patch = patches.first(i),
             .level = static_cast<std::uint8_t>(patches.level(i)),
             .is_sensor = scene.role(i) == VisibilityRole::sensor,
             .least_cosine = least_cosines.empty() ? 0 : least_cosines[i],
             .cut = patches.cut_of(i)});
    }
    return triangles;
}

void Columns::draw(
    const ProjectedScene& scene, std::span<const ColumnTriangle> triangles, const Spec& spec) {
    fragments_.clear();
    sorted_.clear();
    passed_.clear();
    first_.clear();
    set_grid(scene, spec);
    if (columns_ == 0) {
        return;
    }
    direction_ = spec.direction;
    is_turned_ = dot(cross(x_.along, y_.along), direction_) < 0;
    scene.check_stop();
    for (const ColumnTriangle& triangle : triangles) {
        draw_triangle(triangle);
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

void Columns::draw_triangle(const ColumnTriangle& triangle) {
    ProjectedTriangle c{};
    for (std::size_t i = 0; i < 3; ++i) {
        c.x[i] = dot(x_.along, triangle.corners[i]) + x_.offset;
        c.y[i] = dot(y_.along, triangle.corners[i]) + y_.offset;
    }
    std::int64_t row = ceil_of(std::min({c.y[0], c.y[1], c.y[2]}));
    std::int64_t end_row = ceil_of(std::max({c.y[0], c.y[1], c.y[2]}));
    if (!repeats_y_) {
        row = std::max<std::int64_t>(row, 0);
        end_row = std::min(end_row, rows_);
    }
    if (row >= end_row || TrianglePlane(c).is_edge_on()) {
        return;
    }
    bool is_seen = false;
    const SidesByRow sides(c);
    for (; row < end_row; ++row) {
        const std::int64_t in_row = repeats_y_ ? wrapped(row, rows_) : row;
        const double shift = row_shift_ == 0 ? 0 : shift_of(in_row);
        const auto [left, right] = sides.at(static_cast<double>(row));
        std::int64_t first = ceil_of(left - shift);
        std::int64_t last = ceil_of(right - shift);
        if (!repeats_x_) {
            first = std::max<std::int64_t>(first, 0);
            last = std::min(last, columns_);
        }
        if (first >= last) {
            continue;
        }
        if (!is_seen) {
            if (triangle.least_cosine > 0 && !is_in_view(triangle, direction_)) {
                return;
            }
            set_gradients(triangle, c);
            is_seen = true;
        }
        draw_stretch({row, in_row, first, last, shift});
    }
}

/// How far a row stands beside its columns, 0..1.
double Columns::shift_of(std::int64_t row) const {
    const double moved = static_cast<double>(row) * row_shift_;
    return moved - std::floor(moved);
}

/// Sets how depth and the place on the triangle change over the grid.
void Columns::set_gradients(const ColumnTriangle& triangle, const ProjectedTriangle& corners) {
    const TrianglePlane plane(corners);
    const auto depth = [&](std::size_t i) { return dot(z_.along, triangle.corners[i]); };
    const double z = depth(0);
    const double a = depth(1);
    const double b = depth(2);
    std::tie(low_z_, high_z_) = std::minmax({z, a, b});
    z_of_ = plane.gradient(z, a - z, b - z);
    u_of_ = plane.gradient(0, 1, 0);
    v_of_ = plane.gradient(0, 0, 1);
    level_ = triangle.level;
    cut_ = triangle.cut;
    // Light comes to the lower side if the corners turn to the left, seen along it.
    const Passed lower = plane.turns_left() != is_turned_ ? 1 : 0;
    first_passed_ = (triangle.is_sensor ? kSensor : 0) | (2 * triangle.first_patch + lower);
}

void Columns::draw_stretch(const Stretch& stretch) {
    const auto y = static_cast<double>(stretch.row);
    const double z = z_of_.at + z_of_.by_y * y;
    const double u = u_of_.at + u_of_.by_y * y;
    const double v = v_of_.at + v_of_.by_y * y;
    const auto first_line = static_cast<std::uint32_t>(stretch.in_row * columns_);
    std::int64_t line = repeats_x_ ? wrapped(stretch.first, columns_) : stretch.first;
    const std::size_t before = fragments_.size();
    fragments_.resize(before + static_cast<std::size_t>(stretch.last - stretch.first));
    Fragment* to = fragments_.data() + before;
    for (std::int64_t column = stretch.first; column < stretch.last; ++column) {
        const double x = static_cast<double>(column) + stretch.shift;
        const double depth = std::clamp(z + z_of_.by_x * x, low_z_, high_z_);
        std::uint32_t part = 0;
        if (level_ > 0) {
            const double at_u = u + u_of_.by_x * x;
            const double at_v = v + v_of_.by_x * x;
            part = Patches::part(level_, at_u, at_v);
            part = cut_ == nullptr ? part : cut_->patch(part, at_u, at_v);
        }
        *to++ = {
            first_line + static_cast<std::uint32_t>(line), static_cast<float>(depth),
            first_passed_ + 2 * part};
        ++line;
        line = line == columns_ && repeats_x_ ? 0 : line;
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
