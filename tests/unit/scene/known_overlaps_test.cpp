#include "scene/overlap/known_overlaps.h"

#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "scene/overlap/overlap_search.h"

namespace quasimc::test {
namespace {

using OwnedTriangles = std::map<std::int64_t, std::vector<Triangle>>;

/// Leaves in ten planes, so that many lie on each other, some with the same corners.
class FlatLeaves {
  public:
    explicit FlatLeaves(std::uint64_t seed) : draw_(seed) {}

    std::vector<Triangle> leaf() {
        const double x = at(0.9), y = at(0.9), z = 0.1 * static_cast<double>(draw_() % 10);
        const double size = draw_() % 4 == 0 ? 0.09 : 0.02;
        const Vec3 a{x, y, z}, b{x + size, y, z}, c{x + size, y + size, z}, d{x, y + size, z};
        std::vector<Triangle> triangles{{a, b, c}, {a, c, d}};
        triangles.resize(1 + draw_() % 2);
        return triangles;
    }

    std::size_t below(std::size_t count) { return draw_() % count; }

  private:
    /// On a grid, so that there are leaves with the same corners.
    double at(double largest) { return largest * static_cast<double>(draw_() % 40) / 40.0; }

    std::mt19937_64 draw_;
};

/// Corners that stay, so that the scene keeps its size.
std::vector<Triangle> frame() {
    return {{Vec3{0, 0, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}}};
}

struct OwnedGeometry {
    std::shared_ptr<const SceneGeometry> geometry;
    std::vector<std::int64_t> owners;
};

OwnedGeometry geometry_of(const OwnedTriangles& organs) {
    std::vector<Triangle> triangles;
    OwnedGeometry result;
    for (const auto& [id, own] : organs) {
        triangles.insert(triangles.end(), own.begin(), own.end());
        result.owners.insert(result.owners.end(), own.size(), id);
    }
    result.geometry = std::make_shared<const SceneGeometry>(Mesh(triangles));
    return result;
}

Overlaps find(KnownOverlaps& known, const OwnedTriangles& organs) {
    OwnedGeometry owned = geometry_of(organs);
    return known.find(owned.geometry, owned.owners);
}

void expect_found_by_all(const Overlaps& found, const OwnedTriangles& organs) {
    const Overlaps expected = find_overlaps(*geometry_of(organs).geometry);
    ASSERT_EQ(found.pairs.size(), expected.pairs.size());
    for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
        EXPECT_EQ(found.pairs[i].first, expected.pairs[i].first);
        EXPECT_EQ(found.pairs[i].second, expected.pairs[i].second);
        EXPECT_EQ(found.pairs[i].is_same, expected.pairs[i].is_same);
    }
    EXPECT_EQ(found.gave_up, expected.gave_up);
}

TEST(KnownOverlaps, AreThoseOfASearchOfAllWhateverChanges) {
    FlatLeaves leaves(7);
    OwnedTriangles organs{{0, frame()}};
    for (std::int64_t id = 1; id <= 400; ++id) {
        organs[id] = leaves.leaf();
    }
    KnownOverlaps known;
    std::size_t pairs = 0;
    for (int step = 0; step < 60; ++step) {
        const Overlaps found = find(known, organs);
        pairs += found.pairs.size();
        expect_found_by_all(found, organs);
        EXPECT_EQ(known.changed().has_value(), step > 0) << "step " << step;
        const auto one = static_cast<std::int64_t>(1 + leaves.below(400));
        switch (step % 4) {
            case 0:
                organs[one] = leaves.leaf();
                break;
            case 1:
                organs[1000 + step] = leaves.leaf();
                break;
            case 2:
                organs.erase(one);
                break;
            default:
                for (std::int64_t id = 10; id < 40; ++id) {
                    organs[id] = leaves.leaf();
                }
        }
    }
    EXPECT_GT(pairs, 2000U);  // there was something to find
}

TEST(KnownOverlaps, CompareAllWhereTheSizeOfTheSceneChanges) {
    FlatLeaves leaves(8);
    OwnedTriangles organs{{0, frame()}};
    for (std::int64_t id = 1; id <= 50; ++id) {
        organs[id] = leaves.leaf();
    }
    KnownOverlaps known;
    static_cast<void>(find(known, organs));
    static_cast<void>(find(known, organs));
    EXPECT_EQ(known.changed(), std::optional<std::size_t>(0));
    organs[0][0][1].x = 5;
    expect_found_by_all(find(known, organs), organs);
    EXPECT_FALSE(known.changed());
    organs[0][0][0].z = -0.6;
    expect_found_by_all(find(known, organs), organs);
    EXPECT_EQ(known.changed(), std::optional<std::size_t>(1)) << "as long as before";
}

/// A leaf moves between copies of a mesh, which are only resolved near it.
TEST(KnownOverlaps, OfCopiesAreThoseOfASearchOfAll) {
    FlatLeaves leaves(11);
    std::vector<Triangle> plant;
    for (int i = 0; i < 80; ++i) {
        for (const Triangle& t : leaves.leaf()) {
            plant.push_back(t);
        }
    }
    const auto mesh = std::make_shared<const Mesh>(plant);
    std::vector<Instance> copies;
    for (int i = 0; i < 6; ++i) {
        copies.push_back({mesh, {}});
        copies.back().transform.shift = {1.0 * (i % 3), 1.0 * (i / 3), 0};
    }
    KnownOverlaps known;
    std::size_t pairs = 0;
    for (int step = 0; step < 20; ++step) {
        std::vector<Triangle> loose = leaves.leaf();
        for (Triangle& t : loose) {
            for (Vec3& corner : t) {
                corner.x += step % 3;
            }
        }
        const auto scene = std::make_shared<const SceneGeometry>(Mesh(loose), copies);
        std::vector<std::int64_t> owners(loose.size(), 100);
        for (std::int64_t copy = 0; copy < 6; ++copy) {
            owners.insert(owners.end(), mesh->size(), copy);
        }
        const Overlaps found = known.find(scene, owners);
        const Overlaps expected = find_overlaps(*scene);
        EXPECT_EQ(known.changed().has_value(), step > 0) << step;
        EXPECT_LE(known.changed().value_or(0), 2U);
        ASSERT_EQ(found.pairs.size(), expected.pairs.size()) << step;
        for (std::size_t i = 0; i < found.pairs.size(); ++i) {
            EXPECT_EQ(found.pairs[i].first, expected.pairs[i].first);
            EXPECT_EQ(found.pairs[i].second, expected.pairs[i].second);
            pairs += found.pairs[i].first < loose.size() ? 1 : 0;
        }
    }
    EXPECT_GT(pairs, 0U);
}

TEST(KnownOverlaps, CompareAllWhereSoManyAreTheSameThatTheOrderOfTheSearchCounts) {
    FlatLeaves leaves(9);
    OwnedTriangles organs{{0, frame()}};
    const std::vector<Triangle> same = leaves.leaf();
    for (std::int64_t id = 1; id <= 300; ++id) {
        organs[id] = leaves.leaf();
    }
    KnownOverlaps known;
    static_cast<void>(find(known, organs));
    for (std::int64_t id = 1; id <= 90; ++id) {
        organs[id] = same;
        expect_found_by_all(find(known, organs), organs);
    }
    EXPECT_FALSE(known.changed());
}

/// No single step tests that many pairs, but all steps together do.
TEST(KnownOverlaps, GiveUpWhereASearchOfAllDoesThoughNoPlaneIsShared) {
    KnownOverlaps known;
    OwnedTriangles organs{{0, frame()}};
    for (const std::int64_t count : {4500, 6000}) {
        for (std::int64_t id = 1; id <= count; ++id) {
            const double z = 5e-5 * static_cast<double>(id);
            organs[id] = {{Vec3{0.1, 0.1, z}, {0.9, 0.1, z}, {0.1, 0.9, z}}};
        }
        const Overlaps found = find(known, organs);
        EXPECT_EQ(found.gave_up, count == 6000);
        expect_found_by_all(found, organs);
    }
}

}  // namespace
}  // namespace quasimc::test
