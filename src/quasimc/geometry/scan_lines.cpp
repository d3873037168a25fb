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

void ScanLines::set(
    const LocalMesh& mesh, std::span<const std::uint8_t> transparent, const Spec& spec) {
    EXPECT(spec.lines > 0);
    EXPECT(transparent.empty() || transparent.size() == mesh.triangle_count());
    mesh_ = &mesh;
    transparent_ = transparent;
    spec_ = spec;
    const Frame frame = frame_about(spec.direction);
    const double angle = std::numbers::pi * spec.rotation;
    along_ = std::cos(angle) * frame.s + std::sin(angle) * frame.t;
    across_ = std::cos(angle) * frame.t - std::sin(angle) * frame.s;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const double t = dot(across_, mesh.vertex(i, corner));
            low = std::min(low, t);
            high = std::max(high, t);
        }
    }
    low_ = low;
    pitch_ = (high - low) / spec.lines;
    fill_bins(mesh);
}

void ScanLines::fill_bins(const LocalMesh& mesh) {
    const std::uint32_t n = mesh.triangle_count();
    const std::uint32_t last_bin = bins(spec_.lines) - 1;
    const double per_length = pitch_ > 0 ? 1 / (pitch_ * kBin) : 0;
    // Lines stand at most one pitch from where they would be without shift.
    const auto bin_of = [&](double t) {
        const double bin = std::floor((t - low_ - pitch_ * spec_.shift) * per_length);
        return static_cast<std::uint32_t>(std::clamp(bin, 0.0, static_cast<double>(last_bin)));
    };
    first_in_bin_.assign(std::size_t{last_bin} + 2, 0);
    range_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = dot(across_, mesh.vertex(i, 0));
        const double b = dot(across_, mesh.vertex(i, 1));
        const double c = dot(across_, mesh.vertex(i, 2));
        range_[i] = {bin_of(std::min({a, b, c})), bin_of(std::max({a, b, c}))};
        for (std::uint32_t bin = range_[i].first; bin <= range_[i].last; ++bin) {
            ++first_in_bin_[bin + 1];
        }
    }
    for (std::size_t bin = 1; bin < first_in_bin_.size(); ++bin) {
        first_in_bin_[bin] += first_in_bin_[bin - 1];
    }
    triangles_.resize(first_in_bin_.back());
    std::vector<std::uint32_t> next(first_in_bin_.begin(), first_in_bin_.end() - 1);
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t bin = range_[i].first; bin <= range_[i].last; ++bin) {
            triangles_[next[bin]++] = i;
        }
    }
}

ScanLines::Corners ScanLines::corners_of(std::uint32_t triangle) const {
    Corners corners{};
    corners.triangle = triangle;
    corners.transparent = !transparent_.empty() && transparent_[triangle] != 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3 p = mesh_->vertex(triangle, i);
        corners.s[i] = dot(along_, p);
        corners.t[i] = dot(across_, p);
        corners.z[i] = dot(spec_.direction, p);
    }
    const Vec3 a = mesh_->vertex(triangle, 0);
    const Vec3 up = cross(mesh_->vertex(triangle, 1) - a, mesh_->vertex(triangle, 2) - a);
    const double size = length(up);
    corners.cosine = size > 0 ? dot(up, spec_.direction) / size : 0;
    return corners;
}

void ScanLines::visit(std::uint32_t bin, const std::function<void(const LitSegment&)>& visit) {
    corners_.clear();
    for (std::uint32_t i = first_in_bin_[bin]; i < first_in_bin_[bin + 1]; ++i) {
        const Corners corners = corners_of(triangles_[i]);
        if (std::abs(corners.cosine) > kEdgeOn) {
            corners_.push_back(corners);
        }
    }
    const std::uint32_t end = std::min((bin + 1) * kBin, spec_.lines);
    for (std::uint32_t line = bin * kBin; line < end; ++line) {
        cut_all(low_ + (line + spec_.shift) * pitch_);
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
    const LinePiece piece{s[0], s[1], z[0], z[1], static_cast<std::uint32_t>(cuts_.size())};
    cuts_.push_back(cut);
    (corners.transparent ? sensors_ : opaque_).push_back(piece);
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
