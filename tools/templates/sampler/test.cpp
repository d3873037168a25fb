// What is special to @words@; every_sampler_test.cpp tries it like every sampler.

#include <gtest/gtest.h>

#include "samplers/catalogue.h"

namespace quasimc::test {
namespace {

TEST(@Name@, HasNumbersOfItsOwn) {
    const auto sampler = make_sampler("@name@");
    ASSERT_NE(sampler, nullptr);
    const Stream stream{.count = 16};
    for (std::uint64_t point = 0; point < 16; ++point) {
        EXPECT_NE(
            sampler->number(stream, point, 0),
            make_sampler("monte_carlo")->number(stream, point, 0));
    }
}

}  // namespace
}  // namespace quasimc::test
