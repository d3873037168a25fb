#include "sums/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/result.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

using Values = std::vector<double>;

TEST(EstimateMean, IsExactForOneToFour) {
    const Estimate e = estimate_mean(Values{1, 2, 3, 4});
    EXPECT_EQ(e.mean, 2.5);
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(5.0 / 12));
    const double half = 3.182446305284263 * std::sqrt(5.0 / 12);  // t, 3 degrees of freedom
    EXPECT_NEAR(e.ci95_low, 2.5 - half, 1e-12);
    EXPECT_NEAR(e.ci95_high, 2.5 + half, 1e-12);
}

TEST(EstimateSigned, IsThatOfTheDeviationsAndOneContribution) {
    const Values means{2.5, -1}, deviations{-1.5, 0, -.5, 0, .5, 0, 1.5, 0};
    const std::vector<ContributionSize> sizes{{0, 0}, {.3, .4}};
    const std::vector<Estimate> e = estimate_signed({means, deviations, sizes}, 1);
    const Estimate of_values = estimate_mean(Values{1, 2, 3, 4});
    EXPECT_DOUBLE_EQ(e[0].standard_error, of_values.standard_error);
    EXPECT_DOUBLE_EQ(e[0].ci95_low, of_values.ci95_low);
    EXPECT_DOUBLE_EQ(e[0].ci95_high, of_values.ci95_high);
    EXPECT_DOUBLE_EQ(e[1].mean, -1);
    EXPECT_DOUBLE_EQ(e[1].standard_error, .4);
    EXPECT_DOUBLE_EQ(e[1].ci95_low, -1 - 3 * .4);
    EXPECT_DOUBLE_EQ(e[1].ci95_high, -1 + 3 * .3);
}

TEST(EstimateSigned, HasTheSameBitsOnAnyNumberOfThreads) {
    std::mt19937 draw;
    std::normal_distribution<double> normal;
    constexpr std::size_t kCount = 1000;
    Values means(kCount), deviations(8 * kCount);
    std::ranges::generate(deviations, [&] { return normal(draw); });
    const std::vector<ContributionSize> sizes(kCount);
    const std::vector<Estimate> one = estimate_signed({means, deviations, sizes}, 1),
                                three = estimate_signed({means, deviations, sizes}, 3);
    for (std::size_t i = 0; i < kCount; ++i) {
        EXPECT_EQ(one[i].standard_error, three[i].standard_error);
    }
}

TEST(EstimateSigned, HasNoErrorToTellFromOneReplicate) {
    const Values mean{3}, deviation{0};
    const std::vector<ContributionSize> size{{.1, .1}};
    EXPECT_TRUE(std::isnan(estimate_signed({mean, deviation, size}, 1)[0].standard_error));
}

TEST(EstimateMean, HasNoErrorToTellFromOneReplicate) {
    const Estimate e = estimate_mean(Values{3});
    EXPECT_EQ(e.mean, 3);
    EXPECT_TRUE(std::isnan(e.standard_error));
    EXPECT_TRUE(std::isnan(e.ci95_low));
    EXPECT_TRUE(std::isnan(e.ci95_high));
}

TEST(EstimateMean, HasErrorZeroForEqualReplicates) {
    const Estimate e = estimate_mean(Values(8, 0.1));
    EXPECT_NEAR(e.mean, 0.1, 1e-16);
    EXPECT_NEAR(e.standard_error, 0, 1e-16);
}

TEST(EstimateMean, SeesSmallDifferencesOfLargeNumbers) {
    const Estimate e = estimate_mean(Values{1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 4});
    EXPECT_EQ(e.mean, 1e9 + 2.5);
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(5.0 / 12));
}

TEST(EstimateFinds, KeepsTheMeanAndAddsOneFindToTheVariance) {
    const Estimate e = estimate_contributions(Values{11, 12, 13, 14}, {.more = .25, .less = .5});
    EXPECT_EQ(e.mean, 12.5);
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(5.0 / 12 + .25));
    const double half = 3.182446305284263 * std::sqrt(5.0 / 12);  // t, 3 degrees of freedom
    EXPECT_NEAR(e.ci95_low, 12.5 - std::hypot(half, 1.5), 1e-12);
    EXPECT_NEAR(e.ci95_high, 12.5 + std::hypot(half, .75), 1e-12);
}

