#include "raster/line_hits.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace quasimc {
namespace {

/// Largest number of lines of a beam: they are numbered, and no scene needs more.
constexpr double kMaxLines = 1U << 30U;
/// Above this number of lines per hit, lines are not counted one by one.
constexpr std::size_t kSparse = 16;
constexpr BlockPeriods kUnmoved{};

/// Whether a direction lies within the field of view of a sensor.
bool is_in_view(
    const TriangleBlock& corners, std::size_t lane, double least_cosine, const Vec3& direction) {
    const auto corner = [&](std::size_t i) {
        const auto& at = corners.at[i];
        return Vec3{at[0][lane], at[1][lane], at[2][lane]};
    };
    const Vec3 across = cross(corner(1) - corner(0), corner(2) - corner(0));
    return std::abs(dot(across, direction)) >= least_cosine * length(across);
}

/// The hit of a line on the first patch of a triangle, if light along it comes to the upper side.
LineHits::Hit first_hit(const LineTriangle& triangle) {
    return (triangle.is_sensor ? LineHits::kSensor : 0) | 2 * triangle.first_patch;
}

/// i modulo n, 0 <= result < n.
std::int64_t wrapped(std::int64_t i, std::int64_t n) {
    if (i >= 0 && i < n) {
        return i;
    }
    const std::int64_t rest = i % n;
    return rest < 0 ? rest + n : rest;
}

/// Puts the smaller one first, without a branch: the order is unpredictable.
void put_in_order(std::uint64_t& a, std::uint64_t& b) {
    const std::uint64_t smaller = std::min(a, b);
    b = std::max(a, b);
    a = smaller;
}

/// Sorts the hits of a line: usually few.
void sort_keys(std::uint64_t* keys, std::uint32_t count) {
    constexpr std::uint32_t kMany = 32;
    switch (count) {
        case 0:
        case 1:
            break;
        case 2:
            put_in_order(keys[0], keys[1]);
            break;
        case 3:
            put_in_order(keys[0], keys[1]);
            put_in_order(keys[1], keys[2]);
            put_in_order(keys[0], keys[1]);
            break;
        case 4:
            put_in_order(keys[0], keys[1]);
            put_in_order(keys[2], keys[3]);
            put_in_order(keys[0], keys[2]);
            put_in_order(keys[1], keys[3]);
            put_in_order(keys[1], keys[2]);
            break;
        default:
            if (count > kMany) {
                std::sort(keys, keys + count);
                break;
            }
            for (std::uint32_t i = 1; i < count; ++i) {
                const std::uint64_t next = keys[i];
                std::uint32_t at = i;
                for (; at > 0 && next < keys[at - 1]; --at) {
                    keys[at] = keys[at - 1];
                }
                keys[at] = next;
            }
    }
}

}  // namespace

LineTriangles line_triangles(
    const ProjectedScene& scene, const Patches& patches, std::span<const float> least_cosines) {
    LineTriangles triangles;
    for (std::uint32_t i = 0; i < patches.triangles(); ++i) {
        if (!patches.has(i)) {
            continue;
        }
        const std::size_t lane = triangles.each.size() % kBlockLanes;
        if (lane == 0) {
            triangles.corners.push_back({});
            triangles.patches.push_back({});
            triangles.plain.push_back(0);
        }
        triangles.corners.back().set(lane, *scene.mesh, i);
        triangles.each.push_back(
            {.first_patch = patches.first(i),
             .level = static_cast<std::uint8_t>(patches.level(i)),
             .is_sensor = scene.role(i) == VisibilityRole::sensor,
             .least_cosine = least_cosines.empty() ? 0 : least_cosines[i],
             .cut = patches.cut_of(i)});
        const LineTriangle& triangle = triangles.each.back();
        triangles.patches.back().parts[lane] = std::ldexp(1.0, triangle.level);
        triangles.patches.back().hit[lane] = first_hit(triangle);
        const bool is_plain = triangle.cut == nullptr && !(triangle.least_cosine > 0);
        triangles.plain.back() |= static_cast<std::uint8_t>(is_plain ? 1U << lane : 0);
    }
    return triangles;
}

