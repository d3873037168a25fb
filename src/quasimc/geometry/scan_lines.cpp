#include "quasimc/geometry/scan_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "quasimc/base/checks.h"

namespace quasimc {
namespace {

/// What is seen at less than this cosine, or has no area, is seen edge-on: corners are told apart
/// in single precision.
constexpr double kEdgeOn = 0x1p-24;

}  // namespace

void ScanLines::set(const BeamScene& scene, const Spec& spec) {
    EXPECT(spec.lines > 0);
    EXPECT(scene.roles.empty() || scene.roles.size() == scene.mesh->triangle_count());
    scene_ = scene;
    spec_ = spec;
    plane_.emplace(scene, spec.direction, spec.rotation, AlongPeriods::slanted);
    pitch_ = plane_->size_t / spec.lines;
    area_ = pitch_ * plane_->area;
    find_images();
    fill_bins();
}

/// Finds the triangles, and in a scene that repeats itself across the lines their images, with the
/// bins that they may touch.
void ScanLines::find_images() {
    images_.clear();
    range_.clear();
    const double low = plane_->low_t;
    const double period = plane_->size_t;
    const std::uint32_t last_bin = bins(spec_.lines) - 1;
    const double per_length = pitch_ > 0 ? 1 / (pitch_ * kBin) : 0;
    // Lines stand at most one pitch from where they would be without shift.
    const auto bin_of = [&](double t) {
        const double bin = std::floor((t - low - pitch_ * spec_.shift) * per_length);
        return static_cast<std::uint32_t>(std::clamp(bin, 0.0, static_cast<double>(last_bin)));
    };
    for (std::uint32_t i = 0; i < scene_.mesh->triangle_count(); ++i) {
        if (scene_.role(i) == SeenAs::left_out) {
            continue;
        }
        const double a = dot(plane_->t, scene_.mesh->vertex(i, 0));
        const double b = dot(plane_->t, scene_.mesh->vertex(i, 1));
        const double c = dot(plane_->t, scene_.mesh->vertex(i, 2));
        const double from = std::min({a, b, c});
        const double to = std::max({a, b, c});
        const Periods periods = periods_of(from - low, to - low, period, plane_->repeats_t);
        for (std::int32_t k = periods.first; k <= periods.last; ++k) {
            const double offset = -k * period;
            images_.push_back({i, offset});
            range_.push_back({bin_of(from + offset), bin_of(to + offset)});
        }
    }
}

void ScanLines::fill_bins() {
    first_in_bin_.assign(std::size_t{bins(spec_.lines)} + 1, 0);
    for (const BinRange& range : range_) {
        for (std::uint32_t bin = range.first; bin <= range.last; ++bin) {
            ++first_in_bin_[bin + 1];
        }
    }
    for (std::size_t bin = 1; bin < first_in_bin_.size(); ++bin) {
        first_in_bin_[bin] += first_in_bin_[bin - 1];
    }
    entries_.resize(first_in_bin_.back());
    std::vector<std::uint32_t> next(first_in_bin_.begin(), first_in_bin_.end() - 1);
    for (std::size_t i = 0; i < images_.size(); ++i) {
        for (std::uint32_t bin = range_[i].first; bin <= range_[i].last; ++bin) {
            entries_[next[bin]++] = images_[i];
        }
    }
}

ScanLines::Corners ScanLines::corners_of(const Entry& entry) const {
    Corners corners{};
    corners.triangle = entry.triangle;
    corners.transparent = scene_.role(entry.triangle) == SeenAs::sensor;
    for (int i = 0; i < 3; ++i) {
        const Vec3 p = scene_.mesh->vertex(entry.triangle, i);
        corners.s[i] = dot(plane_->s, p);
        corners.t[i] = dot(plane_->t, p) + entry.offset;
        corners.z[i] = dot(plane_->depth, p);
    }
    const Vec3 up = scene_.mesh->across(entry.triangle);
    const double size = length(up);
    corners.cosine = size > 0 ? dot(up, spec_.direction) / size : 0;
    return corners;
}

void ScanLines::visit(std::uint32_t bin, const std::function<void(const LitSegment&)>& visit) {
    corners_.clear();
    for (std::uint32_t i = first_in_bin_[bin]; i < first_in_bin_[bin + 1]; ++i) {
        const Corners corners = corners_of(entries_[i]);
        if (std::abs(corners.cosine) > kEdgeOn) {
            corners_.push_back(corners);
        }
    }
    const std::uint32_t end = std::min((bin + 1) * kBin, spec_.lines);
    for (std::uint32_t line = bin * kBin; line < end; ++line) {
        cut_all(plane_->low_t + (line + spec_.shift) * pitch_);
        const std::vector<LinePiece>& pieces = envelope_.of(opaque_);
        for (const LinePiece& piece : pieces) {
            visit(segment_of(piece));
        }
        for (const LinePiece& sensor : sensors_) {
            seen_.clear();
            Envelope::seen_before(sensor, pieces, seen_);
            for (const LinePiece& piece : seen_) {
                visit(segment_of(piece));
            }
        }
    }
}

void ScanLines::cut_all(double line) {
    cuts_.clear();
    opaque_.clear();
    sensors_.clear();
    for (const Corners& corners : corners_) {
        const bool below[3] = {corners.t[0] < line, corners.t[1] < line, corners.t[2] < line};
        if (below[0] != below[1] || below[1] != below[2]) {
            add_cut(corners, line);
        }
    }
}

void ScanLines::add_cut(const Corners& corners, double line) {
    // Corners 0, 1, 2 have the barycentric coordinates (0, 0), (1, 0), (0, 1).
    constexpr double kU[3] = {0, 1, 0};
    constexpr double kV[3] = {0, 0, 1};
    Cut cut{&corners, {}, {}, 0, 0};
    double s[2];
    double z[2];
    int found = 0;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        if ((corners.t[a] < line) == (corners.t[b] < line)) {
            continue;
        }
        const double f = (line - corners.t[a]) / (corners.t[b] - corners.t[a]);
        s[found] = corners.s[a] + f * (corners.s[b] - corners.s[a]);
        z[found] = corners.z[a] + f * (corners.z[b] - corners.z[a]);
        cut.u[found] = kU[a] + f * (kU[b] - kU[a]);
        cut.v[found] = kV[a] + f * (kV[b] - kV[a]);
        ++found;
    }
    if (s[0] == s[1]) {
        return;
    }
    if (s[0] > s[1]) {
        std::swap(s[0], s[1]);
        std::swap(z[0], z[1]);
        std::swap(cut.u[0], cut.u[1]);
        std::swap(cut.v[0], cut.v[1]);
    }
    cut.low = s[0];
    cut.high = s[1];
    if (plane_->repeats_s) {
        add_periods(cut, z[0], z[1]);
    } else {
        add_piece(cut, {cut.low, cut.high, z[0], z[1], 0});
    }
}

