#include "raster/scan_lines.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"

namespace quasimc {
namespace {

bool begins_before(const VisibleSegment& a, const VisibleSegment& b) {
    return a.low < b.low;
}

/// Sorts an almost sorted range; if it is not, as at low incidence with distant lines, into the
/// same order in n log n.
void sort_again(std::vector<VisibleSegment>& cuts) {
    constexpr std::size_t kMaxMovesEach = 16;
    std::size_t moves_left = kMaxMovesEach * cuts.size();
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (!begins_before(cuts[i], cuts[i - 1])) {
            continue;
        }
        const VisibleSegment moved = cuts[i];
        std::size_t to = i;
        for (; to > 0 && begins_before(moved, cuts[to - 1]); --to) {
            cuts[to] = cuts[to - 1];
        }
        cuts[to] = moved;
        if (i - to > moves_left) {
            std::stable_sort(cuts.begin(), cuts.end(), begins_before);
            return;
        }
        moves_left -= i - to;
    }
}

}  // namespace

ScanLines::ScanLines(const ProjectedScene& scene, const Spec& spec)
    : scene_(scene),
      spec_(spec),
      plane_(scene, spec.direction, spec.rotation, AlongPeriods::slanted),
      pitch_(plane_.size_t / spec.lines) {
    EXPECT(spec.lines > 0);
    EXPECT(scene.roles.empty() || scene.roles.size() == scene.mesh->triangle_count());
    find_images();
    sort_into_strips();
}

/// Finds the triangles, and their periodic images, that touch the lines, and the strips that they
/// may touch.
void ScanLines::find_images() {
    images_.reserve(scene_.mesh->triangle_count());
    for (std::uint32_t i = 0; i < scene_.mesh->triangle_count(); ++i) {
        scene_.check_stop();
        if (scene_.role(i) == VisibilityRole::omitted) {
            continue;
        }
        const auto [from, to] = scene_.extent(i, plane_.t);
        const Periods across =
            periods_of(from - plane_.low_t, to - plane_.low_t, plane_.size_t, plane_.repeats_t);
        for (std::int32_t k = across.first; k <= across.last; ++k) {
            const double offset = -k * plane_.size_t;
            if (plane_.repeats_s) {
                add_images_along({.triangle = i, .offset_t = offset});
            } else {
                add_image({.triangle = i, .offset_t = offset}, from + offset, to + offset);
            }
        }
    }
}

/// Adds the images along s of an image with a known position across the lines. At low incidence a
/// projected triangle is long and slanted, and misses most of the periods in its bounding box.
void ScanLines::add_images_along(Image image) {
    constexpr double kRounding = 1e-9;
    const double margin_s = kRounding * plane_.size_s;
    const double margin_t = kRounding * plane_.size_t;
    const ProjectedTriangle at = seen(image);
    const auto in_t =
        extent_within(at.x, at.y, plane_.low_t - margin_t, plane_.low_t + plane_.size_t + margin_t);
    if (!in_t) {
        return;
    }
    const Periods along = periods_of(
        in_t->first - margin_s - plane_.low_s, in_t->second + margin_s - plane_.low_s,
        plane_.size_s, true);
    for (std::int32_t j = along.first; j <= along.last; ++j) {
        scene_.check_stop();
        image.offset_s = -j * plane_.size_s;
        const double begin = plane_.low_s - image.offset_s;
        const auto in_s =
            extent_within(at.y, at.x, begin - margin_s, begin + plane_.size_s + margin_s);
        if (in_s) {
            add_image(image, in_s->first - margin_t, in_s->second + margin_t);
        }
    }
}

/// Adds an image that reaches from `from` to `to` across the lines.
void ScanLines::add_image(Image image, double from, double to) {
    if (!may_be_cut(from, to)) {
        return;
    }
    // The shift moves lines by at most one pitch.
    const double last = strips(spec_.lines) - 1;
    const auto strip_of = [&](double t) {
        const double strip = (t - line_at(0)) / (pitch_ * kStrip);
        return static_cast<std::uint32_t>(std::clamp(std::floor(strip), 0.0, last));
    };
    image.first_strip = strip_of(from);
    image.last_strip = strip_of(to);
    images_.push_back(image);
}

