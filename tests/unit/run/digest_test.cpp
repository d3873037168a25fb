// Only runs with equal parameters have equal digests.

#include "run/digest.h"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "detectors/catalogue.h"
#include "light/models/source.h"
#include "optics/catalogue.h"
#include "scene/scene.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

std::uint64_t digest(const Scene& scene, const Sources& sources) {
    const PreparedScene prepared(
        scene, sources, StartArea::silhouette,
        std::make_shared<RayCaster>(data_of(scene).geometry, scene.cell(), Accelerator::embree));
    return digest_of(prepared, RunSpec{});
}

/// A leaf under a sensor.
Scene scene_of(const MaterialSpec& leaf, const std::vector<DetectorSpec>& detectors = {}) {
    SceneBuilder builder = make_builder();
    builder.add_material(leaf);
    builder.add_organ(organ("leaf", leaf.name, floor_of(0, 1, 0, 1, 0)));
    for (const DetectorSpec& detector : detectors) {
        builder.add_detector(detector);
    }
    return std::move(builder).build();
}

std::uint64_t digest(const SideOptics& side) {
    return digest(scene_of({"leaf", {side}, {SideOptics{}}}), {sky({1})});
}

std::uint64_t digest(std::shared_ptr<const Source> source) {
    return digest(scene_of(diffuse("leaf", .3, .1)), {std::move(source)});
}

/// Expects all digests to differ.
void expect_distinct(std::vector<std::uint64_t> digests) {
    const std::set<std::uint64_t> distinct(digests.begin(), digests.end());
    EXPECT_EQ(distinct.size(), digests.size());
}

TEST(Digest, IsTheSameForTheSameParameters) {
    EXPECT_EQ(digest(sky({1})), digest(sky({1})));
    EXPECT_EQ(digest(SideOptics{.reflectance = .2}), digest(SideOptics{.reflectance = .2}));
}

TEST(Digest, DistinguishesASensorFromABlackLeaf) {
    EXPECT_NE(
        digest(scene_of(diffuse("leaf", 0, 0)), {sky({1})}),
        digest(scene_of(sensor("leaf", 1)), {sky({1})}));
}

TEST(Digest, ChangesWithEveryParameterOfEveryLobeModel) {
    std::vector<std::uint64_t> digests;
    for (const BsdfEntry& model : bsdf_catalogue()) {
        const std::string name(model.name);
        BsdfParameters usual;
        for (const BsdfParameter& parameter : model.parameters) {
            usual[std::string(parameter.name)] =
                parameter.low + (parameter.high - parameter.low) / 4;
        }
        digests.push_back(
            digest({.reflectance = .2, .reflection_model = name, .reflection_parameters = usual}));
        digests.push_back(digest(
            {.transmittance = .2, .transmission_model = name, .transmission_parameters = usual}));
        for (const BsdfParameter& parameter : model.parameters) {
            BsdfParameters other = usual;
            other[std::string(parameter.name)] *= 1 + 1e-9;
            digests.push_back(digest(
                {.reflectance = .2, .reflection_model = name, .reflection_parameters = other}));
        }
    }
    digests.push_back(digest(SideOptics{.reflectance = .2 + 1e-12}));
    expect_distinct(std::move(digests));
}

TEST(Digest, ChangesWithEveryParameterOfEverySky) {
    const SkyState usual{
        .to_sun = normalized({.3, .2, .8}), .direct_normal = 300, .diffuse_horizontal = 400};
    for (const SkyEntry& model : sky_catalogue()) {
        std::vector<SkyState> states{usual};
        const auto change = [&](SkyNeeds needs, const auto& set) {
            if (model.needs == needs) {
                set(states.emplace_back(usual));
            }
        };
        if (model.needs != SkyNeeds::nothing) {
            states.emplace_back(usual).to_sun = normalized({.3, .2 + 1e-9, .8});
        }
        change(SkyNeeds::sun_and_type, [](SkyState& state) { state.cie_type = 11; });
        change(SkyNeeds::sun_and_turbidity, [](SkyState& state) { state.turbidity += 1e-9; });
        change(SkyNeeds::sun_and_weather, [](SkyState& state) { state.direct_normal = 900; });
        change(SkyNeeds::sun_and_weather, [](SkyState& state) { state.diffuse_horizontal += 50; });
        change(SkyNeeds::sun_and_weather, [](SkyState& state) { state.distance_au += .01; });
        std::vector<std::uint64_t> digests;
        for (const SkyState& state : states) {
            digests.push_back(digest(make_sky("sky", model.make(state), {1})));
        }
        expect_distinct(std::move(digests));
    }
}

