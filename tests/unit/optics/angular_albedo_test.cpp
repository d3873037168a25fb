// A lobe whose albedo depends on the angle of incidence, as of waxy leaves. No model of the
// catalogue has one yet, so two models of this file test the interface: a Lambertian layer under a
// coat, with two parameters, and the mirror of the coat itself.

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics/directions.h"
#include "optics/material.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

/// Schlick's (1994) approximation of Fresnel's reflectance.
double fresnel(double at_normal, double cosine) {
    return at_normal + (1 - at_normal) * std::pow(1 - cosine, 5);
}

/// Light that has passed the coat and leaves by cos^k of the angle to the normal.
class UnderACoat final : public Bsdf {
  public:
    UnderACoat(Hemisphere hemisphere, double at_normal, double k)
        : Bsdf(hemisphere), at_normal_(at_normal), k_(k) {}

    [[nodiscard]] Vec3 sample(
        const Vec3& n, const Vec3& /*wi*/, double u0, double u1) const override {
        const double cosine = std::pow(1 - u0, 1 / (k_ + 1));
        const Vec3 axis = hemisphere() == Hemisphere::reflected ? n : -n;
        return direction_about(axis, cosine, std::sqrt((1 - cosine) * (1 + cosine)), u1);
    }
    [[nodiscard]] double pdf(const Vec3& n, const Vec3& /*wi*/, const Vec3& wo) const override {
        const double cosine = outgoing_cosine(hemisphere(), n, wo);
        return cosine > 0 ? (k_ + 1) / (2 * std::numbers::pi) * std::pow(cosine, k_) : 0;
    }
    [[nodiscard]] double relative_albedo(double cosine) const override {
        return 1 - fresnel(at_normal_, cosine);
    }
    [[nodiscard]] bool has_constant_albedo() const override { return false; }
    [[nodiscard]] ModelParameters parameters() const override {
        return {"under_a_coat", {at_normal_, k_}};
    }
    [[nodiscard]] bool is_reciprocal() const override { return false; }

  private:
    double at_normal_, k_;
};

/// The coat's own reflection.
class Coat final : public Bsdf {
  public:
    explicit Coat(double at_normal) : Bsdf(Hemisphere::reflected), at_normal_(at_normal) {}
    [[nodiscard]] Vec3 sample(
        const Vec3& n, const Vec3& wi, double /*u0*/, double /*u1*/) const override {
        return reflected(wi, n);
    }
    [[nodiscard]] double pdf(
        const Vec3& /*n*/, const Vec3& /*wi*/, const Vec3& /*wo*/) const override {
        return 0;
    }
    [[nodiscard]] double relative_albedo(double cosine) const override {
        return fresnel(at_normal_, cosine);
    }
    [[nodiscard]] bool has_constant_albedo() const override { return false; }
    [[nodiscard]] bool is_delta() const override { return true; }
    [[nodiscard]] ModelParameters parameters() const override { return {"coat", {at_normal_}}; }
    [[nodiscard]] bool is_reciprocal() const override { return true; }

  private:
    double at_normal_;
};

constexpr double kAtNormal = 0.04;

/// A waxy side: coat, two Lambertian lobes below it in one hemisphere, and one through the leaf.
Side waxy_side(std::size_t bands) {
    const std::vector<double> all(bands, 1.0);
    std::vector<double> diffuse, sharp, through;
    for (std::size_t b = 0; b < bands; ++b) {
        const auto x = static_cast<double>(b);
        diffuse.push_back(0.15 + 0.1 * std::sin(x));
        sharp.push_back(0.1 + 0.05 * std::cos(x));
        through.push_back(0.3 + 0.1 * std::cos(2 * x));
    }
    const auto below_side = [](Hemisphere hemisphere, double k) {
        return std::make_shared<UnderACoat>(hemisphere, kAtNormal, k);
    };
    return {
        {{std::make_shared<Coat>(kAtNormal), all},
         {below_side(Hemisphere::reflected, 1), diffuse},
         {below_side(Hemisphere::reflected, 6), sharp},
         {below_side(Hemisphere::transmitted, 2), through}},
        bands};
}

class WaxyLeaf : public ::testing::TestWithParam<std::size_t> {
  protected:
    std::size_t bands_ = GetParam();
    Material leaf_{"waxy", waxy_side(bands_), waxy_side(bands_)};
    std::vector<double> before_ = varied_weights(bands_);