double ScanLines::line_at(double number) const {
    return plane_.low_t + (number + spec_.shift) * pitch_;
}

/// Whether a line may run between two positions across the lines.
bool ScanLines::may_be_cut(double from, double to) const {
    const double below = std::floor((from - plane_.low_t) / pitch_ - spec_.shift);
    return line_at(below) > from || line_at(below + 1) <= to;
}

void ScanLines::sort_into_strips() {
    first_in_strip_.assign(std::size_t{strips(spec_.lines)} + 1, 0);
    for (const Image& image : images_) {
        scene_.check_stop();
        for (std::uint32_t strip = image.first_strip; strip <= image.last_strip; ++strip) {
            ++first_in_strip_[strip + 1];
        }
    }
    for (std::size_t strip = 1; strip < first_in_strip_.size(); ++strip) {
        first_in_strip_[strip] += first_in_strip_[strip - 1];
    }
    in_strip_.resize(first_in_strip_.back());
    std::vector<std::size_t> next(first_in_strip_.begin(), first_in_strip_.end() - 1);
    for (std::uint32_t i = 0; i < images_.size(); ++i) {
        scene_.check_stop();
        for (std::uint32_t s = images_[i].first_strip; s <= images_[i].last_strip; ++s) {
            in_strip_[next[s]++] = i;
        }
    }
}

ProjectedTriangle ScanLines::seen(const Image& image) const {
    return scene_.seen(
        image.triangle, {plane_.s, image.offset_s}, {plane_.t, image.offset_t}, {plane_.depth, 0});
}

LineScratch::Slice LineScratch::slice_of(const ProjectedTriangle& seen) {
    const auto [low, middle, high] = seen.upwards();
    const auto edge = [&](int from, int to) {
        const double height = seen.y[to] - seen.y[from];
        return Edge{
            seen.x[from], seen.y[from], seen.z[from], (seen.x[to] - seen.x[from]) / height,
            (seen.z[to] - seen.z[from]) / height};
    };
    const Edge whole = edge(low, high);
    const double opposite = whole.s + (seen.y[middle] - whole.t) * whole.s_by_t;
    return {whole, edge(low, middle), edge(middle, high), seen.y[high], seen.x[middle] > opposite};
}

/// Triangles are read in memory order, then sorted.
LineStrip::LineStrip(const ScanLines& lines, std::uint32_t strip, LineScratch& scratch)
    : lines_(lines),
      scratch_(scratch),
      first_line_(strip * ScanLines::kStrip),
      end_line_(std::min(first_line_ + ScanLines::kStrip, lines.spec_.lines)) {
    scratch_.triangles_.clear();
    scratch_.seen_.clear();
    scratch_.slices_.clear();
    scratch_.order_.clear();
    std::uint32_t triangles = 0;
    for (std::size_t i = lines.first_in_strip_[strip]; i < lines.first_in_strip_[strip + 1]; ++i) {
        // Triangles with a smaller cosine, or without area, count as edge-on: corners have single
        // precision.
        constexpr double kEdgeOn = 0x1p-24;
        lines.scene_.check_stop();
        const ScanLines::Image& image = lines.images_[lines.in_strip_[i]];
        const double cosine = lines.scene_.cosine(image.triangle, lines.spec_.direction);
        if (std::abs(cosine) > kEdgeOn) {
            scratch_.triangles_.push_back({image.triangle, cosine});
            scratch_.seen_.push_back(lines.seen(image));
            scratch_.slices_.push_back(LineScratch::slice_of(scratch_.seen_.back()));
            scratch_.order_.emplace_back(scratch_.slices_.back().whole.t, triangles++);
        }
    }
    std::sort(scratch_.order_.begin(), scratch_.order_.end());
}

std::span<const LineStrip::Triangle> LineStrip::triangles() const {
    return scratch_.triangles_;
}

std::span<const LineStrip::Visible> LineStrip::visible() const {
    return scratch_.visible_;
}

Barycentric LineStrip::point(const Line& line, const VisibleSegment& segment, double f) const {
    return scratch_.seen_[segment.surface].barycentric(
        (1 - f) * segment.low + f * segment.high, line.t);
}

