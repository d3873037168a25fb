// Item buffers of periodic scenes, against images of triangles that are drawn one by one.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/mesh/local_mesh.h"
#include "raster/item_buffer.h"
#include "raster/stored_blocks.h"
#include "raster/triangle_rows.h"
#include "support/random_leaves.h"
#include "support/vector_units.h"

namespace quasimc {
namespace {

/// The triangle of each pixel, row by row, and the visible pixels of each triangle.
struct Seen {
    std::vector<std::uint32_t> triangles;
    std::map<std::uint32_t, std::uint32_t> pixels;
    bool operator==(const Seen&) const = default;
};

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Draws triangle by triangle, image by image, row by row and pixel by pixel.
class PlainDrawing {
  public:
    PlainDrawing(const ProjectedScene& scene, const ItemBuffer::View& view) : scene_(scene) {
        const ProjectionPlane plane(scene, view.direction, view.rotation, AlongPeriods::straight);
        const double pitch = std::max(
            std::sqrt(plane.size_s * plane.size_t / view.pixels),
            std::max(plane.size_s, plane.size_t) / view.pixels);
        const auto axis = [&](double low, double size, bool repeats, const Vec3& along,
                              double shift, int& count) {
            const double exact = std::max(1.0, size / pitch);
            count = static_cast<int>(repeats ? std::round(exact) : std::ceil(exact));
            const double step = repeats ? size / count : pitch;
            return BeamAxis{along / step, -low / step - shift};
        };
        x_ = axis(plane.low_s, plane.size_s, plane.repeats_s, plane.s, view.shift_s, columns_);
        y_ = axis(plane.low_t, plane.size_t, plane.repeats_t, plane.t, view.shift_t, rows_);
        z_ = {plane.depth, 0};
        repeats_x_ = plane.repeats_s;
        repeats_y_ = plane.repeats_t;
        const auto pixels = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
        depths_.assign(pixels, std::numeric_limits<float>::infinity());
        seen_.triangles.assign(pixels, kNone);
    }

    Seen draw() {
        draw_all(VisibilityRole::opaque, [this](std::size_t pixel, float depth, std::uint32_t i) {
            if (depth < depths_[pixel]) {
                depths_[pixel] = depth;
                seen_.triangles[pixel] = i;
            }
        });
        for (const std::uint32_t i : seen_.triangles) {
            seen_.pixels[i] += i == kNone ? 0 : 1;
        }
        seen_.pixels.erase(kNone);
        draw_all(VisibilityRole::sensor, [this](std::size_t pixel, float depth, std::uint32_t i) {
            if (depth < depths_[pixel]) {
                ++seen_.pixels[i];
            }
        });
        return seen_;
    }

  private:
    template <typename Visit>
    void draw_all(VisibilityRole role, const Visit& visit) const {
        for (std::uint32_t i = 0; i < scene_.mesh->triangle_count(); ++i) {
            if (scene_.role(i) == role) {
                draw_images(scene_.seen(i, x_, y_, z_), [&](std::size_t pixel, float depth) {
                    visit(pixel, depth, i);
                });
            }
        }
    }

    template <typename Visit>
    void draw_images(const ProjectedTriangle& seen, const Visit& visit) const {
        const auto periods = [](const double(&at)[3], double period, bool repeats) {
            const auto [low, high] = std::minmax({at[0], at[1], at[2]});
            return periods_of(low, high, period, repeats);
        };
        const Periods x = periods(seen.x, columns_, repeats_x_);
        const Periods y = periods(seen.y, rows_, repeats_y_);
        for (std::int32_t py = y.first; py <= y.last; ++py) {
            for (std::int32_t px = x.first; px <= x.last; ++px) {
                ProjectedTriangle image = seen;
                for (int k = 0; k < 3; ++k) {
                    image.x[k] -= px * static_cast<double>(columns_);
                    image.y[k] -= py * static_cast<double>(rows_);
                }
                draw_image(image, visit);
            }
        }
    }

    template <typename Visit>
    void draw_image(const ProjectedTriangle& c, const Visit& visit) const {
        const TrianglePlane plane(c);
        const auto [low, high] = std::minmax({c.y[0], c.y[1], c.y[2]});
        if (plane.is_edge_on()) {
            return;
        }
        const PlaneGradient depth = plane.gradient(c.z[0], c.z[1] - c.z[0], c.z[2] - c.z[0]);
        const SidesByRow sides(c);
        const auto end = static_cast<int>(std::min(std::ceil(high), 1. * rows_));
        for (int row = static_cast<int>(std::max(std::ceil(low), 0.)); row < end; ++row) {
            const auto [left, right] = sides.at(row);
            const auto first = static_cast<int>(std::max(std::ceil(left), 0.));
            const auto last = static_cast<int>(std::min(std::ceil(right), 1. * columns_));
            const double start =
                c.z[0] + (first - c.x[0]) * depth.by_x + (row - c.y[0]) * depth.by_y;
            for (int x = first; x < last; ++x) {
                const float z = static_cast<float>(start) +
                                static_cast<float>(depth.by_x) * static_cast<float>(x - first);
                visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + x, z);
            }
        }
    }

