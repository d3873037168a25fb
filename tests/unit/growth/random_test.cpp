#include "growth/language/random.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "growth/language/format_values.h"

namespace quasimc::test {
namespace {

/// As cpfg prints a parameter.
std::string printed(double value) {
    const double stored = static_cast<float>(value);
    return format_values("%g", {&stored, 1}).text;
}

TEST(PlantRandom, BeginsAsAfterSrandOfZero) {
    PlantRandom random;
    EXPECT_EQ(printed(random.ran(1)), "0.170828");
    EXPECT_EQ(printed(random.ran(1)), "0.749902");
    PlantRandom seeded;
    seeded.srand(0);
    EXPECT_EQ(printed(seeded.ran(1)), "0.170828");
}

/// Case 05 of the recorded runs of cpfg.
TEST(PlantRandom, HasTheNumbersOfCpfg) {
    PlantRandom random;
    random.srand(7);
    EXPECT_EQ(printed(random.ran(1)), "0.266444");
    EXPECT_EQ(printed(random.ran(1)), "0.682035");
    EXPECT_EQ(printed(random.ran(10)), "2.65491");
    EXPECT_EQ(printed(random.nran(0, 1)), "-0.0158962");
    EXPECT_EQ(printed(random.nran(0, 1)), "-1.09277");
    EXPECT_EQ(printed(random.nran(5, 2)), "3.33782");
    EXPECT_EQ(printed(random.bran(2, 3)), "0.553362");
    EXPECT_EQ(printed(random.biran(10, 0.3)), "4");
    EXPECT_EQ(printed(random.ran(1)), "0.485285");
}

/// Case 51.
TEST(PlantRandom, HasTheBetaNumbersOfCpfg) {
    struct Draw {
        double a, b;
        const char* first;
        const char* second;
    };
    const Draw draws[] = {
        {2, 3, "0.348257", "0.409246"},   {0.5, 0.5, "0.0502984", "0.737726"},
        {5, 1, "0.899636", "0.739919"},   {0.3, 2, "0.00979255", "0.0335626"},
        {1, 1, "0.202616", "0.727035"},   {10, 10, "0.788916", "0.606803"},
        {1.5, 4, "0.169311", "0.220814"},
    };
    PlantRandom random;
    random.srand(2026);
    for (const Draw& draw : draws) {
        EXPECT_EQ(printed(random.bran(draw.a, draw.b)), draw.first);
    }
    EXPECT_EQ(printed(random.ran(1)), "0.00682512");
    for (const Draw& draw : draws) {
        EXPECT_EQ(printed(random.bran(draw.a, draw.b)), draw.second);
    }
    EXPECT_EQ(printed(random.ran(1)), "0.996535");
}

TEST(PlantRandom, ReturnsTheMeanFirstWithoutADraw) {
    PlantRandom random;
    EXPECT_EQ(random.nran(3, 2), 3);
    EXPECT_EQ(random.generator.state(), 0x330EU);
    EXPECT_NE(random.nran(3, 2), 3);
}

TEST(PlantRandom, ForgetsTheSecondNormalNumberWhenSeeded) {
    PlantRandom random;
    random.srand(7);
    const double first = random.nran(0, 1);
    random.srand(7);
    EXPECT_EQ(random.nran(0, 1), first);
}

TEST(PlantRandom, TakesSeedsModuloTwoToThe32) {
    PlantRandom negative;
    negative.srand(-1.5);
    PlantRandom large;
    large.srand(4294967295.0);
    EXPECT_EQ(negative.generator.state(), large.generator.state());
    EXPECT_EQ(negative.generator.state(), 0xFFFFFFFF330EU);
    for (const double odd : {1e300, -1e300, std::numeric_limits<double>::infinity()}) {
        negative.srand(odd);
    }
}

TEST(PlantRandom, EndsForAllParameters) {
    PlantRandom random;
    const double values[] = {-1e300, -1, -0.5, 0, 1e-300, 1e-10, 1, 2, 1e10, 1e300, INFINITY, NAN};
    for (const double a : values) {
        for (const double b : values) {
            static_cast<void>(random.bran(a, b));
        }
        static_cast<void>(random.biran(3, a));
    }
    EXPECT_EQ(random.bran(0, 2), 0);
    EXPECT_EQ(random.biran(-3, 1), 0);
    EXPECT_EQ(random.biran(NAN, 1), 0);
    EXPECT_TRUE(std::isnan(random.biran(1e10, 1)));
}

TEST(StochasticRandom, IsDrand48WithTheStateZero) {
    StochasticRandom random;
    EXPECT_EQ(random.next(), 11.0 / 281474976710656.0);
    EXPECT_EQ(random.next(), (11.0 * 25214903917.0 + 11) / 281474976710656.0);
}

}  // namespace
}  // namespace quasimc::test
