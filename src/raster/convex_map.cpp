#include "raster/convex_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/checks.h"

namespace quasimc {

namespace {

/// Drops points inside the polygon of the extreme points in sixteen directions (Akl and Toussaint
/// 1978), usually most of them.
void drop_inner_points(std::vector<Point2>& points) {
    constexpr std::size_t kDirections = 16;
    std::array<Point2, kDirections> direction, furthest;
    for (std::size_t k = 0; k < kDirections; ++k) {
        const double angle = 2 * 3.14159265358979323846 * static_cast<double>(k) / kDirections;
        direction[k] = {std::cos(angle), std::sin(angle)};
        furthest[k] = points.front();
    }
    std::array<double, kDirections> reach;
    reach.fill(-INFINITY);
    for (const Point2& p : points) {
        for (std::size_t k = 0; k < kDirections; ++k) {
            const double r = p.s * direction[k].s + p.t * direction[k].t;
            if (r > reach[k]) {
                reach[k] = r;
                furthest[k] = p;
            }
        }
    }
    const auto is_inner = [&](const Point2& p) {
        for (std::size_t k = 0; k < kDirections; ++k) {
            const Point2& a = furthest[k];
            const Point2& b = furthest[(k + 1) % kDirections];
            const bool same = a.s == b.s && a.t == b.t;
            if (!same && !(turn(a, b, p) > 0)) {
                return false;
            }
        }
        return true;
    };
    points.erase(std::remove_if(points.begin(), points.end(), is_inner), points.end());
}

/// Appends the corners of the hull found by a walk through `points`, turning left.
template <typename Iterator>
void append_chain(std::vector<Point2>& hull, Iterator first, Iterator last) {
    const std::size_t begin = hull.size();
    for (; first != last; ++first) {
        while (hull.size() >= begin + 2 &&
               turn(hull[hull.size() - 2], hull[hull.size() - 1], *first) <= 0) {
            hull.pop_back();
        }
        hull.push_back(*first);
    }
    hull.pop_back();  // the first point of the next chain
}

}  // namespace

std::vector<Point2> convex_hull(std::vector<Point2> points) {
    constexpr std::size_t kFew = 64;
    if (points.size() > kFew) {
        drop_inner_points(points);
    }
    std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
        return a.s < b.s || (a.s == b.s && a.t < b.t);
    });
    const auto same = [](const Point2& a, const Point2& b) { return a.s == b.s && a.t == b.t; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    if (points.size() < 3) {
        return points;
    }
    // Monotone chain (Andrew 1979): the lower border to the right, the upper one back.
    std::vector<Point2> hull;
    append_chain(hull, points.begin(), points.end());
    append_chain(hull, points.rbegin(), points.rend());
    return hull;
}

double polygon_area(const std::vector<Point2>& corners) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        twice += turn(corners[0], corners[i], corners[i + 1]);
    }
    return twice / 2;
}

namespace {

/// The border of a convex polygon at `s`, on one side: a chain of corners with rising s.
double border_at(const std::vector<Point2>& chain, double s) {
    const auto right = std::lower_bound(
        chain.begin() + 1, chain.end() - 1, s, [](const Point2& p, double x) { return p.s < x; });
    const Point2 &a = *(right - 1), &b = *right;
    if (!(b.s > a.s)) {
        return b.t;
    }
    return a.t + (b.t - a.t) * ((s - a.s) / (b.s - a.s));
}

/// The two borders of a convex polygon, below and above, each with rising s.
struct Borders {
    std::vector<Point2> lower, upper;
};

Borders borders_of(const std::vector<Point2>& hull) {
    const auto leftmost_low = [](const Point2& a, const Point2& b) {
        return a.s < b.s || (a.s == b.s && a.t < b.t);
    };
    std::vector<Point2> turned = hull;
    std::rotate(
        turned.begin(), std::min_element(turned.begin(), turned.end(), leftmost_low), turned.end());
    turned.push_back(turned.front());
    const auto by_s = [](const Point2& a, const Point2& b) { return a.s < b.s; };
    const auto right = std::max_element(turned.begin(), turned.end(), by_s);
    Borders borders{{turned.begin(), right + 1}, {right, turned.end()}};
    std::reverse(borders.upper.begin(), borders.upper.end());
    // Vertical sides at the ends belong to neither border.
    if (borders.upper.size() > 2 && borders.upper[0].s == borders.upper[1].s) {
        borders.upper.erase(borders.upper.begin());
    }
    const std::size_t n = borders.upper.size();
    if (n > 2 && borders.upper[n - 1].s == borders.upper[n - 2].s) {
        borders.upper.pop_back();
    }
    return borders;
}

}  // namespace

ConvexMap::ConvexMap(const std::vector<Point2>& hull) {
    EXPECT(hull.size() >= 3);
    const Borders borders = borders_of(hull);
    std::vector<double> coordinates;
    coordinates.reserve(hull.size());
    for (const Point2& corner : hull) {
        coordinates.push_back(corner.s);
    }
    std::sort(coordinates.begin(), coordinates.end());
    coordinates.erase(std::unique(coordinates.begin(), coordinates.end()), coordinates.end());
    for (std::size_t i = 0; i + 1 < coordinates.size(); ++i) {
        const double s = coordinates[i], next = coordinates[i + 1];
        const double low = border_at(borders.lower, s), low_next = border_at(borders.lower, next);
        const double chord = std::max(0.0, border_at(borders.upper, s) - low);
        const double chord_next = std::max(0.0, border_at(borders.upper, next) - low_next);
        const double area = 0.5 * (chord + chord_next) * (next - s);
        if (area > 0) {
            const double width = next - s;
            slabs_.push_back(
                {s, width, low, (low_next - low) / width, chord, (chord_next - chord) / width,
                 area_, area_ + area});
            area_ += area;
        }
    }
    constexpr std::size_t kMaxSlabs = 60000;
    EXPECT(!slabs_.empty() && slabs_.size() < kMaxSlabs);
    slabs_.back().area_after = INFINITY;

    std::size_t slab = 0;
    for (std::size_t i = 0; i <= kGuides; ++i) {
        const double area = area_ * static_cast<double>(i) / static_cast<double>(kGuides);
        while (slabs_[slab].area_after <= area) {
            ++slab;
        }
        guide_.push_back(static_cast<std::uint16_t>(slab));
    }
}

Point2 ConvexMap::point(double u0, double u1) const {
    const double area = u0 * area_;
    std::size_t i = guide_[static_cast<std::size_t>(u0 * static_cast<double>(kGuides))];
    i += slabs_[i].area_after < area ? 1U : 0U;  // branchless: true in about half of the cases
    while (slabs_[i].area_after < area) {        // with a branch: rarely true
        ++i;
    }
    const Slab& slab = slabs_[i];
    // w along s with chord w + chord_slope w^2 / 2 = rest.
    const double rest = area - slab.area_before;
    const double square = slab.chord * slab.chord + 2 * slab.chord_slope * rest;
    const double denominator = slab.chord + std::sqrt(std::max(0.0, square));
    const double w = denominator > 0 ? std::min(slab.width, 2 * rest / denominator) : 0.0;
    return {slab.s + w, slab.low + w * slab.low_slope + u1 * (slab.chord + w * slab.chord_slope)};
}

}  // namespace quasimc
