// A growth in this process, on several threads, for ThreadSanitizer.

#include <algorithm>

#include <gtest/gtest.h>

#include "coupling/plant_light.h"
#include "growth.h"

namespace quasimc::test {
namespace {

Pass pass_of(const std::string& message) {
    Notices silent([](const std::string&) {});
    MessageParser parser(read_comm_text(
        "turtle position: %f %f %f\nturtle heading: %f %f %f\nturtle left: %f %f %f\n"
        "turtle up: %f %f %f\n",
        "comm.e", silent));
    Pass pass;
    static_cast<void>(parser.parse(message, pass));
    return pass;
}

Specification specification(unsigned threads) {
    Specification spec;
    spec.lights.push_back({{0, -1, 0}, 1});
    spec.run.paths = 16384;  // of which about 50 meet the first leaves
    spec.run.threads = threads;
    spec.run.replicates = 2;
    return spec;
}

TEST(ThreadsOfAGrowth, GiveEveryLeafItsLight) {
    Notices silent([](const std::string&) {});
    PlantLight light(specification(4), silent);
    constexpr int kSteps = 50, kMaxLeaves = 10000;
    for (int step = 1; step <= kSteps; ++step) {
        const Pass pass = pass_of(growing_leaves(kMaxLeaves * step / kSteps, step));
        Answers answers;
        light.answer(
            pass, [] {}, answers);
        ASSERT_EQ(answers.list.size(), pass.queries.size());
        const auto is_lit = [](double x) { return x > 0; };
        ASSERT_TRUE(std::any_of(answers.values.begin(), answers.values.end(), is_lit)) << step;
    }
}

TEST(ThreadsOfAGrowth, DoNotChangeItsLight) {
    Notices silent([](const std::string&) {});
    PlantLight one(specification(1), silent), four(specification(4), silent);
    for (int step = 0; step < 3; ++step) {
        const Pass pass = pass_of(growing_leaves(1000 + 500 * step, step));
        Answers by_one, by_four;
        one.answer(
            pass, [] {}, by_one);
        four.answer(
            pass, [] {}, by_four);
        EXPECT_EQ(by_one.values, by_four.values);
    }
}

}  // namespace
}  // namespace quasimc::test