    const ProjectedScene& scene_;
    BeamAxis x_, y_, z_;
    int columns_ = 0, rows_ = 0;
    bool repeats_x_ = false, repeats_y_ = false;
    std::vector<float> depths_;
    Seen seen_;
};

Seen seen_in(const ItemBuffer& buffer) {
    Seen seen;
    std::map<std::uint32_t, std::uint32_t> triangle_of;
    for (const ItemBuffer::Item& item : buffer.items()) {
        triangle_of[item.id] = item.triangle;
        seen.pixels[item.triangle] += item.pixels;
    }
    buffer.for_each_run([&](const ItemBuffer::Run& run) {
        seen.triangles.insert(
            seen.triangles.end(), run.count, run.id == 0 ? kNone : triangle_of.at(run.id));
    });
    return seen;
}

/// Leaves within a period, over its edge, and larger than it; not a multiple of the lanes.
LocalMesh leaves_of_all_sizes() {
    std::vector<Triangle> leaves = test::random_leaves(200, .06, 2, 3);
    for (const auto& [count, edge] : {std::pair{12, .5}, std::pair{2, 2.}}) {
        const auto more = test::random_leaves(static_cast<std::size_t>(count), edge, 2, 5);
        leaves.insert(leaves.end(), more.begin(), more.end());
    }
    return make_local_mesh(leaves);
}

std::vector<VisibilityRole> roles_of_all_kinds(const LocalMesh& mesh) {
    std::vector<VisibilityRole> roles(mesh.triangle_count(), VisibilityRole::opaque);
    for (std::size_t i = 0; i < roles.size(); i += 5) {
        roles[i] = i % 2 == 0 ? VisibilityRole::sensor : VisibilityRole::omitted;
    }
    return roles;
}

class ImagesInCells : public ::testing::TestWithParam<Cell> {};

TEST_P(ImagesInCells, AreTheSamePixelsInBlocksAsOneByOne) {
    const LocalMesh mesh = leaves_of_all_sizes();
    const std::vector<VisibilityRole> roles = roles_of_all_kinds(mesh);
    ProjectedScene scene{.mesh = &mesh, .cell = local_cell(mesh, GetParam()), .roles = roles};
    const std::vector<StoredBlock> blocks = stored_blocks(scene);
    EXPECT_FALSE(blocks.empty());
    std::size_t visible = 0;
    for (const Vec3& towards :
         {Vec3{0, 0, -1}, Vec3{1, 2, -3}, Vec3{-2, .5, -.6}, Vec3{.8, .6, -.05}, Vec3{1, 1, 2}}) {
        const ItemBuffer::View view{normalized(towards), .7, .3, .8, 3000};
        scene.blocks = {};
        const Seen expected = PlainDrawing(scene, view).draw();
        visible += expected.pixels.size();
        for_each_vector_unit([&] {
            for (const auto& stored : {std::span<const StoredBlock>(), std::span(blocks)}) {
                scene.blocks = stored;
                ItemScratch scratch;
                EXPECT_EQ(seen_in(draw(scene, view, scratch)), expected);
            }
        });
    }
    EXPECT_GT(visible, 100U);
}

/// Lanes without a triangle are at the origin.
TEST(PeriodicImages, AreOfTrianglesOnlyWhereTheOriginIsACornerOfTheCell) {
    const LocalMesh mesh = make_local_mesh(test::random_leaves(3, .5, 1, 3));
    const ProjectedScene scene{
        .mesh = &mesh, .cell = {.along_x = true, .along_y = true, .size_x = .3, .size_y = .4}};
    const ItemBuffer::View view{.direction = {0, 0, -1}, .pixels = 1000};
    ItemScratch scratch;
    EXPECT_EQ(seen_in(draw(scene, view, scratch)), PlainDrawing(scene, view).draw());
}

std::string name_of_cell(const ::testing::TestParamInfo<Cell>& cell) {
    const std::string x = cell.param.along_x ? "X" : "", y = cell.param.along_y ? "Y" : "";
    return "Along" + x + y;
}

INSTANTIATE_TEST_SUITE_P(
    Cells,
    ImagesInCells,
    ::testing::Values(
        Cell{
            .along_x = true,
            .along_y = true,
            .low_x = -.2,
            .low_y = .1,
            .size_x = 1.5,
            .size_y = .8},
        Cell{.along_x = true, .low_x = .1, .size_x = 1.2},
        Cell{.along_y = true, .low_y = -.3, .size_y = .9},
        Cell{}),
    name_of_cell);

}  // namespace
}  // namespace quasimc