void ScanLines::add_piece(const Cut& cut, const LinePiece& part) {
    LinePiece piece = part;
    piece.segment = static_cast<std::uint32_t>(cuts_.size());
    cuts_.push_back(cut);
    (cut.corners->transparent ? sensors_ : opaque_).push_back(piece);
}

/// Adds a cut where the line, which is but one period long, passes it.
void ScanLines::add_periods(const Cut& cut, double z_low, double z_high) {
    const double period = plane_->size_s;
    const Periods periods =
        periods_of(cut.low - plane_->low_s, cut.high - plane_->low_s, period, true);
    for (std::int32_t k = periods.first; k <= periods.last; ++k) {
        Cut moved = cut;
        moved.low -= k * period;
        moved.high -= k * period;
        const LinePiece whole{moved.low, moved.high, z_low, z_high, 0};
        const double low = std::max(moved.low, plane_->low_s);
        const double high = std::min(moved.high, plane_->low_s + period);
        if (low < high) {
            add_piece(moved, {low, high, whole.depth(low), whole.depth(high), 0});
        }
    }
}

LitSegment ScanLines::segment_of(const LinePiece& piece) const {
    const Cut& cut = cuts_[piece.segment];
    LitSegment lit;
    lit.triangle = cut.corners->triangle;
    lit.length = piece.high - piece.low;
    lit.cosine = cut.corners->cosine;
    const double ends[2] = {piece.low, piece.high};
    for (int i = 0; i < 2; ++i) {
        const double f = (ends[i] - cut.low) / (cut.high - cut.low);
        lit.u[i] = (1 - f) * cut.u[0] + f * cut.u[1];
        lit.v[i] = (1 - f) * cut.v[0] + f * cut.v[1];
    }
    return lit;
}

}  // namespace quasimc
