#include "support/vector_units.h"

#include <cstdint>

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace quasimc {

void for_each_vector_unit(const std::function<void()>& test) {
    const std::int64_t units = hwy::SupportedTargets() & HWY_TARGETS;
    const auto choose = [](std::int64_t unit) {
        hwy::SetSupportedTargetsForTest(unit);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    ASSERT_NE(units, 0);
    for (std::int64_t left = units; left != 0; left &= left - 1) {
        const std::int64_t unit = left & -left;
        SCOPED_TRACE(hwy::TargetName(unit));
        choose(unit);
        test();
    }
    choose(0);  // all again
}

}  // namespace quasimc
