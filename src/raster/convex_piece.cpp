#include "raster/convex_piece.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

Point2 between(const Point2& a, const Point2& b, double f) {
    return {a.s + f * (b.s - a.s), a.t + f * (b.t - a.t)};
}

/// The part of `segment` that `other` runs along, as fractions of its length.
std::optional<std::pair<double, double>> part_along(
    const PlaneSegment& segment, const PlaneSegment& other, double tolerance) {
    const double length = length_of(segment);
    const double s = (segment.to.s - segment.from.s) / length;
    const double t = (segment.to.t - segment.from.t) / length;
    const auto beside = [&](const Point2& p) {
        return s * (p.t - segment.from.t) - t * (p.s - segment.from.s);
    };
    const auto along = [&](const Point2& p) {
        return (s * (p.s - segment.from.s) + t * (p.t - segment.from.t)) / length;
    };
    const auto [low, high] = std::minmax({along(other.from), along(other.to)});
    const double begin = std::max(low, 0.0);
    const double end = std::min(high, 1.0);
    if (!(begin < end)) {
        return std::nullopt;
    }
    // Parallel segments must be within the tolerance.
    const double a = along(other.from);
    const double b = along(other.to);
    const auto distance = [&](double at) {
        return std::abs(
            beside(other.from) + (at - a) / (b - a) * (beside(other.to) - beside(other.from)));
    };
    return distance(begin) <= tolerance && distance(end) <= tolerance
               ? std::optional(std::pair{begin, end})
               : std::nullopt;
}

}  // namespace

double area_of(const ConvexPiece& piece) {
    double twice = 0;
    for (std::size_t i = 2; i < piece.size(); ++i) {
        twice += turn(piece[0], piece[i - 1], piece[i]);
    }
    return twice / 2;
}

double length_within(const ConvexPiece& piece, const Point2& from, const Point2& to) {
    double low = 0, high = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Point2& corner = piece[i];
        const Point2& next = piece[(i + 1) % piece.size()];
        const double a = turn(corner, next, from);
        const double b = turn(corner, next, to);
        if (a <= 0 && b <= 0) {
            return 0;
        }
        if (a < 0) {
            low = std::max(low, a / (a - b));
        } else if (b < 0) {
            high = std::min(high, a / (a - b));
        }
    }
    return std::max(0.0, high - low) * length_of({from, to});
}

std::pair<ConvexPiece, ConvexPiece> parts_beside(
    const ConvexPiece& piece, const Point2& from, const Point2& to) {
    ConvexPiece right, left;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Point2& corner = piece[i];
        const Point2& next = piece[(i + 1) % piece.size()];
        const double here = turn(from, to, corner);
        const double there = turn(from, to, next);
        (here > 0 ? left : right).push_back(corner);
        if ((here > 0) != (there > 0)) {
            const Point2 cut = between(corner, next, here / (here - there));
            left.push_back(cut);
            right.push_back(cut);
        }
    }
    return {right, left};
}

std::optional<PlaneSegment> common_border(
    const ConvexPiece& a, const ConvexPiece& b, double tolerance) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const PlaneSegment own{a[i], a[(i + 1) % a.size()]};
        const double length = length_of(own);
        for (std::size_t j = 0; length > tolerance && j < b.size(); ++j) {
            const PlaneSegment other{b[j], b[(j + 1) % b.size()]};
            const auto part = part_along(own, other, tolerance);
            if (part && (part->second - part->first) * length > tolerance) {
                return PlaneSegment{
                    between(own.from, own.to, part->first),
                    between(own.from, own.to, part->second)};
            }
        }
    }
    return std::nullopt;
}

double share_along(
    const PlaneSegment& segment, std::span<const PlaneSegment> others, double tolerance) {
    std::vector<std::pair<double, double>> parts;
    for (const PlaneSegment& other : others) {
        if (const auto part = part_along(segment, other, tolerance)) {
            parts.push_back(*part);
        }
    }
    std::sort(parts.begin(), parts.end());
    double covered = 0, end = 0;
    for (const auto& [from, to] : parts) {
        covered += std::max(0.0, to - std::max(from, end));
        end = std::max(end, to);
    }
    return covered;
}

}  // namespace quasimc
