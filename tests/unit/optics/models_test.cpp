// Every model of the catalogue, reflected and transmitted, over exponents and angles of incidence.

#include <array>
#include <cmath>
#include <numbers>
#include <ostream>

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
    std::vector<double> values;  ///< of the parameters
};

/// Values from all of a parameter's domain, as far as its lobes are wide enough to integrate.
std::vector<double> trial_values(const BsdfParameter& p) {
    if (p.high <= 2) {
        return {p.low, 0.7 * p.low + 0.3 * p.high, p.high};
    }
    std::vector<double> values;
    for (const double value : {0.0, 1.0, 2.5, 10.0, 100.0, 1000.0}) {
        if (value >= p.low && value <= p.high) {
            values.push_back(value);
        }
    }
    return values;
}

/// All combinations of values.
std::vector<std::vector<double>> combinations(std::span<const BsdfParameter> parameters) {
    std::vector<std::vector<double>> all{{}};
    for (const BsdfParameter& p : parameters) {
        std::vector<std::vector<double>> longer;
        for (const std::vector<double>& start : all) {
            for (const double value : trial_values(p)) {
                longer.push_back(start);
                longer.back().push_back(value);
            }
        }
        all = std::move(longer);
    }
    return all;
}

std::vector<Cell> grid() {
    std::vector<Cell> cells;
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        for (const std::vector<double>& values : combinations(entry.parameters)) {
            cells.push_back({&entry, Hemisphere::reflected, values});
            cells.push_back({&entry, Hemisphere::transmitted, values});
        }
    }
    return cells;
}

std::string name_of(const ::testing::TestParamInfo<Cell>& info) {
    const Cell& c = info.param;
    std::string name(c.entry->name);
    name += c.hemisphere == Hemisphere::reflected ? "_reflected" : "_transmitted";
    for (std::size_t i = 0; i < c.values.size(); ++i) {
        name += "_" + std::string(c.entry->parameters[i].name) + "_" +
                std::to_string(static_cast<int>(10 * c.values[i])) + "_tenths";
    }
    return name;
}

void PrintTo(const Cell& cell, std::ostream* out) {
    *out << cell.entry->name << ::testing::PrintToString(cell.values);
}

/// A lobe met by light from each of the angles of incidence.
class EveryModel : public ::testing::TestWithParam<Cell> {
  protected:
    std::unique_ptr<Bsdf> bsdf_ = GetParam().entry->make(GetParam().hemisphere, GetParam().values);

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

TEST_P(EveryModel, BsdfIsTheRelativeAlbedoTimesThePdfDividedByTheCosine) {
    at_every_angle([](const Met& lobe) {
        Random random(3);
        const double albedo = lobe.bsdf.relative_albedo(std::abs(dot(lobe.wi, lobe.n)));
        ASSERT_GE(albedo, 0);
        ASSERT_LE(albedo, 1);
        ASSERT_TRUE(albedo == 1 || !lobe.bsdf.has_constant_albedo());
        for (int i = 0; i < 100; ++i) {
            const double u0 = random();
            const Vec3 wo = lobe.sample(u0, random());
            const double expected = albedo * lobe.pdf(wo) / std::abs(dot(wo, lobe.n));
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
            // Of light under a coat only the way in is weakened: that can't be symmetric. Nor is
            // what is cut off at the surface, by an amount that depends on the way in.
            const bool can_be_symmetric =
                lobe.bsdf.has_constant_albedo() && GetParam().entry->name != "clipped_blinn_phong";
            if (!lobe.bsdf.is_reciprocal() && can_be_symmetric) {
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

/// A catalogue of two models that share a name of a parameter.
std::unique_ptr<Bsdf> make_none(Hemisphere /*side*/, std::span<const double> /*values*/) {
    return nullptr;
}
constexpr std::array kCoat{
    BsdfParameter{"exponent", 1, 50, std::nullopt, "sharpness"},
    BsdfParameter{"index", 1, 3, 1.5, "of refraction"}};
constexpr std::array kHair{BsdfParameter{"exponent", 0, 20, 5, "sharpness"}};
constexpr std::array kTwoModels{
    BsdfEntry{"coat", "a coat", kCoat, make_none}, BsdfEntry{"hair", "hair", kHair, make_none}};

TEST(Catalogue, ParametersAreThoseStatedOrElseTheUsualOnes) {
    EXPECT_EQ(
        parameter_values(kTwoModels[0], {{"exponent", 7}, {"other", 1}}),
        (std::vector<double>{7, 1.5}));
    EXPECT_EQ(
        parameter_values(kTwoModels[0], {{"index", 2}, {"exponent", 3}}),
        (std::vector<double>{3, 2}));
    EXPECT_TRUE(std::isnan(parameter_values(kTwoModels[0], {})[0]));
    EXPECT_EQ(describe_parameters(kTwoModels[0]), "exponent 1 ... 50, index 1 ... 3 (else 1.5)");
}

TEST(Catalogue, AParameterOfSeveralModelsHasTheWidestDomain) {
    const auto all = parameters_of_all(kTwoModels);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "exponent");
    EXPECT_EQ(all[0].low, 0);
    EXPECT_EQ(all[0].high, 50);
    EXPECT_EQ(all[1].name, "index");
}

TEST(Catalogue, EveryParameterHasADomainWithItsUsualValueInIt) {
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        for (const BsdfParameter& p : entry.parameters) {
            EXPECT_LT(p.low, p.high) << entry.name;
            EXPECT_FALSE(p.summary.empty()) << entry.name;
            EXPECT_TRUE(!p.usual || (*p.usual >= p.low && *p.usual <= p.high)) << entry.name;
            EXPECT_EQ(entry.find_parameter(p.name), &p);
        }
        EXPECT_EQ(entry.find_parameter("none"), nullptr);
    }
}

TEST(Catalogue, ListsTheModelsInTheOrderOfTheManual) {
    std::string names;
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        names += std::string(entry.name) + " ";
        EXPECT_EQ(find_bsdf(entry.name), &entry);
        EXPECT_FALSE(entry.summary.empty());
    }
    EXPECT_EQ(names.rfind("lambertian phong blinn_phong mirror ", 0), 0U) << names;
    EXPECT_EQ(find_bsdf("gloss"), nullptr);
}

}  // namespace
}  // namespace quasimc::test