/// Of what can't be negative: the mean and its error as they are, of the interval what is not.
TEST(NotAbove, LeavesOutWhatCantBe) {
    const Estimate cut = not_above({4, 1, 2, 6}, 5);
    EXPECT_EQ(cut.mean, 4);
    EXPECT_EQ(cut.ci95_low, 2);
    EXPECT_EQ(cut.ci95_high, 5);
    const Estimate missed = not_above({8, 1, 6, 10}, 5);
    EXPECT_EQ(missed.mean, 8);
    EXPECT_EQ(missed.ci95_low, 3) << "as wide below the limit as it was below the mean";
    EXPECT_EQ(missed.ci95_high, 5);
    EXPECT_EQ(not_above({8, 5, 1, 15}, .5).ci95_low, 0);
    EXPECT_EQ(not_above({0, 1, 0, 3}, 0).ci95_high, 0);
}

TEST(NotAbove, LimitsTheMeanOfOneReplicateToo) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(reported(not_above({1336, kNan, kNan, kNan}, 1)).mean, 1);
    EXPECT_EQ(reported(not_above({.5, kNan, kNan, kNan}, 1)).mean, .5);
    EXPECT_TRUE(std::isnan(not_above({.5, kNan, kNan, kNan}, 1).ci95_high));
    EXPECT_EQ(reported(not_negative({-.105, kNan, kNan, kNan})).mean, 0);
}

TEST(Reported, HasItsMeanInItsInterval) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Estimate above = reported({1.23, .2, .67, 1});
    EXPECT_EQ(above.mean, 1);
    EXPECT_EQ(above.standard_error, .2);
    EXPECT_EQ(above.ci95_low, .67);
    EXPECT_EQ(above.ci95_high, 1);
    EXPECT_EQ(reported({-4, 1, 0, 2}).mean, 0);
    EXPECT_EQ(reported({.5, .1, .4, .6}).mean, .5);
    EXPECT_EQ(reported({3, nan, nan, nan}).mean, 3);
    EXPECT_TRUE(std::isnan(reported(kUnknownEstimate).mean));
    EXPECT_FALSE(std::signbit(reported({-0.0, 0, -0.0, 0}).mean));
}

TEST(NotNegative, LeavesOutWhatCantBe) {
    const Estimate e = not_negative({1, 2, -3, 5});
    EXPECT_EQ(e.mean, 1);
    EXPECT_EQ(e.standard_error, 2);
    EXPECT_EQ(e.ci95_low, 0);
    EXPECT_EQ(e.ci95_high, 5);
    EXPECT_EQ(not_negative({1, 2, .5, 5}).ci95_low, .5);
    const Estimate missed = not_negative({-4, 1, -6, -2});
    EXPECT_EQ(missed.mean, -4);
    EXPECT_EQ(missed.ci95_low, 0);
    EXPECT_EQ(missed.ci95_high, 2) << "as wide above 0 as it was above the mean";
    EXPECT_TRUE(std::isnan(not_negative(estimate_mean(Values{3})).ci95_low));
    EXPECT_EQ(estimate_contributions(Values{0, 0, 0, 8}, {.more = .1, .less = .1}).ci95_low, 0);
    EXPECT_EQ(estimate_seen_or_bound(Values{0, 0, 0, 8}, 1).ci95_low, 0);
    EXPECT_LT(estimate_mean(Values{0, 0, 0, 8}).ci95_low, 0) << "a control";
}

TEST(EstimateFinds, BoundsWhatWasNeverAndWhatWasAlwaysFound) {
    const Estimate none = estimate_contributions(Values(8, 0.0), {.more = .125, .less = 0});
    EXPECT_EQ(none.mean, 0);
    EXPECT_TRUE(std::isnan(none.standard_error));
    EXPECT_EQ(none.ci95_low, 0);
    EXPECT_EQ(none.ci95_high, .375);
    const Estimate all = estimate_contributions(Values(8, 1.0), {.more = 0, .less = .125});
    EXPECT_EQ(all.mean, 1);
    EXPECT_EQ(all.standard_error, .125);
    EXPECT_EQ(all.ci95_low, .625);
    EXPECT_EQ(all.ci95_high, 1);
}

