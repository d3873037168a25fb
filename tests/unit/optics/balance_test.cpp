// The heart of the matter: light of many bands on one path, each with a shape of its own, is
// unbiased in every band, forwards (scatter), backwards (gather) and looked up (add_reflected).

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

struct Spectrum {
    std::size_t bands, exponents;
    double theta_deg;
    unsigned paths;
    double roulette_threshold =
        std::numeric_limits<double>::infinity();  ///< of the sum of the weights
};

class ManyBands : public ::testing::TestWithParam<Spectrum> {
  protected:
    static constexpr unsigned kFamily = 5000;  // bands x functions x spectra x kinds, at least

    std::size_t bands_ = GetParam().bands;
    Material leaf_ = make_material(varied_leaf(bands_, GetParam().exponents), bands_);
    std::vector<double> before_ = varied_weights(bands_);
    Incidence at_ = incidence_at(GetParam().theta_deg);

    /// Compares the mean of w_b g(direction), one for each band and smooth function, as `draw`
    /// gives them, with w_b times expected(band, function).
    template <typename Draw>
    void expect_unbiased(
        const Draw& draw, const std::vector<std::vector<double>>& expected, double resolution) {
        std::vector<RunningMean> means(bands_ * kSmoothFunctions);
        Random random(9);
        for (unsigned i = 0; i < GetParam().paths; ++i) {
            std::vector<double> weights = before_;
            const double u0 = random();
            const std::optional<Vec3> direction = draw(u0, random(), weights);
            for (std::size_t f = 0; f < kSmoothFunctions; ++f) {
                const double g = direction ? smooth(static_cast<int>(f), *direction) : 0;
                for (std::size_t b = 0; b < bands_; ++b) {
                    means[b * kSmoothFunctions + f].add(g * weights[b]);
                }
            }
        }
        for (std::size_t b = 0; b < bands_; ++b) {
            for (std::size_t f = 0; f < kSmoothFunctions; ++f) {
                EXPECT_TRUE(agrees(
                    means[b * kSmoothFunctions + f].measured(), before_[b] * expected[b][f],
                    resolution, sidak_level(kLevel, kFamily)))
                    << "band " << b << " function " << f;
            }
        }
    }

    /// sum_k a_kb integral over directions of value_k(d) g(d), for every band and smooth function,
    /// or value_k g at the one direction of a mirror.
    template <typename Value>
    void add_expected(
        const Lobe& lobe,
        const Value& value,
        const Vec3& one_direction,
        std::vector<std::vector<double>>& expected) {
        for (int f = 0; f < kSmoothFunctions; ++f) {
            const auto integrand = [&](const Vec3& d) { return value(d) * smooth(f, d); };
            const double total = lobe.shape->is_delta() ? smooth(f, one_direction)
                                                        : sphere_integral(integrand, at_.n, 1e-5);
            for (std::size_t b = 0; b < bands_; ++b) {
                expected[b][static_cast<std::size_t>(f)] += lobe.albedo[b] * total;
            }
        }
    }

    [[nodiscard]] std::vector<std::vector<double>> zeros() const {
        return {bands_, std::vector<double>(kSmoothFunctions)};
    }
};

TEST_P(ManyBands, ScatterIsUnbiasedInEveryBand) {
    const Side& side = leaf_.side(SurfaceSide::lower);
    auto expected = zeros();
    for (const Lobe& lobe : side.lobes()) {
        const auto pdf = [&](const Vec3& wo) { return lobe.shape->pdf(at_.n, at_.wi, wo); };
        add_expected(lobe, pdf, lobe.shape->sample(at_.n, at_.wi, 0, 0), expected);
    }
    const auto draw = [&](double u0, double u1, std::span<double> w) {
        const auto scattered =
            side.scatter(at_.n, at_.wi, {u0, u1, GetParam().roulette_threshold}, w);
        return scattered ? std::optional(scattered->wo) : std::nullopt;
    };
    expect_unbiased(draw, expected, 0.2);
}

TEST_P(ManyBands, GatherIsUnbiasedInEveryBand) {
    const Vec3 wo = -at_.wi;
    auto expected = zeros();
    for (const bool is_through : {false, true}) {
        const auto hemisphere = is_through ? Hemisphere::transmitted : Hemisphere::reflected;
        const Vec3 arrival_normal = is_through ? -at_.n : at_.n;
        for (const Lobe& lobe : leaf_.side(is_through ? SurfaceSide::upper : SurfaceSide::lower)
                                    .lobes()) {  // leaves on the lower side
            if (lobe.shape->hemisphere() != hemisphere) {
                continue;
            }
            const auto value = [&](const Vec3& wi) {
                const double cosine = -dot(wi, arrival_normal);
                return cosine > 0 ? lobe.shape->pdf(arrival_normal, wi, wo) /
                                        std::abs(dot(wo, at_.n)) * cosine
                                  : 0;
            };
            add_expected(lobe, value, is_through ? wo : reflected(wo, at_.n), expected);
        }
    }
    const auto draw = [&](double u0, double u1, std::span<double> w) {
        const auto gathered =
            leaf_.gather(at_.n, SurfaceSide::lower, wo, {u0, u1, GetParam().roulette_threshold}, w);
        return gathered ? std::optional(gathered->wi) : std::nullopt;
    };
    expect_unbiased(draw, expected, 0.2);
}

