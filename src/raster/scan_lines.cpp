#include "raster/scan_lines.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"

namespace quasimc {
namespace {

bool begins_before(const LinePiece& a, const LinePiece& b) {
    return a.low < b.low;
}

/// Sorts what is nearly sorted; what turns out not to be, as where light comes in low and lines are
/// far apart, in the same order, in n log n.
void sort_again(std::vector<LinePiece>& pieces) {
    constexpr std::size_t kMostMovesEach = 16;
    std::size_t moves_left = kMostMovesEach * pieces.size();
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        if (!begins_before(pieces[i], pieces[i - 1])) {
            continue;
        }
        const LinePiece moved = pieces[i];
        std::size_t to = i;
        for (; to > 0 && begins_before(moved, pieces[to - 1]); --to) {
            pieces[to] = pieces[to - 1];
        }
        pieces[to] = moved;
        if (i - to > moves_left) {
            std::stable_sort(pieces.begin(), pieces.end(), begins_before);
            return;
        }
        moves_left -= i - to;
    }
}

}  // namespace

void ScanLines::set(const ProjectedScene& scene, const Spec& spec) {
    EXPECT(spec.lines > 0);
    EXPECT(scene.roles.empty() || scene.roles.size() == scene.mesh->triangle_count());
    scene_ = scene;
    spec_ = spec;
    plane_.emplace(scene, spec.direction, spec.rotation, AlongPeriods::slanted);
    pitch_ = plane_->size_t / spec.lines;
    area_ = pitch_ * plane_->area;
    next_line_ = end_line_ = 0;
    find_images();
    sort_into_strips();
}

/// Finds the triangles, and in a scene that repeats itself their images, that touch the lines, with
/// the strips that they may touch.
void ScanLines::find_images() {
    images_.clear();
    for (std::uint32_t i = 0; i < scene_.mesh->triangle_count(); ++i) {
        scene_.check_stop();
        if (scene_.role(i) == VisibilityRole::left_out) {
            continue;
        }
        const auto [from, to] = scene_.extent(i, plane_->t);
        const Periods across =
            periods_of(from - plane_->low_t, to - plane_->low_t, plane_->size_t, plane_->repeats_t);
        for (std::int32_t k = across.first; k <= across.last; ++k) {
            const double offset = -k * plane_->size_t;
            if (plane_->repeats_s) {
                add_images_along({.triangle = i, .offset_t = offset});
            } else {
                add_image({.triangle = i, .offset_t = offset}, from + offset, to + offset);
            }
        }
    }
}

/// Adds the images along s of one that is known across the lines. Where light comes in low, a
/// triangle is seen long and slanted: of the periods that it reaches into most lie beside it.
void ScanLines::add_images_along(Image image) {
    constexpr double kRounding = 1e-9;
    const double margin_s = kRounding * plane_->size_s;
    const double margin_t = kRounding * plane_->size_t;
    const ProjectedTriangle at = seen(image);
    const auto in_t = extent_within(
        at.x, at.y, plane_->low_t - margin_t, plane_->low_t + plane_->size_t + margin_t);
    if (!in_t) {
        return;
    }
    const Periods along = periods_of(
        in_t->first - margin_s - plane_->low_s, in_t->second + margin_s - plane_->low_s,
        plane_->size_s, true);
    for (std::int32_t j = along.first; j <= along.last; ++j) {
        scene_.check_stop();
        image.offset_s = -j * plane_->size_s;
        const double begin = plane_->low_s - image.offset_s;
        const auto in_s =
            extent_within(at.y, at.x, begin - margin_s, begin + plane_->size_s + margin_s);
        if (in_s) {
            add_image(image, in_s->first - margin_t, in_s->second + margin_t);
        }
    }
}

/// Adds an image that is seen from place to place across the lines.
void ScanLines::add_image(Image image, double from, double to) {
    if (!may_be_cut(from, to)) {
        return;
    }
    // Lines stand at most one pitch from where they would be without shift.
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
    return plane_->low_t + (number + spec_.shift) * pitch_;
}

/// Whether a line runs between two places; in doubt it may.
bool ScanLines::may_be_cut(double from, double to) const {
    const double below = std::floor((from - plane_->low_t) / pitch_ - spec_.shift);
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
    std::vector<std::size_t> place(first_in_strip_.begin(), first_in_strip_.end() - 1);
    for (std::uint32_t i = 0; i < images_.size(); ++i) {
        scene_.check_stop();
        for (std::uint32_t s = images_[i].first_strip; s <= images_[i].last_strip; ++s) {
            in_strip_[place[s]++] = i;
        }
    }
}

ProjectedTriangle ScanLines::seen(const Image& image) const {
    return scene_.seen(
        image.triangle, {plane_->s, image.offset_s}, {plane_->t, image.offset_t},
        {plane_->depth, 0});
}