void LineStrip::clear_cuts() const {
    scratch_.visible_.assign(scratch_.triangles_.size(), {});
    scratch_.opaque_.clear();
    scratch_.sensors_.clear();
    scratch_.next_in_order_ = 0;
}

/// Intersects the next line with the triangles.
LineStrip::Line LineStrip::cut_line(std::uint32_t number) const {
    const double t = lines_.line_at(number);
    cut_again(t, scratch_.opaque_);
    cut_again(t, scratch_.sensors_);
    add_new_cuts(t);
    std::vector<VisibleSegment>& segments = scratch_.segments_;
    scratch_.envelope_.find(scratch_.opaque_, segments, lines_.scene_.stop);
    scratch_.before_.clear();
    for (const VisibleSegment& sensor : scratch_.sensors_) {
        Envelope::seen_before(sensor, segments, scratch_.before_);
    }
    segments.insert(segments.end(), scratch_.before_.begin(), scratch_.before_.end());
    for (const VisibleSegment& segment : segments) {
        Visible& sum = scratch_.visible_[segment.surface];
        sum.length += segment.length();
        ++sum.segments;
    }
    return {number, t, segments};
}

/// Copies the segments of the last line to this one, without triangles that end before it.
void LineStrip::cut_again(double t, std::vector<VisibleSegment>& cuts) const {
    std::size_t left = 0;
    for (const VisibleSegment& segment : cuts) {
        if (scratch_.slices_[segment.surface].top >= t) {
            cuts[left++] = cut(t, segment.surface);
        }
    }
    cuts.resize(left);
    sort_again(cuts);
}

void LineStrip::add_new_cuts(double t) const {
    std::vector<VisibleSegment>& new_opaque = scratch_.new_opaque_;
    std::vector<VisibleSegment>& new_sensors = scratch_.new_sensors_;
    new_opaque.clear();
    new_sensors.clear();
    std::size_t& next = scratch_.next_in_order_;
    for (; next < scratch_.order_.size() && scratch_.order_[next].first < t; ++next) {
        const std::uint32_t i = scratch_.order_[next].second;
        if (scratch_.slices_[i].top >= t) {
            const bool sensor =
                lines_.scene_.role(scratch_.triangles_[i].triangle) == VisibilityRole::sensor;
            (sensor ? new_sensors : new_opaque).push_back(cut(t, i));
        }
    }
    const auto merge_in = [&](std::vector<VisibleSegment>& added,
                              std::vector<VisibleSegment>& cuts) {
        if (added.empty()) {
            return;
        }
        std::vector<VisibleSegment>& merged = scratch_.merged_;
        std::sort(added.begin(), added.end(), begins_before);
        merged.resize(cuts.size() + added.size());
        std::merge(
            cuts.begin(), cuts.end(), added.begin(), added.end(), merged.begin(), begins_before);
        cuts.swap(merged);
    };
    merge_in(new_opaque, scratch_.opaque_);
    merge_in(new_sensors, scratch_.sensors_);
}

/// Intersects a line with a triangle. In a scene that is periodic along the line, the line is one
/// period long.
VisibleSegment LineStrip::cut(double t, std::uint32_t triangle) const {
    const LineScratch::Slice& slice = scratch_.slices_[triangle];
    const LineScratch::Edge& other = t > slice.upper.t ? slice.upper : slice.lower;
    const double up = t - slice.whole.t;
    const double other_up = t - other.t;
    const double s = slice.whole.s + up * slice.whole.s_by_t;
    const double z = slice.whole.z + up * slice.whole.z_by_t;
    const double other_s = other.s + other_up * other.s_by_t;
    const double other_z = other.z + other_up * other.z_by_t;
    const double low = slice.is_middle_right ? s : other_s;
    const double high = slice.is_middle_right ? other_s : s;
    const double at_low = slice.is_middle_right ? z : other_z;
    const double at_high = slice.is_middle_right ? other_z : z;
    const VisibleSegment whole{low, high, at_low, (at_high - at_low) / (high - low), triangle};
    const ProjectionPlane& plane = lines_.plane_;
    if (!plane.repeats_s) {
        return whole;
    }
    return whole.part(std::max(low, plane.low_s), std::min(high, plane.low_s + plane.size_s));
}

}  // namespace quasimc
