// Rationale: a scene may exhaust the memory of a machine. The peak memory per triangle, while the
// ray caster is built, has a limit that a further copy of the corners would exceed.
//
// Expected behaviour: the resident memory of a child process that makes a scene ready to trace
// grows at most by a given number of bytes per triangle. (Tallies and results add to it, per organ;
// sums are released while the result grows.)

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "quasimc/result.h"
#include "run/simulator.h"
#include "scene/scene.h"
#include "statistical/scenes.h"
#include "support/process_memory.h"
#include "support/random_leaves.h"
#include "support/sanitized.h"
#include "transport/prepared_scene.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kTriangles = 200'000;

/// Makes a scene ready to trace.
void prepare(SceneBuilder builder) {
    builder.add_material(diffuse("leaf", .1, .1));
    const Scene scene = std::move(builder).build();
    const Sources sources{sun(0, {1})};
    const PreparedScene prepared(
        scene, sources, StartArea::silhouette,
        std::make_shared<RayCaster>(data_of(scene).geometry, scene.cell(), Accelerator::embree));
    EXPECT_EQ(prepared.lights().size(), 1U);
}

/// The bytes that a child process reports, per triangle.
/// @param work  returns them
template <typename Work>
double of_child(const Work& work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        return NAN;
    }
    const pid_t child = fork();
    if (child == 0) {
        const double grown = work();
        const auto written = write(ends[1], &grown, sizeof grown);
        std::_Exit(written == sizeof grown ? EXIT_SUCCESS : EXIT_FAILURE);
    }
    double grown = NAN;
    close(ends[1]);
    const auto got = read(ends[0], &grown, sizeof grown);
    close(ends[0]);
    int status = EXIT_FAILURE;
    waitpid(child, &status, 0);
    return got == sizeof grown && status == 0 ? grown / kTriangles : NAN;
}

/// The peak of a child process that does `work`, above its initial memory, in bytes per triangle.
template <typename Work>
double bytes_a_triangle(const Work& work) {
    return of_child([&] {
        const double before = status_bytes("VmRSS");
        work();
        return status_bytes("VmHWM") - before;
    });
}

/// A wavy sheet: half a vertex for each triangle.
Mesh sheet() {
    const auto n = static_cast<std::uint32_t>(std::sqrt(kTriangles / 2));
    Mesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double x = double(i) / n, y = double(j) / n;
            mesh.vertices.push_back({x, y, .1 * std::sin(20 * x) * std::cos(30 * y)});
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
            mesh.faces.push_back({a, b, b + 1});
            mesh.faces.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

class Memory : public ::testing::Test {
  protected:
    void SetUp() override {
        if (kIsSanitized || status_bytes("VmHWM") == 0) {
            GTEST_SKIP() << "memory is not measured here";
        }
    }
};

TEST_F(Memory, OfSharedVerticesIsLittle) {
    const double bytes = bytes_a_triangle([] {
        SceneBuilder builder = make_builder();
        OrganSpec organ;
        organ.parts.push_back({"leaf", sheet()});
        builder.add_organ(std::move(organ));
        prepare(std::move(builder));
    });
    EXPECT_LT(bytes, 200);
    EXPECT_GT(bytes, 60);  // it was measured at all
}

TEST_F(Memory, OfTrianglesApartIsThatOfTheirCorners) {
    const double bytes = bytes_a_triangle([] {
        SceneBuilder builder = make_builder();
        builder.add_organ(organ("leaves", "leaf", random_leaves(kTriangles, .001, 1, 1)));
        prepare(std::move(builder));
    });
    EXPECT_LT(bytes, 330);
    EXPECT_GT(bytes, 100);
}

TEST_F(Memory, OfAnOrganForEachTriangleIsBounded) {
    const double bytes = bytes_a_triangle([] {
        SceneBuilder builder = make_builder();
        for (const Triangle& leaf : random_leaves(kTriangles, .001, 1, 1)) {
            builder.add_organ({.parts = {{"leaf", {leaf}}}});
        }
        prepare(std::move(builder));
    });
    EXPECT_LT(bytes, 480);
    EXPECT_GT(bytes, 200);
}

/// Sums of eight replicates are larger than their result.
TEST_F(Memory, OfSumsIsGivenBackWhileTheResultGrows) {
    constexpr const char* kPeak = "/proc/self/clear_refs";
    if (access(kPeak, W_OK) != 0) {
        GTEST_SKIP() << "peaks can't be forgotten here";
    }
    const double bytes = of_child([&] {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        for (const Triangle& leaf : random_leaves(kTriangles, .001, 1, 1)) {
            builder.add_organ({.parts = {{"leaf", {leaf}}}});
        }
        const Scene scene = std::move(builder).build();
        RunSpec spec = spec_of(Method::light_tracing, 64);
        spec.replicates = 8;
        Sums sums = Simulator().sums(scene, {sun(0, {1})}, spec);
        std::ofstream(kPeak) << "5";
        const double before = status_bytes("VmRSS");
        const Result result = evaluate(std::move(sums), scene, {});
        return result.organs() == kTriangles ? status_bytes("VmHWM") - before : NAN;
    });
    EXPECT_LT(bytes, 100);  // the result alone takes 224
    EXPECT_GT(bytes, 1);
}

TEST_F(Memory, OfCopiesIsThatOfOneMesh) {
    const double bytes = bytes_a_triangle([] {
        const auto plant = std::make_shared<const Mesh>(random_leaves(kTriangles / 1000, .1, 1, 1));
        SceneBuilder builder = make_builder();
        for (int i = 0; i < 1000; ++i) {
            Affine transform;
            transform.shift = {1.0 * (i % 32), 1.0 * (i / 32), 0};
            OrganSpec organ;
            organ.parts.push_back({"leaf", {}, plant, transform});
            builder.add_organ(std::move(organ));
        }
        prepare(std::move(builder));
    });
    EXPECT_LT(bytes, 60);
}

}  // namespace
}  // namespace quasimc::test