/// Finds the hits of one beam.
class LineHitFinder {
  public:
    LineHitFinder(
        const ProjectedScene& scene,
        const LineTriangles& triangles,
        const LineHits::Spec& spec,
        LineHitScratch& scratch)
        : triangles_(triangles), direction_(spec.direction), scratch_(scratch) {
        scratch.first_.clear();
        scratch.counts_.assign(triangles.each.size(), 0);
        set_grid(scene, spec);
    }

    LineHits find() {
        if (grid_.columns > 0) {
            is_turned_ = dot(cross(grid_.x.along, grid_.y.along), direction_) < 0;
            for (std::size_t block = 0; block < triangles_.corners.size(); ++block) {
                draw_block(block);
            }
            sort_lines();
        }
        found_.counts_ = scratch_.counts_;
        found_.first_ = scratch_.first_;
        found_.hits_ = scratch_.hits_.data();
        found_.keys_ = scratch_.sorted_.data();
        return found_;
    }

  private:
    using Hit = LineHits::Hit;

    /// Across an open scene lines form squares. Each period of a periodic scene has a whole number
    /// of them.
    void set_grid(const ProjectedScene& scene, const LineHits::Spec& spec) {
        const ProjectionPlane plane(scene, spec.direction, spec.rotation, AlongPeriods::straight);
        if (!(plane.size_s > 0 && plane.size_t > 0)) {
            return;  // edge-on
        }
        grid_.repeats_x = plane.repeats_s;
        grid_.repeats_y = plane.repeats_t;
        const double area = plane.size_s * plane.size_t * plane.area;
        const double lines = std::clamp(area / spec.line_area, 1.0, kMaxLines);
        if (grid_.repeats_x && grid_.repeats_y) {
            set_square_rows(plane, spec, lines);
            return;
        }
        const double pitch = std::max(
            std::sqrt(plane.size_s * plane.size_t / lines),
            std::max(plane.size_s, plane.size_t) / lines);
        const auto steps = [&](double size, bool repeats) {
            return std::max(1.0, repeats ? std::round(size / pitch) : std::ceil(size / pitch));
        };
        const double across = steps(plane.size_s, grid_.repeats_x);
        const double up = steps(plane.size_t, grid_.repeats_y);
        const double pitch_x = grid_.repeats_x ? plane.size_s / across : pitch;
        const double pitch_y = grid_.repeats_y ? plane.size_t / up : pitch;
        grid_.columns = static_cast<std::int64_t>(across);
        grid_.rows = static_cast<std::int64_t>(up);
        grid_.x = {plane.s / pitch_x, -plane.low_s / pitch_x - spec.shift_s};
        grid_.y = {plane.t / pitch_y, -plane.low_t / pitch_y - spec.shift_t};
        grid_.z = {plane.depth, 0};
        found_.line_area_ = pitch_x * pitch_y * plane.area;
    }

