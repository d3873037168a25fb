// A sweep of lights, materials and settings makes what is of the geometry once.

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run/simulator.h"
#include "runfile/run_file.h"
#include "scaling/work.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

std::string triangles_as_text(std::size_t count) {
    std::string text;
    for (const auto& [a, b, c] : random_leaves(count, .1, 1, 7)) {
        for (const Vec3& p : {a, b, c}) {
            text += fmt::format("{} {} {} ", p.x, p.y, p.z);
        }
        text += "\n";
    }
    return text;
}

RunSweep sweep_over_leaves(std::size_t triangles) {
    const std::string run_file =
        "bands = ['PAR']\n[run]\npaths = 64\nthreads = 1\n"
        "[[source]]\ntype = 'directional'\nname = 'sun'\nazimuth_deg = 0\nelevation_deg = 50\n"
        "irradiance_facing = 1\n[[material]]\nname = 'leaf'\nreflectance = 0\n"
        "[[geometry]]\nfile = 'leaves.tri'\nmaterial = 'leaf'\norgans = 'one'\n"
        "[sweep]\nsource.sun.elevation_deg = [20, 40, 60]\n"
        "material.leaf.reflectance = [0.1, 0.2]\n";
    const InputFiles files("/run", [triangles](const std::filesystem::path& /*path*/) {
        return triangles_as_text(triangles);
    });
    return read_sweep_document(
        read_toml(run_file, "run.toml"), "run.toml", [files] { return files; });
}

TEST(SweepWork, OfFurtherPointsIsLittleBesideThatOfTheFirst) {
    constexpr std::size_t kTriangles = 4000;
    Simulator simulator;
    RunSweep sweep = sweep_over_leaves(kTriangles);
    const double all = bytes_allocated_by([&] { sweep = sweep_over_leaves(kTriangles); });
    ASSERT_EQ(sweep.size(), 6U);
    for (std::size_t i = 0; i < sweep.size(); ++i) {
        const double bytes = bytes_allocated_by([&] {
            const RunFile point = sweep.take(i);
            static_cast<void>(simulator.run(point.scene, point.sources, point.spec));
        });
        EXPECT_GT(bytes, 0);
        EXPECT_LT(sweep.take(i).scene.triangle_count(), 2 * kTriangles);
        const double read = bytes_allocated_by([&] { static_cast<void>(sweep.take(i)); });
        EXPECT_LT(read, all / 20) << "point " << i;
    }
    EXPECT_EQ(simulator.builds(), 1U);
}

}  // namespace
}  // namespace quasimc::test
