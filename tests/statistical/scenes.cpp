#include "statistical/scenes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "solvers/catalogue.h"

namespace quasimc::test {
namespace {

/// Relative to the expected value; see holds().
constexpr double kPrecision = 1e-6;

}  // namespace

MaterialSpec diffuse(std::string name, double rho, double tau, std::size_t bands) {
    const std::vector<SideOptics> side(bands, {.reflectance = rho, .transmittance = tau});
    return {std::move(name), side, side};
}

MaterialSpec net(std::string name, const std::vector<double>& tau) {
    std::vector<SideOptics> side;
    for (const double t : tau) {
        side.push_back({.transmittance = t, .transmission_model = "mirror"});
    }
    return {std::move(name), side, side};
}

MaterialSpec sensor(std::string name, std::size_t bands) {
    return net(std::move(name), std::vector<double>(bands, 1.0));
}

OrganSpec organ(std::string name, std::string material, std::vector<Triangle> triangles) {
    OrganSpec spec;
    spec.name = std::move(name);
    spec.parts.push_back({std::move(material), std::move(triangles)});
    return spec;
}

OrganSpec labelled(OrganSpec organ, Labels labels) {
    organ.labels = std::move(labels);
    return organ;
}

void add_leaves(SceneBuilder& builder, const std::vector<Triangle>& leaves) {
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        OrganSpec leaf = organ("", "leaf", {leaves[i]});
        leaf.labels = {{"plant", std::to_string(i / 5)}};
        builder.add_organ(std::move(leaf));
    }
}

GroundSpec ground(std::string material) {
    GroundSpec spec;
    spec.material = std::move(material);
    return spec;
}

SceneBuilder make_builder(std::size_t bands) {
    std::vector<Band> names;
    for (std::size_t b = 0; b < bands; ++b) {
        names.push_back({fmt::format("b{}", b)});
    }
    return SceneBuilder(std::move(names));
}

std::vector<Triangle> floor_of(double x0, double x1, double y0, double y1, double z) {
    return make_parallelogram({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0});
}

std::vector<Triangle> turned_over(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) {
        std::swap(t[1], t[2]);
    }
    return triangles;
}

std::shared_ptr<const Source> sun(double zenith_deg, const std::vector<double>& facing) {
    const double angle = zenith_deg * std::numbers::pi / 180;
    return make_directional_source("sun", {std::sin(angle), 0, -std::cos(angle)}, facing);
}

std::shared_ptr<const Source> sky(const std::vector<double>& horizontal) {
    return make_uniform_sky("sky", horizontal);
}

RunSpec spec_of(Method from, std::uint64_t paths) {
    RunSpec spec;
    spec.method = from;
    spec.paths = paths;
    spec.replicates = kReplicates;
    spec.threads = 1;
    return spec;
}

::testing::AssertionResult holds(const Claim& claim, Measured m) {
    ::testing::Test::RecordProperty(
        claim.what, fmt::format(
                        "{:.9g} {:.9g} {:.3g} {:.3g}", claim.expected, m.mean, m.standard_error,
                        claim.resolution));
    m.standard_error = std::hypot(m.standard_error, kPrecision * claim.expected);
    return agrees(m, claim.expected, claim.resolution, sidak_level(kLevel, claim.family))
           << " (" << claim.what << ")";
}

::testing::AssertionResult holds(const Claim& claim, const Estimate& estimate) {
    return holds(claim, measured(estimate, kReplicates));
}

std::string name_of(const ::testing::TestParamInfo<Method>& info) {
    const SolverEntry* solver = find_solver(info.param);
    return solver == nullptr ? "auto" : std::string(solver->name);
}

Scene leaf_over_ground(double rho, double tau) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", rho, tau));
    builder.add_material(diffuse("soil", .3, 0));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, .5)));
    GroundSpec soil = ground("soil");
    soil.extent = {{-1, -1, 2, 2}};
    builder.set_ground(soil);
    return std::move(builder).build();
}

Scene black_tube(double height) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("leaf", "black", floor_of(0, 1, 0, 1, 0)));
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Triangle> walls;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 up{0, 0, height};
        const Vec3& a = corners[i];
        const Vec3& b = corners[(i + 1) % 4];
        walls.push_back({a, b, b + up});
        walls.push_back({a, b + up, a + up});
    }
    builder.add_organ(organ("tube", "black", walls));
    return std::move(builder).build();
}

double tube_view_factor(double height) {
    const double x = 1 / height;
    const double root = std::sqrt(1 + x * x);
    return 2 / (std::numbers::pi * x * x) *
           (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) + 2 * x * root * std::atan(x / root) -
            2 * x * std::atan(x));
}

}  // namespace quasimc::test
