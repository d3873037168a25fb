#include "base/lazy.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

/// The first to ask is slow, so that the others come while it makes the value.
TEST(Lazy, IsMadeOnceWhoeverAsks) {
    const Lazy<int> lazy;
    std::atomic<int> made = 0;
    std::atomic<int> right = 0;
    {
        std::vector<std::jthread> askers;
        for (int i = 0; i < 8; ++i) {
            askers.emplace_back([&] {
                const int& value = lazy.get([&] {
                    std::this_thread::sleep_for(std::chrono::milliseconds(20));
                    return 41 + ++made;
                });
                right += value == 42 ? 1 : 0;
            });
        }
    }
    EXPECT_EQ(made, 1);
    EXPECT_EQ(right, 8);
}

}  // namespace
}  // namespace quasimc::test