ScanLines::Slice ScanLines::slice_of(const ProjectedTriangle& seen) {
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

/// Triangles are read in the order in which they stand in memory, and sorted then.
void ScanLines::begin(std::uint32_t strip) {
    items_.clear();
    seen_.clear();
    slices_.clear();
    order_.clear();
    for (std::size_t i = first_in_strip_[strip]; i < first_in_strip_[strip + 1]; ++i) {
        // What is seen at less than this cosine, or has no area, is seen edge-on: corners are told
        // apart in single precision.
        constexpr double kEdgeOn = 0x1p-24;
        scene_.check_stop();
        const Image& image = images_[in_strip_[i]];
        const double cosine = scene_.cosine(image.triangle, spec_.direction);
        if (std::abs(cosine) > kEdgeOn) {
            items_.push_back({image.triangle, 0, cosine, 0});
            seen_.push_back(seen(image));
            slices_.push_back(slice_of(seen_.back()));
            order_.emplace_back(slices_.back().whole.t, static_cast<std::uint32_t>(order_.size()));
        }
    }
    std::sort(order_.begin(), order_.end());
    opaque_.clear();
    sensors_.clear();
    next_in_order_ = 0;
    next_line_ = strip * kStrip;
    end_line_ = std::min(next_line_ + kStrip, spec_.lines);
}

bool ScanLines::next() {
    if (next_line_ == end_line_) {
        return false;
    }
    line_ = line_at(next_line_);
    ++next_line_;
    cut_again(opaque_);
    cut_again(sensors_);
    add_new_cuts();
    envelope_.find(opaque_, pieces_, scene_.stop);
    before_.clear();
    for (const LinePiece& sensor : sensors_) {
        Envelope::seen_before(sensor, pieces_, before_);
    }
    pieces_.insert(pieces_.end(), before_.begin(), before_.end());
    for (const LinePiece& piece : pieces_) {
        Item& item = items_[piece.segment];
        item.length += piece.length();
        ++item.pieces;
    }
    return true;
}

/// Moves cuts of the last line to this one, and forgets what it has passed.
void ScanLines::cut_again(std::vector<LinePiece>& cuts) const {
    std::size_t kept = 0;
    for (const LinePiece& piece : cuts) {
        if (slices_[piece.segment].top >= line_) {
            cuts[kept++] = cut(piece.segment);
        }
    }
    cuts.resize(kept);
    sort_again(cuts);
}

void ScanLines::add_new_cuts() {
    new_opaque_.clear();
    new_sensors_.clear();
    for (; next_in_order_ < order_.size() && order_[next_in_order_].first < line_;
         ++next_in_order_) {
        const std::uint32_t item = order_[next_in_order_].second;
        if (slices_[item].top >= line_) {
            const bool sensor = scene_.role(items_[item].triangle) == VisibilityRole::sensor;
            (sensor ? new_sensors_ : new_opaque_).push_back(cut(item));
        }
    }
    const auto merge_in = [&](std::vector<LinePiece>& added, std::vector<LinePiece>& cuts) {
        if (added.empty()) {
            return;
        }
        std::sort(added.begin(), added.end(), begins_before);
        merged_.resize(cuts.size() + added.size());
        std::merge(
            cuts.begin(), cuts.end(), added.begin(), added.end(), merged_.begin(), begins_before);
        cuts.swap(merged_);
    };
    merge_in(new_opaque_, opaque_);
    merge_in(new_sensors_, sensors_);
}

/// What the line at hand cuts out of an item. In a scene that repeats itself along the line, of the
/// one period that the line is long.
LinePiece ScanLines::cut(std::uint32_t item) const {
    const Slice& slice = slices_[item];
    const Edge& other = line_ > slice.upper.t ? slice.upper : slice.lower;
    const double up = line_ - slice.whole.t;
    const double other_up = line_ - other.t;
    const double s = slice.whole.s + up * slice.whole.s_by_t;
    const double z = slice.whole.z + up * slice.whole.z_by_t;
    const double other_s = other.s + other_up * other.s_by_t;
    const double other_z = other.z + other_up * other.z_by_t;
    const double low = slice.is_middle_right ? s : other_s;
    const double high = slice.is_middle_right ? other_s : s;
    const double at_low = slice.is_middle_right ? z : other_z;
    const double at_high = slice.is_middle_right ? other_z : z;
    const LinePiece whole{low, high, at_low, (at_high - at_low) / (high - low), item};
    if (!plane_->repeats_s) {
        return whole;
    }
    return whole.part(std::max(low, plane_->low_s), std::min(high, plane_->low_s + plane_->size_s));
}

Barycentric ScanLines::place(const LinePiece& piece, double f) const {
    return seen_[piece.segment].place((1 - f) * piece.low + f * piece.high, line_);
}

}  // namespace quasimc