TEST_P(ManyBands, LookingUpEqualsTheDefinition) {
    const Vec3 wo = -at_.wi;
    Random random(10);
    for (int i = 0; i < 200; ++i) {
        const SurfaceSide at = random() < 0.5 ? SurfaceSide::upper : SurfaceSide::lower;
        const bool is_through = random() < 0.5;
        const Vec3 arrival_normal = is_through ? -at_.n : at_.n;
        const double z = random();
        const Vec3 wi = -direction_at(arrival_normal, z, random());
        std::vector<double> expected(bands_, 7.0);
        for (const Lobe& lobe : leaf_.side(is_through ? opposite(at) : at).lobes()) {
            const double bsdf = lobe.shape->pdf(arrival_normal, wi, wo) / std::abs(dot(wo, at_.n));
            for (std::size_t b = 0; b < bands_; ++b) {
                expected[b] += 3 * lobe.albedo[b] * bsdf * std::abs(dot(wi, at_.n)) * before_[b];
            }
        }
        std::vector<double> out(bands_, 7.0);
        leaf_.add_reflected(at_.n, at, wo, wi, 3.0, before_, out);
        for (std::size_t b = 0; b < bands_; ++b) {
            ASSERT_NEAR(out[b], expected[b], 1e-9 * expected[b]);
        }
    }
}

std::string spectrum_name(const ::testing::TestParamInfo<Spectrum>& info) {
    return std::to_string(info.param.bands) + "_bands_" + std::to_string(info.param.exponents) +
           "_exponents_at_" + std::to_string(static_cast<int>(info.param.theta_deg)) + "_degrees" +
           (std::isfinite(info.param.roulette_threshold) ? "_certain" : "");
}

INSTANTIATE_TEST_SUITE_P(
    Spectra,
    ManyBands,
    ::testing::Values(
        Spectrum{1, 1, 50, 200000},
        Spectrum{2, 2, 30, 200000},
        Spectrum{3, 3, 75, 200000},
        Spectrum{3, 1, 50, 200000},
        Spectrum{3, 3, 50, 200000, 2.0},
        Spectrum{20, 8, 50, 100000},
        Spectrum{200, 6, 20, 50000}),
    spectrum_name);

/// Forwards and backwards are the same transport: the double integral of
/// h(wi) |cos wi| BSDF |cos wo| g(wo), from either end.
TEST(ManyBandsReversed, GatherAndScatterGiveTheSameTransport) {
    constexpr std::size_t kBands = 4;
    constexpr unsigned kPaths = 200000;
    const Material leaf = make_material(varied_leaf(kBands, kBands), kBands);
    const Vec3 n = incidence_at(0).n;
    std::vector<RunningMean> forwards(kBands);
    std::vector<RunningMean> backwards(kBands);
    Random random(11);
    const auto random_direction = [&](const Vec3& normal) {
        const double z = std::sqrt(random());
        return direction_at(normal, z, random());
    };
    for (unsigned i = 0; i < kPaths; ++i) {
        // Light leaves on the upper side; it arrives there or, as often, on the lower side.
        const SurfaceSide at = random() < 0.5 ? SurfaceSide::upper : SurfaceSide::lower;
        const Vec3 arrival_normal = at == SurfaceSide::upper ? n : -n;
        std::vector<double> weights(kBands, 2.0);
        const Vec3 wi = -random_direction(arrival_normal);
        double u0 = random();
        const auto scattered = leaf.side(at).scatter(arrival_normal, wi, {u0, random()}, weights);
        const bool counts = scattered && dot(scattered->wo, n) > 0;
        const double g = counts ? smooth(1, wi) * smooth(2, scattered->wo) : 0;

        std::vector<double> weights_back(kBands, 1.0);
        const Vec3 wo = random_direction(n);
        u0 = random();
        const auto gathered = leaf.gather(n, SurfaceSide::upper, wo, {u0, random()}, weights_back);
        const double g_back = gathered ? smooth(1, gathered->wi) * smooth(2, wo) : 0;
        for (std::size_t b = 0; b < kBands; ++b) {
            forwards[b].add(g * weights[b]);
            backwards[b].add(g_back * weights_back[b]);
        }
    }
    for (std::size_t b = 0; b < kBands; ++b) {
        EXPECT_TRUE(agrees(
            forwards[b].measured(), backwards[b].measured(), 0.03, sidak_level(kLevel, kBands)))
            << "band " << b;
    }
}

/// What the older program did: the lobe of one band, drawn by its share, for all bands without
/// correction. The comparison above must find that out.
TEST(ManyBandsControl, OneBandsExponentForAllIsFoundOut) {
    const auto wide = find_bsdf("phong")->make(Hemisphere::reflected, std::array{1.0});
    const auto narrow = find_bsdf("phong")->make(Hemisphere::reflected, std::array{20.0});
    const Incidence at = incidence_at(30);
    RunningMean mean;
    Random random(12);
    for (int i = 0; i < 100000; ++i) {
        const Bsdf& drawn = random() < 0.5 ? *wide : *narrow;
        const double u0 = random();
        mean.add(smooth(2, drawn.sample(at.n, at.wi, u0, random())));
    }
    const double expected = sphere_integral(
        [&](const Vec3& wo) { return wide->pdf(at.n, at.wi, wo) * smooth(2, wo); }, at.n, 1e-5);
    EXPECT_FALSE(agrees(mean.measured(), expected, 0.1));
}

}  // namespace
}  // namespace quasimc::test