    /// In a layer: the number of columns that makes squares across the beam, not on the horizontal,
    /// and an offset of each row from the last that avoids rhombs.
    void set_square_rows(const ProjectionPlane& plane, const LineHits::Spec& spec, double lines) {
        // Steps along s and t on the horizontal, as projected across the beam.
        const Vec3 s{plane.s.x, plane.s.y, 0};
        const Vec3 t{plane.t.x, plane.t.y, 0};
        const double along_s = dot(s, spec.direction);
        const double ss = dot(s, s) - along_s * along_s;
        const double st = dot(s, t) - along_s * dot(t, spec.direction);
        const double side = std::sqrt(plane.size_s * plane.size_t * plane.area / lines);
        const double across =
            std::clamp(std::round(plane.size_s * std::sqrt(ss) / side), 1.0, std::floor(lines));
        const double up = std::max(1.0, std::round(lines / across));
        grid_.columns = static_cast<std::int64_t>(across);
        grid_.rows = static_cast<std::int64_t>(up);
        const double pitch_x = plane.size_s / across;
        const double pitch_y = plane.size_t / up;
        grid_.x = {plane.s / pitch_x, -plane.low_s / pitch_x - spec.shift_s};
        grid_.y = {plane.t / pitch_y, -plane.low_t / pitch_y - spec.shift_t};
        grid_.z = {plane.depth, 0};
        grid_.row_shift = ss > 0 ? -pitch_y * st / ss / pitch_x : 0;
        found_.line_area_ = pitch_x * pitch_y * plane.area;
    }