/// Eight replicates of Poisson distributed numbers, few in all: Student's t alone holds the truth
/// in down to 86 %.
TEST(EstimateFinds, HoldsTheTruthOfFewFindsThatOften) {
    constexpr int kTrials = 20000;
    std::mt19937_64 random(1);
    double worst = 1;
    double worst_of_student = 1;
    for (const double expected : {.5, 1.0, 2.0, 2.9, 3.5, 4.5, 5.3, 7.0, 10.0, 20.0, 50.0}) {
        std::poisson_distribution<int> finds(expected / 8);
        int right = 0;
        int right_of_student = 0;
        for (int i = 0; i < kTrials; ++i) {
            Values values(8);
            for (double& x : values) {
                x = finds(random);
            }
            const double mean = expected / 8;
            const Estimate e = estimate_contributions(values, {.more = .125, .less = .125});
            const Estimate student = estimate_seen_or_bound(values, 1);
            right += e.ci95_low <= mean && mean <= e.ci95_high ? 1 : 0;
            right_of_student += student.ci95_low <= mean && mean <= student.ci95_high ? 1 : 0;
        }
        worst = std::min(worst, right / static_cast<double>(kTrials));
        worst_of_student =
            std::min(worst_of_student, right_of_student / static_cast<double>(kTrials));
    }
    EXPECT_GT(worst, .935);
    EXPECT_LT(worst_of_student, .9);
}

TEST(FTail, IsStudentsTOfEitherSignWithOneDegreeAbove) {
    for (const unsigned df : {1U, 2U, 7U, 30U, 1000U}) {
        for (const double p : {.75, .975, .9995, .9999995}) {
            const double t = student_t_quantile(p, df);
            EXPECT_NEAR(f_tail(t * t, 1, df) / (2 * (1 - p)), 1, 1e-13) << df << ' ' << p;
        }
    }
}

TEST(FTail, HasAClosedFormWithTwoDegreesAbove) {
    for (const double below : {1.0, 3.5, 40.0, 1e5}) {
        for (const double f : {.01, .9, 1.0, 4.0, 20.0}) {
            const double exact = std::exp(-below / 2 * std::log1p(2 * f / below));
            EXPECT_NEAR(f_tail(f, 2, below) / exact, 1, 1e-12) << below << ' ' << f;
        }
    }
}

TEST(FTail, OfTheInverseIsTheRest) {
    for (const double f : {.2, .8, 1.1, 3.0}) {
        EXPECT_NEAR(f_tail(f, 3.5, 60) + f_tail(1 / f, 60, 3.5), 1, 1e-12);
    }
    EXPECT_EQ(f_tail(0, 5, 5), 1);
    EXPECT_EQ(f_tail(INFINITY, 5, 5), 0);
}

TEST(FTail, BearsMillionsOfDegrees) {
    // Nearly normal, of variance 2/1e6 + 2/7e6.
    const double sd = std::sqrt(2e-6 + 2e-6 / 7);
    EXPECT_NEAR(f_tail(1 + 2 * sd, 1e6, 7e6), .02275, 2e-4);
    EXPECT_NEAR(f_tail(1 - 2 * sd, 1e6, 7e6), .97725, 2e-4);
}

TEST(StudentTQuantile, AgreesWithTheTables) {
    struct Row {
        double p;
        unsigned df;
        double t;
    };
    for (const Row& row : {
             Row{0.975, 1, 12.706204736174705},
             {0.975, 2, 4.3026527297494639},
             {0.975, 3, 3.1824463052837096},
             {0.975, 4, 2.7764451051977944},
             {0.975, 6, 2.4469118511449697},
             {0.975, 7, 2.3646242515927853},
             {0.975, 15, 2.1314495455597757},
             {0.975, 30, 2.0422724563012383},
             {0.975, 100, 1.9839715185235523},
             {0.975, 1001, 1.9623367052808799},
             {0.975, 9999, 1.9602012636213577},
             {0.95, 1, 6.3137515146750431},
             {0.995, 9, 3.2498355415921263},
             {0.75, 1, 1.0},
         }) {
        EXPECT_NEAR(student_t_quantile(row.p, row.df) / row.t, 1, 1e-14) << row.p << " " << row.df;
    }
}

