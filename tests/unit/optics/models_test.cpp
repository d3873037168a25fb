// Every model of the catalogue, reflected and transmitted, over exponents and angles of incidence.

#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics/directions.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

constexpr std::array kAnglesDeg = {0.0, 30.0, 60.0, 85.0, 89.9};

struct Cell {
    const BsdfEntry* entry;
    Hemisphere hemisphere;
    double exponent;
};

std::vector<Cell> grid() {
    const std::vector<double> some{0.0, 1.0, 2.5, 10.0, 100.0, 1000.0};
    std::vector<Cell> cells;
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        for (const double exponent : entry.has_exponent ? some : std::vector{0.0}) {
            cells.push_back({&entry, Hemisphere::reflected, exponent});
            cells.push_back({&entry, Hemisphere::transmitted, exponent});
        }
    }
    return cells;
}

std::string name_of(const ::testing::TestParamInfo<Cell>& info) {
    const Cell& c = info.param;
    std::string name(c.entry->name);
    name += c.hemisphere == Hemisphere::reflected ? "_reflected" : "_transmitted";
    return name + "_exponent_" + std::to_string(static_cast<int>(10 * c.exponent)) + "_tenths";
}

/// A lobe met by light from each of the angles of incidence.
class EveryModel : public ::testing::TestWithParam<Cell> {
  protected:
    std::unique_ptr<Bsdf> bsdf_ =
        GetParam().entry->make(GetParam().hemisphere, GetParam().exponent);

    /// A lobe with light that arrives.
    struct Met {
        const Bsdf& bsdf;
        Vec3 n, wi;
        Vec3 out_normal;  ///< of the side where light leaves

        [[nodiscard]] double pdf(const Vec3& wo) const { return bsdf.pdf(n, wi, wo); }
        [[nodiscard]] double value(const Vec3& wo) const { return bsdf.bsdf(n, wi, wo); }
        [[nodiscard]] Vec3 sample(double u0, double u1) const { return bsdf.sample(n, wi, u0, u1); }
        /// With -wo and -wi exchanged.
        [[nodiscard]] double reversed_pdf(const Vec3& wo) const {
            return bsdf.pdf(out_normal, -wo, -wi);
        }
        [[nodiscard]] double reversed_value(const Vec3& wo) const {
            return bsdf.bsdf(out_normal, -wo, -wi);
        }
    };

    template <typename Check>
    void at_every_angle(const Check& check) const {
        for (const double theta_deg : kAnglesDeg) {
            SCOPED_TRACE(theta_deg);
            const auto [n, wi] = incidence_at(theta_deg);
            const bool is_reflected = bsdf_->hemisphere() == Hemisphere::reflected;
            check(Met{*bsdf_, n, wi, is_reflected ? n : -n});
        }
    }
};

TEST_P(EveryModel, SendsLightToItsHemisphereOnly) {
    at_every_angle([](const Met& lobe) {
        Random random(2);
        for (int i = 0; i < 2000; ++i) {
            const double u0 = random();
            const Vec3 wo = lobe.sample(u0, random());
            ASSERT_NEAR(length(wo), 1, 1e-14);
            ASSERT_GE(dot(wo, lobe.out_normal), -1e-15);
            if (dot(wo, lobe.out_normal) > 1e-12) {  // else the side is lost in rounding
                const Vec3 image = reflected(wo, lobe.n);
                ASSERT_EQ(lobe.pdf(image), 0);
                ASSERT_EQ(lobe.value(image), 0);
            }
        }
    });
}

TEST_P(EveryModel, IsSoundAtTheEdgesOfTheSquare) {
    at_every_angle([](const Met& lobe) {
        for (const double u0 : {0.0, 0x1p-53, 0.5, 1 - 0x1p-53}) {
            for (const double u1 : {0.0, 0x1p-53, 0.25, 1 - 0x1p-53}) {
                const Vec3 wo = lobe.sample(u0, u1);
                EXPECT_NEAR(length(wo), 1, 1e-14);
                EXPECT_TRUE(std::isfinite(lobe.pdf(wo)));
                EXPECT_TRUE(std::isfinite(lobe.value(wo)));
                EXPECT_GE(lobe.pdf(wo), 0);
            }
        }
    });
}

TEST_P(EveryModel, LosesNoLight) {
    at_every_angle([](const Met& lobe) {
        if (lobe.bsdf.is_delta()) {
            const Vec3 only = specular_direction(lobe.bsdf.hemisphere(), lobe.n, lobe.wi);
            EXPECT_EQ(lobe.sample(0.3, 0.7), only);
            return;
        }
        const auto pdf = [&](const Vec3& wo) { return lobe.pdf(wo); };
        EXPECT_NEAR(integral(pdf, lobe.out_normal, {}, 1e-4), 1, 1e-4);
    });
}

TEST_P(EveryModel, SamplesFollowThePdf) {
    const double level =
        sidak_level(kLevel, static_cast<unsigned>(grid().size() * kAnglesDeg.size()));
    at_every_angle([level](const Met& lobe) {
        if (!lobe.bsdf.is_delta()) {
            const double tail = chi_square_test(
                [&](const Vec3& wo) { return lobe.pdf(wo); },
                [&](double u0, double u1) { return lobe.sample(u0, u1); }, lobe.out_normal, 20000);
            EXPECT_GT(tail, level);
        }
    });
}

TEST_P(EveryModel, BsdfIsThePdfDividedByTheCosine) {
    at_every_angle([](const Met& lobe) {
        Random random(3);
        for (int i = 0; i < 100; ++i) {
            const double u0 = random();
            const Vec3 wo = lobe.sample(u0, random());
            const double expected = lobe.pdf(wo) / std::abs(dot(wo, lobe.n));
            ASSERT_NEAR(lobe.value(wo), expected, 1e-12 * expected);
        }
    });
}

TEST_P(EveryModel, IsReciprocalWhereItSaysSoAndSymmetricOtherwise) {
    at_every_angle([](const Met& lobe) {
        Random random(4);
        double largest_difference = 0;
        for (int i = 0; i < 200 && !lobe.bsdf.is_delta(); ++i) {
            const double z = random();
            const Vec3 wo = direction_at(lobe.out_normal, z, random());
            const double forth = lobe.value(wo);
            const double back = lobe.reversed_value(wo);
            largest_difference =
                std::max(largest_difference, std::abs(forth - back) / (forth + back + 1e-300));
            if (!lobe.bsdf.is_reciprocal()) {
                const double p = lobe.pdf(wo);
                ASSERT_NEAR(p, lobe.reversed_pdf(wo), 1e-9 * p + 1e-290);
            }
        }
        if (lobe.bsdf.is_reciprocal()) {
            EXPECT_LT(largest_difference, 1e-12);
        } else {
            EXPECT_GT(largest_difference, 0.1) << "a model that could claim reciprocity";
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Grid, EveryModel, ::testing::ValuesIn(grid()), name_of);

TEST(Catalogue, ListsTheModelsInTheOrderOfTheManual) {
    std::string names;
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        names += std::string(entry.name) + " ";
        EXPECT_EQ(find_bsdf(entry.name), &entry);
        EXPECT_FALSE(entry.summary.empty());
    }
    EXPECT_EQ(names, "lambertian phong blinn_phong mirror ");
    EXPECT_EQ(find_bsdf("gloss"), nullptr);
}

}  // namespace
}  // namespace quasimc::test