TEST(Digest, ChangesWithEveryCellOfATableOfTheSky) {
    SkyTable table{.azimuths = 5, .elevations = 4, .radiance = std::vector<double>(20, 1)};
    std::vector<std::uint64_t> digests{digest(make_sky("sky", table_shape(table), {1}))};
    for (double& cell : table.radiance) {
        cell += 1e-9;
        digests.push_back(digest(make_sky("sky", table_shape(table), {1})));
    }
    table.first_azimuth = 1e-6;
    digests.push_back(digest(make_sky("sky", table_shape(table), {1})));
    expect_distinct(std::move(digests));
}

TEST(Digest, ChangesWithEveryParameterOfSuns) {
    const Vec3 up{0, 0, 1};
    const Vec3 off = normalized({1e-9, 0, 1});
    expect_distinct(
        {digest(make_directional_source("sun", -up, {1})),
         digest(make_directional_source("sun", -off, {1})),
         digest(make_directional_source("sun", -up, {1 + 1e-12})),
         digest(make_sun_disk("sun", up, .26, {1})), digest(make_sun_disk("sun", off, .26, {1})),
         digest(make_sun_disk("sun", up, .26 + 1e-9, {1})),
         digest(make_dimmed(make_sun_disk("sun", up, .26, {1}), .5))});
}

TEST(Digest, ChangesWithEveryParameterOfLamps) {
    LampSpec usual;
    usual.position = {0, 0, 2};
    usual.flux = {1};
    std::vector<LampSpec> lamps{usual};
    const auto change = [&](const auto& set) { set(lamps.emplace_back(usual)); };
    change([](LampSpec& lamp) { lamp.position.y += 1e-9; });
    change([](LampSpec& lamp) { lamp.axes = lamp_axes({0, 1e-9, -1}, {1, 0, 0}); });
    change([](LampSpec& lamp) { lamp.flux = {2}; });
    using Kind = Opening::Kind;
    for (const Opening& opening :
         {Opening{Kind::line, .5, 0, 0}, Opening{Kind::line, .6, 0, 0},
          Opening{Kind::rectangle, .5, .2, 0}, Opening{Kind::rectangle, .5, .3, 0},
          Opening{Kind::disk, 0, 0, .1}, Opening{Kind::disk, 0, 0, .2},
          Opening{Kind::sphere, 0, 0, .1}}) {
        change([&](LampSpec& lamp) { lamp.opening = opening; });
    }
    const auto web = [](double candela) {
        return web_pattern({{0, 45, 90}, {0, 180}, {3, 2, 1, 3, candela, 1}});
    };
    for (const Pattern& pattern :
         {cosine_pattern(), power_cosine_pattern(2), power_cosine_pattern(2 + 1e-9),
          spot_pattern(.2, .4), spot_pattern(.2 + 1e-9, .4), spot_pattern(.2, .4 + 1e-9),
          tube_pattern(), web(2), web(2 + 1e-9)}) {
        change([&](LampSpec& lamp) { lamp.pattern = pattern; });
    }
    std::vector<std::uint64_t> digests;
    for (const LampSpec& lamp : lamps) {
        digests.push_back(digest(make_lamp(lamp)));
    }
    expect_distinct(std::move(digests));
}

TEST(Digest, ChangesWithEveryParameterOfEveryDetector) {
    std::vector<std::uint64_t> digests;
    const auto add = [&](const DetectorSpec& spec) {
        digests.push_back(digest(scene_of(diffuse("leaf", .3, .1), {spec}), {sky({1})}));
    };
    for (const DetectorEntry& type : detector_catalogue()) {
        DetectorSpec spec{.type = std::string(type.name)};
        for (const DetectorParameter& parameter : type.parameters) {
            spec.parameters[std::string(parameter.name)] = parameter.low;
        }
        add(spec);
        for (const DetectorParameter& parameter : type.parameters) {
            DetectorSpec other = spec;
            other.parameters[std::string(parameter.name)] = parameter.high;
            add(other);
        }
    }
    expect_distinct(std::move(digests));
}

/// A sky that starts its paths as a uniform one, wherever it is probed, but shows a spot.
class SpottedSky final : public SourceModel {
  public:
    explicit SpottedSky(double spot)
        : SourceModel("spotted", {1}, kSkyTraits, 1),
          sky_(make_uniform_sky("sky", {1})),
          spot_(spot) {}
    [[nodiscard]] ModelParameters parameters() const override { return {"spotted", {spot_}}; }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        return model_of(*sky_).make_sampler_in(projection);
    }
    [[nodiscard]] Illumination illuminate(const Vec3& point, double u0, double u1) const override {
        return model_of(*sky_).illuminate(point, u0, u1);
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return model_of(*sky_).radiance(to_light) + (to_light.z > 1 - 1e-6 ? spot_ : 0);
    }

  private:
    std::shared_ptr<const Source> sky_;
    double spot_;
};

TEST(Digest, DistinguishesSourcesThatStartEqualPaths) {
    EXPECT_NE(digest(std::make_shared<SpottedSky>(1)), digest(std::make_shared<SpottedSky>(2)));
}

}  // namespace
}  // namespace quasimc::test
