// Scan lines and item buffers of scenes that repeat themselves.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "geometry/cast/ray_caster.h"
#include "quasimc/mesh.h"
#include "raster/item_buffer.h"
#include "raster/scan_lines.h"
#include "raster/scene_projection.h"
#include "support/random_leaves.h"

namespace quasimc {
namespace {

/// A scene as its ray caster and its beams see it.
struct Repeated {
    Repeated(const std::vector<Triangle>& triangles, const Cell& cell)
        : caster(triangles, cell, Accelerator::brute_force),
          projection(caster.mesh(), cell, StartArea::silhouette) {
        for (std::uint32_t i = 0; i < caster.mesh().triangle_count(); ++i) {
            const bool image = i > 0 && caster.source(i) == caster.source(i - 1);
            roles.push_back(image ? VisibilityRole::omitted : VisibilityRole::opaque);
        }
        scene = {&caster.mesh(), projection.cell(), roles, projection.outline()};
    }

    RayCaster caster;
    SceneProjection projection;
    std::vector<VisibilityRole> roles;
    ProjectedScene scene;
};

constexpr Cell kLayer{
    .along_x = true, .along_y = true, .low_x = -.2, .low_y = .1, .size_x = 1.5, .size_y = .8};
constexpr Cell kRowX{.along_x = true, .low_x = .1, .size_x = 1.2};
constexpr Cell kRowY{.along_y = true, .low_y = -.3, .size_y = .9};

const std::array<Vec3, 3> kDirections{
    Vec3{0, 0, -1}, normalized(Vec3{1, 2, -3}), normalized(Vec3{-2, .5, -.6})};

std::vector<Triangle> floor_of(const Cell& cell) {
    const double x0 = cell.along_x ? cell.low_x : -.5;
    const double x1 = cell.along_x ? x0 + cell.size_x : 1.5;
    const double y0 = cell.along_y ? cell.low_y : -.5;
    const double y1 = cell.along_y ? y0 + cell.size_y : 1.5;
    return {
        {Vec3{x0, y0, 0}, Vec3{x1, y0, 0}, Vec3{x1, y1, 0}},
        {Vec3{x0, y0, 0}, Vec3{x1, y1, 0}, Vec3{x0, y1, 0}}};
}

class PeriodicBeams : public ::testing::TestWithParam<Cell> {};

/// The floor of a cell catches its area, whatever the direction, and nothing is caught twice.
TEST_P(PeriodicBeams, LightAFloorWholly) {
    const std::vector<Triangle> floor = floor_of(GetParam());
    const Repeated repeated(floor, GetParam());
    const double scale = repeated.projection.scale();
    Bounds bounds;
    for (const Vec3& corner : floor[0]) {
        bounds.add(corner);
    }
    const Vec3 size = bounds.size();
    for (const Vec3& direction : kDirections) {
        const double area = size.x * size.y * scale * scale * std::abs(direction.z);
        for (const double rotation : {.05, .3, .45, .6, .8, .95}) {
            ItemScratch scratch;
            const ItemBuffer buffer =
                draw(repeated.scene, {direction, rotation, .3, .8, 1e5}, scratch);
            double seen = 0;
            for (const ItemBuffer::Item& item : buffer.items()) {
                seen += item.pixels * buffer.pixel_area();
            }
            EXPECT_NEAR(seen, area, 2e-3 * area);
            const ScanLines::Spec spec{direction, rotation, .4, 500};
            const ScanLines lines(repeated.scene, spec);
            LineScratch line_scratch;
            double lit = 0;
            for (std::uint32_t strip = 0; strip < ScanLines::strips(spec.lines); ++strip) {
                LineStrip(lines, strip, line_scratch)
                    .for_visible_segments([&](const LineStrip::Line& line) {
                        for (const VisibleSegment& segment : line.segments) {
                            lit += segment.length() * lines.area();
                        }
                    });
            }
            EXPECT_NEAR(lit, area, 2e-3 * area);
        }
    }
}

/// Light that comes in very low sees upright leaves over many periods, and most of these only from
/// the side.
TEST_P(PeriodicBeams, AreFoundWhereTheSunIsLow) {
    const Repeated repeated(test::random_leaves(30, .8, 1, 6), GetParam());
    const double low = std::sin(1 * std::numbers::pi / 180);
    const Vec3 direction = normalized(Vec3{.8, .6, -low});
    std::map<std::uint32_t, double> by_lines;
    const ScanLines::Spec spec{direction, .3, .7, 2000};
    const ScanLines lines(repeated.scene, spec);
    LineScratch line_scratch;
    std::size_t most_triangles = 0;
    double by_all_lines = 0;
    for (std::uint32_t i = 0; i < ScanLines::strips(spec.lines); ++i) {
        const LineStrip strip(lines, i, line_scratch);
        const auto visible = strip.for_visible_segments([](const LineStrip::Line&) {});
        most_triangles = std::max(most_triangles, visible.size());
        for (std::size_t k = 0; k < visible.size(); ++k) {
            by_lines[strip.triangles()[k].triangle] += visible[k].length * lines.area();
            by_all_lines += visible[k].length * lines.area();
        }
    }
    ItemScratch scratch;
    const ItemBuffer buffer = draw(repeated.scene, {direction, .8, .2, .7, 1e6}, scratch);
    double apart = 0;
    for (const ItemBuffer::Item& item : buffer.items()) {
        by_lines[item.triangle] -= item.pixels * buffer.pixel_area();
    }
    for (const auto& [triangle, difference] : by_lines) {
        apart += std::abs(difference);
    }
    EXPECT_LT(apart, .02 * by_all_lines);
    // A leaf is seen over some fifty periods, and not in all squares of as many on a side.
    EXPECT_LT(most_triangles, 30U * 200U);
}

/// Every lit point sees the sky between the images of the leaves, and both methods find the same
/// area of it.
TEST_P(PeriodicBeams, AgreeWithRays) {
    const Repeated repeated(test::random_leaves(60, .4, 1, 5), GetParam());
    const LocalMesh& mesh = repeated.caster.mesh();
    int samples = 0;
    int free = 0;
    const auto sample = [&](std::uint32_t triangle, double u, double v, const Vec3& direction) {
        ++samples;
        const Vec3 point = mesh.point(triangle, u, v);
        free += repeated.caster.occluded(point, -direction, triangle) ? 0 : 1;
    };
    for (const Vec3& direction : kDirections) {
        std::map<std::uint32_t, double> by_lines;
        std::map<std::uint32_t, double> by_pixels;
        const ScanLines::Spec spec{direction, .3, .7, 400};
        const ScanLines lines(repeated.scene, spec);
        LineScratch line_scratch;
        for (std::uint32_t i = 0; i < ScanLines::strips(spec.lines); ++i) {
            const LineStrip strip(lines, i, line_scratch);
            strip.for_visible_segments([&](const LineStrip::Line& line) {
                for (const VisibleSegment& segment : line.segments) {
                    const std::uint32_t triangle = strip.triangles()[segment.surface].triangle;
                    by_lines[triangle] += segment.length() * lines.area();
                    const auto [u, v] = strip.point(line, segment, .5);
                    sample(triangle, u, v, direction);
                }
            });
        }
        ItemScratch scratch;
        const ItemBuffer buffer = draw(repeated.scene, {direction, .8, .2, .7, 4e4, true}, scratch);
        std::map<std::uint32_t, std::uint32_t> triangle_of;
        for (const ItemBuffer::Item& item : buffer.items()) {
            by_pixels[item.triangle] += item.pixels * buffer.pixel_area();
            triangle_of[item.id] = item.triangle;
        }
        std::size_t run_number = 0;
        buffer.for_each_run([&](const ItemBuffer::Run& run) {
            if (run_number++ % 3 == 0 && run.id > 0) {
                const auto [u, v] = buffer.point(run.first + run.count / 2);
                sample(triangle_of.at(run.id), u, v, direction);
            }
        });
        std::uint32_t pixel = 0;
        buffer.for_each_run_of_rows(0, 1, [&](const ItemBuffer::RowRun& run) {
            if (run.id > 0) {
                const auto [u, v] = buffer.point(pixel);
                const Point2 same = buffer.points(run.id).of(run.x, run.row);
                EXPECT_NEAR(same.s, u, 1e-6);
                EXPECT_NEAR(same.t, v, 1e-6);
            }
            pixel += run.count;
        });
        double whole = 0;
        double apart = 0;
        for (const auto& [triangle, area] : by_lines) {
            whole += area;
            apart += std::abs(area - by_pixels[triangle]);
        }
        EXPECT_LT(apart, .02 * whole);
    }
    EXPECT_GT(samples, 5000);
    // Rays in single precision may graze an edge.
    EXPECT_GE(free, samples - samples / 200);
}

/// Few of the 300 x 800 periods around a slanted triangle are tested, and all that it touches.
TEST(PeriodsInRow, AreThoseThatASlantedTriangleTouches) {
    const ProjectedTriangle seen{{.5, 300.2, 299.9}, {.3, 800.1, 800.4}, {0, 0, 0}};
    std::int32_t looked_at = 0;
    for (std::int32_t row = 0; row <= 800; ++row) {
        const Periods x = periods_in_row(seen, row, 1, 1, true);
        ASSERT_LE(x.first, x.last) << row;
        looked_at += x.last - x.first + 1;
        // The first side runs through the middle of the row here.
        const double along = (std::clamp(row + .5, .3, 800.1) - .3) / (800.1 - .3);
        const auto touched = static_cast<std::int32_t>(std::floor(.5 + 299.7 * along));
        EXPECT_LE(x.first, touched) << row;
        EXPECT_GE(x.last, touched) << row;
    }
    EXPECT_LT(looked_at, 2 * (300 + 800));
}

INSTANTIATE_TEST_SUITE_P(
    Cells, PeriodicBeams, ::testing::Values(kLayer, kRowX, kRowY), [](const auto& cell) {
        const bool layer = cell.param.along_x && cell.param.along_y;
        return std::string(layer ? "Layer" : cell.param.along_x ? "RowAlongX" : "RowAlongY");
    });

}  // namespace
}  // namespace quasimc