TEST(StudentTQuantile, IsExactWhereThereIsAFormula) {
    for (const double p : {0.6, 0.9, 0.999, 0.9999995}) {
        const double cauchy = std::tan(std::acos(-1) * (p - 0.5));
        EXPECT_NEAR(student_t_quantile(p, 1) / cauchy, 1, 1e-9) << p;
        const double two = (2 * p - 1) / std::sqrt(2 * p * (1 - p));
        EXPECT_NEAR(student_t_quantile(p, 2) / two, 1, 1e-9) << p;
    }
}

TEST(StudentTQuantile, IsOdd) {
    EXPECT_NEAR(student_t_quantile(0.5, 5), 0, 1e-15);
    EXPECT_DOUBLE_EQ(student_t_quantile(0.025, 7), -student_t_quantile(0.975, 7));
}

TEST(StudentTQuantile, GoesOnSmoothlyToManyDegreesOfFreedom) {
    const double below = student_t_quantile(0.975, 1000);
    const double above = student_t_quantile(0.975, 1001);
    EXPECT_NEAR(below, 1.9623390808264083, 1e-14);
    EXPECT_LT(above, below);
    EXPECT_NEAR(above, below, 3e-6);
    EXPECT_NEAR(student_t_quantile(0.975, 1000000000), 1.959963984540054, 1e-8);
    EXPECT_NEAR(student_t_quantile(1 - 5e-7, 100000000), 4.891638475698802, 1e-6);
}

/// How many of `tries` 95 % intervals from samples of `draw` hold `expected`.
template <class Draw>
int count_covered(int tries, double expected, Draw draw) {
    int covered = 0;
    for (int i = 0; i < tries; ++i) {
        const Estimate e = draw();
        covered += e.ci95_low <= expected && expected <= e.ci95_high ? 1 : 0;
    }
    return covered;
}

TEST(EstimateMean, HoldsTheTrueMeanInNineteenOfTwentyIntervals) {
    const int tries = 40000;
    for (const std::size_t replicates : {2, 4, 8, 32}) {
        std::mt19937_64 bits(replicates);
        std::normal_distribution<double> noise(-3, 10);
        const int covered = count_covered(tries, -3, [&] {
            Values values(replicates);
            for (double& value : values) {
                value = noise(bits);
            }
            return estimate_mean(values);
        });
        EXPECT_TRUE(agrees(measured_fraction(covered, tries, 0.95), 0.95, 0.01)) << replicates;
    }
}

TEST(EstimateMean, WouldMissTheLevelWithNormalIntervals) {
    // The negative control: 1.96 standard errors are too few for four replicates.
    const int tries = 40000;
    std::mt19937_64 bits(4);
    std::normal_distribution<double> noise(-3, 10);
    const int covered = count_covered(tries, -3, [&] {
        Estimate e = estimate_mean(Values{noise(bits), noise(bits), noise(bits), noise(bits)});
        e.ci95_low = e.mean - 1.96 * e.standard_error;
        e.ci95_high = e.mean + 1.96 * e.standard_error;
        return e;
    });
    EXPECT_FALSE(agrees(measured_fraction(covered, tries, 0.95), 0.95, 0.01));
}

TEST(EstimateRatio, IsExactForFourPairs) {
    const Estimate e = estimate_ratio(Values{1, 2, 3, 4}, Values{2, 3, 5, 6});
    EXPECT_DOUBLE_EQ(e.mean, 10.0 / 16);
    // Residuals a - b 5/8: -1/4, 1/8, -1/8, 1/4; squares 5/32; / 3 / 4 / mean of b squared.
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(5.0 / 32 / 3 / 4) / 4);
}