    /// A lobe of the side, all of its sides being alike.
    [[nodiscard]] std::span<const Lobe> lobes() const {
        return leaf_.side(SurfaceSide::upper).lobes();
    }

    template <typename Expected>
    void expect_mean(
        const std::vector<RunningMean>& means, const Expected& expected, std::string_view what) {
        for (std::size_t b = 0; b < bands_; ++b) {
            EXPECT_TRUE(agrees(
                means[b].measured(), before_[b] * expected(b), 0.05, sidak_level(kLevel, 100)))
                << what << ", band " << b;
        }
    }
};

TEST_P(WaxyLeaf, TellsItsAlbedoAtEveryAngle) {
    const Side& side = leaf_.side(SurfaceSide::upper);
    EXPECT_FALSE(side.has_constant_albedo());
    EXPECT_FALSE(leaf_.has_constant_albedo());
    for (const double cosine : {1.0, 0.7, 0.2, 0.01}) {
        const double f = fresnel(kAtNormal, cosine);
        for (std::size_t b = 0; b < bands_; ++b) {
            const double below_side =
                lobes()[1].albedo[b] + lobes()[2].albedo[b] + lobes()[3].albedo[b];
            EXPECT_NEAR(side.albedo(b, cosine), f + (1 - f) * below_side, 1e-15);
            EXPECT_NEAR(side.absorptance(b, cosine), (1 - f) * (1 - below_side), 1e-15);
        }
    }
}

TEST_P(WaxyLeaf, ScatteredLightIsTheAlbedoAtTheAngleInEveryBand) {
    for (const double theta_deg : {0.0, 50.0, 80.0}) {
        const Vec3 n = incidence_at(theta_deg).n;
        const Vec3 wi = incidence_at(theta_deg).wi;
        std::vector<RunningMean> all(bands_), skew(bands_);
        Random random(5);
        for (int i = 0; i < 200000; ++i) {
            std::vector<double> weights = before_;
            const double u0 = random();
            const auto scattered =
                leaf_.side(SurfaceSide::upper).scatter(n, wi, {u0, random()}, weights);
            for (std::size_t b = 0; b < bands_; ++b) {
                all[b].add(scattered ? weights[b] : 0);
                skew[b].add(scattered ? weights[b] * smooth(1, scattered->wo) : 0);
            }
        }
        const double cosine = -dot(wi, n);
        expect_mean(
            all, [&](std::size_t b) { return leaf_.side(SurfaceSide::upper).albedo(b, cosine); },
            "all");
        expect_mean(
            skew,
            [&](std::size_t b) {
                double sum = 0;
                for (const Lobe& lobe : lobes()) {
                    const auto pdf = [&](const Vec3& wo) {
                        return lobe.shape->pdf(n, wi, wo) * smooth(1, wo);
                    };
                    sum += lobe.albedo[b] * lobe.shape->relative_albedo(cosine) *
                           (lobe.shape->is_delta() ? smooth(1, reflected(wi, n))
                                                   : sphere_integral(pdf, n, 1e-4));
                }
                return sum;
            },
            "skew");
    }
}

TEST_P(WaxyLeaf, InTwoStepsItScattersTheSame) {
    const auto [n, wi] = incidence_at(60);
    const Side& side = leaf_.side(SurfaceSide::upper);
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        std::vector<double> weights = before_, in_steps = before_;
        const double u0 = random(), u1 = random();
        const auto scattered = side.scatter(n, wi, {u0, u1}, weights);
        const LobeTable::Choice choice = side.choose(n, wi, {u0, 0}, in_steps);
        ASSERT_EQ(scattered.has_value(), choice.row != nullptr);
        if (scattered) {
            EXPECT_EQ(side.scatter_by(choice, n, wi, u1, in_steps).wo, scattered->wo);
            EXPECT_EQ(in_steps, weights);
        }
    }
}

