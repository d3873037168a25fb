#include "view/exponential_fit.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

TEST(ExponentialFit, FindsTheCurveThatPointsLieOn) {
    for (const auto& [amount, rate] : {std::pair(0.8, 1.5), {3e-4, 0.004}, {2., -0.01}, {5., 0.}}) {
        std::vector<double> x, y;
        for (int i = 1; i <= 500; ++i) {
            const double place = rate > 1 ? i / 500.0 : i;
            x.push_back(place);
            y.push_back(amount * std::exp(-rate * place));
        }
        const auto curve = fit_exponential(x, y);
        ASSERT_TRUE(curve);
        EXPECT_NEAR(curve->amount, amount, 1e-7 * amount);
        EXPECT_NEAR(curve->rate, rate, 1e-7 * std::max(1e-3, std::abs(rate)));
    }
}

TEST(ExponentialFit, LeavesTheLeastSquares) {
    const std::vector<double> x{0, 1, 2, 3}, y{4.2, 1.9, 1.1, .4};
    const auto curve = fit_exponential(x, y);
    ASSERT_TRUE(curve);
    const auto deviations = [&](double amount, double rate) {
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            sum += std::pow(y[i] - amount * std::exp(-rate * x[i]), 2);
        }
        return sum;
    };
    const double least = deviations(curve->amount, curve->rate);
    for (const double by : {-1e-3, 1e-3}) {
        EXPECT_GT(deviations(curve->amount + by, curve->rate), least);
        EXPECT_GT(deviations(curve->amount, curve->rate + by), least);
    }
}

TEST(ExponentialFit, RefusesWhatHasNoCurve) {
    const std::vector<double> two{1, 2}, same{1, 1, 1};
    const std::vector<double> three{1, 2, 3};
    const std::vector<double> unknown{1, std::numeric_limits<double>::quiet_NaN(), 3};
    EXPECT_FALSE(fit_exponential(two, two));
    EXPECT_FALSE(fit_exponential(same, three));
    EXPECT_FALSE(fit_exponential(three, unknown));
    EXPECT_FALSE(fit_exponential({}, {}));
}

}  // namespace
}  // namespace quasimc::test