TEST(EstimateRatio, HasErrorZeroWhereBothRiseTogether) {
    const Estimate e = estimate_ratio(Values{1, 2, 3, 4}, Values{2, 4, 6, 8});
    EXPECT_EQ(e.mean, 0.5);
    EXPECT_EQ(e.standard_error, 0);
}

TEST(EstimateRatio, IsNotANumberOverZero) {
    const Estimate e = estimate_ratio(Values{1, 2}, Values{0, 0});
    EXPECT_TRUE(std::isnan(e.mean));
    EXPECT_TRUE(std::isnan(e.standard_error));
    const Estimate opposed = estimate_ratio(Values{1, 2}, Values{-1, 1});
    EXPECT_TRUE(std::isnan(opposed.mean));
}

TEST(EstimateRatio, HasNoErrorToTellFromOneReplicate) {
    const Estimate e = estimate_ratio(Values{1}, Values{2});
    EXPECT_EQ(e.mean, 0.5);
    EXPECT_TRUE(std::isnan(e.standard_error));
}

TEST(EstimateRatio, HasAPositiveErrorOverANegativeDenominator) {
    const Estimate e = estimate_ratio(Values{1, 2, 3}, Values{-2, -3, -5});
    EXPECT_LT(e.mean, 0);
    EXPECT_GT(e.standard_error, 0);
    EXPECT_LT(e.ci95_low, e.ci95_high);
}

/// Ratios of correlated noise, 3 : 2, each from 16 replicates.
std::vector<Estimate> simulated_ratios(int tries) {
    std::mt19937_64 bits(16);
    std::normal_distribution<double> noise(0, 0.05);
    std::vector<Estimate> ratios;
    for (int i = 0; i < tries; ++i) {
        std::array<double, 16> a{};
        std::array<double, 16> b{};
        for (std::size_t k = 0; k < a.size(); ++k) {
            const double common = noise(bits);
            a[k] = 3 + 3 * common + noise(bits);
            b[k] = 2 + 2 * common + noise(bits);
        }
        ratios.push_back(estimate_ratio(a, b));
    }
    return ratios;
}

TEST(EstimateRatio, StatesTheErrorThatReplicatesShow) {
    const int tries = 20000;
    const std::vector<Estimate> ratios = simulated_ratios(tries);
    double sum = 0;
    double squares = 0;
    double given = 0;
    for (const Estimate& e : ratios) {
        sum += e.mean - 1.5;
        squares += (e.mean - 1.5) * (e.mean - 1.5);
        given += e.standard_error * e.standard_error;
    }
    EXPECT_NEAR(sum / tries, 0, 1e-3);
    // Of a variance from n normal numbers the relative error is sqrt(2 / n).
    const double relative = std::sqrt(2.0 / tries);
    EXPECT_TRUE(agrees(Measured{squares / given, relative, static_cast<unsigned>(tries)}, 1, 0.06));
}

TEST(EstimateRatio, HoldsTheTrueRatioInNineteenOfTwentyIntervals) {
    const int tries = 20000;
    int covered = 0;
    for (const Estimate& e : simulated_ratios(tries)) {
        covered += e.ci95_low <= 1.5 && 1.5 <= e.ci95_high ? 1 : 0;
    }
    EXPECT_TRUE(agrees(measured_fraction(covered, tries, 0.95), 0.95, 0.01));
}

TEST(EstimateUnseen, IsZeroWithTheLimitOfTheRuleOfThree) {
    const Estimate e = estimate_unseen(1000, 2);
    EXPECT_EQ(e.mean, 0);
    EXPECT_TRUE(std::isnan(e.standard_error));
    EXPECT_EQ(e.ci95_low, 0);
    EXPECT_DOUBLE_EQ(e.ci95_high, 3 * 2.0 / 1000);
}

TEST(EstimateUnseen, LimitsWhatIsMissedInNineteenOfTwentyRuns) {
    // If the chance of an event were at the limit, one run in twenty would see none.
    const double events = 500;
    const double chance = estimate_unseen(events, 1).ci95_high;
    EXPECT_NEAR(std::pow(1 - chance, events), 0.05, 1e-3);
}

}  // namespace
}  // namespace quasimc::test