/// The double integral of g(wi) |cos wi| BSDF |cos wo| h(wo), from either end.
TEST_P(WaxyLeaf, GatherAndScatterGiveTheSameTransport) {
    std::vector<RunningMean> forwards(bands_), backwards(bands_);
    const Vec3 n = incidence_at(0).n;
    Random random(11);
    const auto draw = [&](const Vec3& normal) {
        const double z = std::sqrt(random());
        return direction_at(normal, z, random());
    };
    for (int i = 0; i < 300000; ++i) {
        const SurfaceSide at = random() < 0.5 ? SurfaceSide::upper : SurfaceSide::lower;
        const Vec3 arrival_normal = at == SurfaceSide::upper ? n : -n;
        std::vector<double> weights(bands_, 2.0);
        const Vec3 wi = -draw(arrival_normal);
        double u0 = random();
        const auto scattered = leaf_.side(at).scatter(arrival_normal, wi, {u0, random()}, weights);
        const bool counts = scattered && dot(scattered->wo, n) > 0;
        const double g = counts ? smooth(1, wi) * smooth(2, scattered->wo) : 0;

        std::vector<double> weights_back(bands_, 1.0);
        const Vec3 wo = draw(n);
        u0 = random();
        const auto gathered = leaf_.gather(n, SurfaceSide::upper, wo, {u0, random()}, weights_back);
        const double g_back = gathered ? smooth(1, gathered->wi) * smooth(2, wo) : 0;
        for (std::size_t b = 0; b < bands_; ++b) {
            forwards[b].add(g * weights[b]);
            backwards[b].add(g_back * weights_back[b]);
        }
    }
    for (std::size_t b = 0; b < bands_; ++b) {
        EXPECT_TRUE(
            agrees(forwards[b].measured(), backwards[b].measured(), 0.03, sidak_level(kLevel, 5)))
            << "band " << b;
    }
}

TEST_P(WaxyLeaf, LookingUpEqualsTheDefinition) {
    Random random(12);
    const Vec3 n = incidence_at(0).n;
    for (int i = 0; i < 100; ++i) {
        const double z = random();
        const Vec3 wo = direction_at(n, z, random());
        const Vec3 wi = -direction_at(n, random(), 0.3);
        const double f = fresnel(kAtNormal, -dot(wi, n));
        std::vector<double> out(bands_, 0.0);
        leaf_.add_reflected(n, SurfaceSide::upper, wo, wi, 3.0, before_, out);
        for (std::size_t b = 0; b < bands_; ++b) {
            const double diffuse = lobes()[1].albedo[b] / std::numbers::pi;
            const double sharp =
                lobes()[2].albedo[b] * 7 / (2 * std::numbers::pi) * std::pow(dot(wo, n), 5);
            const double expected = 3 * before_[b] * (1 - f) * (diffuse + sharp) * -dot(wi, n);
            ASSERT_NEAR(out[b], expected, 1e-12 * expected);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bands, WaxyLeaf, ::testing::Values(1, 2, 12));

TEST(AngularAlbedo, LobesOfItAreNotMergedWithThoseOfAConstantOne) {
    const std::shared_ptr<const Bsdf> mirror = find_bsdf("mirror")->make(Hemisphere::reflected, {});
    const Side side({{std::make_shared<Coat>(0.1), {0.5}}, {mirror, {0.25}}}, 1);
    EXPECT_EQ(side.lobes().size(), 2U);
    EXPECT_DOUBLE_EQ(side.albedo(0, 1), 0.5 * 0.1 + 0.25);
    EXPECT_DOUBLE_EQ(side.albedo(0, 0), 0.75);
    EXPECT_EQ(side.albedo()[0], 0.75) << "the largest";
}

TEST(AngularAlbedo, ASideWithoutItHasOneAlbedo) {
    const Material leaf = make_material(varied_leaf(3, 3), 3);
    EXPECT_TRUE(leaf.has_constant_albedo());
    for (std::size_t b = 0; b < 3; ++b) {
        EXPECT_EQ(
            leaf.side(SurfaceSide::upper).albedo(b, 0.3),
            leaf.side(SurfaceSide::upper).albedo()[b]);
        EXPECT_EQ(
            leaf.side(SurfaceSide::upper).absorptance(b, 0.3),
            leaf.side(SurfaceSide::upper).absorptance()[b]);
    }
}

/// The comparison of both ways must notice that the angle is forgotten.
TEST(AngularAlbedoControl, AnAlbedoTakenForConstantIsFoundOut) {
    const UnderACoat lobe(Hemisphere::reflected, kAtNormal, 1);
    const auto [n, wi] = incidence_at(80);
    RunningMean mean;
    Random random(13);
    for (int i = 0; i < 10000; ++i) {
        mean.add(random() < lobe.relative_albedo(1) ? 1 : 0);
    }
    EXPECT_FALSE(agrees(mean.measured(), lobe.relative_albedo(-dot(wi, n)), 0.05));
}

}  // namespace
}  // namespace quasimc::test