    void draw_block(std::size_t block) {
        const TriangleBlock& corners = triangles_.corners[block];
        BlockSpans& spans = scratch_.spans_;
        if (!loops_.set(corners, kUnmoved, grid_, spans)) {
            return;
        }
        std::uint32_t* counts = &scratch_.counts_[block * kBlockLanes];
        const LineTriangle* each = &triangles_.each[block * kBlockLanes];
        // Light comes to the lower side if the corners turn left as seen along it.
        BlockPatches patches = triangles_.patches[block];
        for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
            patches.hit[lane] |= (spans.twice_area[lane] > 0) != is_turned_ ? 1U : 0U;
        }
        const std::uint32_t plain = triangles_.plain[block];
        while (loops_.next(grid_, spans)) {
            std::size_t hits = 0;
            spans.for_each([&](std::size_t lane, std::size_t span) {
                const LineTriangle& triangle = each[lane];
                const auto count = static_cast<std::uint32_t>(spans.last[span] - spans.first[span]);
                if ((plain >> lane & 1U) != 0) {
                    hits += count;
                } else if (
                    !(triangle.least_cosine > 0) ||
                    is_in_view(corners, lane, double{triangle.least_cosine}, direction_)) {
                    draw_span(triangle, lane, span);
                } else {
                    return;
                }
                counts[lane] += count;
            });
            reserve(hits);
            found_.size_ += loops_.write_hits(
                grid_, spans, patches, plain,
                {scratch_.lines_.data() + found_.size_, scratch_.keys_.data() + found_.size_});
        }
    }

    void draw_span(const LineTriangle& triangle, std::size_t lane, std::size_t span) {
        const BlockSpans& spans = scratch_.spans_;
        const auto gradient = [lane](const BlockGradient& g) {
            return PlaneGradient{g.at[lane], g.by_x[lane], g.by_y[lane]};
        };
        const PlaneGradient of_depth = gradient(spans.depth);
        const PlaneGradient of_u = gradient(spans.u), of_v = gradient(spans.v);
        const double y = spans.y[span], shift = spans.shift[span];
        const double z = of_depth.at + of_depth.by_y * y;
        const double u = of_u.at + of_u.by_y * y;
        const double v = of_v.at + of_v.by_y * y;
        const double low = spans.low_depth[lane], high = spans.high_depth[lane];
        // Light comes to the lower side if the corners turn left as seen along it.
        const Hit lower = (spans.twice_area[lane] > 0) != is_turned_ ? 1 : 0;
        const Hit hit = first_hit(triangle) | lower;
        const auto first = static_cast<std::int64_t>(spans.first[span]);
        const auto last = static_cast<std::int64_t>(spans.last[span]);
        const auto row_begin = static_cast<std::int64_t>(spans.in_row[span]) * grid_.columns;
        std::int64_t line = grid_.repeats_x ? wrapped(first, grid_.columns) : first;
        reserve(static_cast<std::size_t>(last - first));
        std::uint32_t* next_line = scratch_.lines_.data() + found_.size_;
        std::uint64_t* next_key = scratch_.keys_.data() + found_.size_;
        found_.size_ += static_cast<std::size_t>(last - first);
        for (std::int64_t column = first; column < last; ++column) {
            const double x = static_cast<double>(column) + shift;
            const double depth = std::clamp(z + of_depth.by_x * x, low, high);
            std::uint32_t part = 0;
            if (triangle.level > 0) {
                const double at_u = u + of_u.by_x * x;
                const double at_v = v + of_v.by_x * x;
                part = TriangleParts(triangle.level).at(at_u, at_v);
                part = triangle.cut == nullptr ? part : triangle.cut->patch(part, at_u, at_v);
            }
            *next_line++ = static_cast<std::uint32_t>(row_begin + line);
            *next_key++ = depth_key(static_cast<float>(depth), hit + 2 * part);
            ++line;
            line = line == grid_.columns && grid_.repeats_x ? 0 : line;
        }
    }

    /// Makes room for `more` hits.
    void reserve(std::size_t more) {
        if (scratch_.keys_.size() < found_.size_ + more) {
            scratch_.lines_.resize(2 * found_.size_ + more);
            scratch_.keys_.resize(scratch_.lines_.size());
        }
    }

    /// Sorts hits by line, and along each by depth.
    void sort_lines() {
        const auto lines = static_cast<std::size_t>(grid_.columns * grid_.rows);
        const std::size_t size = found_.size_;
        std::vector<std::uint64_t>& sorted = scratch_.sorted_;
        std::vector<Hit>& hits = scratch_.hits_;
        if (hits.size() < size + LineHits::kReadAhead) {
            hits.resize(scratch_.keys_.size() + LineHits::kReadAhead);
            sorted.resize(scratch_.keys_.size());
        }
        if (lines > kSparse * size + kSparse) {
            sort_sparse_lines();
            return;
        }
        std::vector<std::uint32_t>& first = scratch_.first_;
        first.assign(lines + 1, 0);
        for (std::size_t i = 0; i < size; ++i) {
            ++first[scratch_.lines_[i]];
        }
        std::uint32_t end = 0;
        for (std::uint32_t& each : first) {
            end += each;
            each = end;
        }
        for (std::size_t i = 0; i < size; ++i) {
            sorted[--first[scratch_.lines_[i]]] = scratch_.keys_[i];
        }
        for (std::size_t line = 0; line < lines; ++line) {
            sort_keys(sorted.data() + first[line], first[line + 1] - first[line]);
        }
        for (std::size_t i = 0; i < size; ++i) {
            hits[i] = static_cast<Hit>(sorted[i]);
        }
    }

    void sort_sparse_lines() {
        const std::vector<std::uint32_t>& lines = scratch_.lines_;
        const std::vector<std::uint64_t>& keys = scratch_.keys_;
        std::vector<std::uint32_t> order(found_.size_);
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return lines[a] != lines[b] ? lines[a] < lines[b] : keys[a] < keys[b];
        });
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (i == 0 || lines[order[i]] != lines[order[i - 1]]) {
                scratch_.first_.push_back(static_cast<std::uint32_t>(i));
            }
            scratch_.sorted_[i] = keys[order[i]];
            scratch_.hits_[i] = static_cast<Hit>(keys[order[i]]);
        }
        scratch_.first_.push_back(static_cast<std::uint32_t>(order.size()));
    }

    const LineTriangles& triangles_;
    Vec3 direction_;
    LineHitScratch& scratch_;
    SpanLoops loops_ = best_span_loops();
    RasterGrid grid_;
    bool is_turned_ = false;  // grid and direction form a left-handed frame
    LineHits found_;
};

LineHits find_line_hits(
    const ProjectedScene& scene,
    const LineTriangles& triangles,
    const LineHits::Spec& spec,
    LineHitScratch& scratch) {
    scene.check_stop();
    return LineHitFinder(scene, triangles, spec, scratch).find();
}

}  // namespace quasimc
