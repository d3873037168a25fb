#include <gtest/gtest.h>

#include "quasimc/error.h"

namespace quasimc {
namespace {

TEST(Fault, ReadsLocationProblemWhyAndSuggestion) {
    const Fault fault{"a.toml:3", "rho is 2", "a fraction, 0 ... 1", "a percentage?"};
    EXPECT_EQ(fault.text(), "a.toml:3: rho is 2 (a fraction, 0 ... 1); a percentage?");
}

TEST(Fault, LeavesOutWhatIsNotSaid) {
    EXPECT_EQ((Fault{"a.toml:3", "rho is 2", "", ""}.text()), "a.toml:3: rho is 2");
    EXPECT_EQ((Fault{"", "rho is 2", "", ""}.text()), "rho is 2");
    EXPECT_EQ((Fault{"", "rho is 2", "too much", ""}.text()), "rho is 2 (too much)");
    EXPECT_EQ((Fault{"", "rho is 2", "", "write 0.02"}.text()), "rho is 2; write 0.02");
}

TEST(InputError, ReadsOneFaultALine) {
    const InputError error({{"a", "x", "", ""}, {"b", "y", "", ""}});
    EXPECT_STREQ(error.what(), "a: x\nb: y");
    EXPECT_EQ(error.faults().size(), 2U);
}

TEST(InputError, CountsFaultsBeyondTheFirstFifty) {
    const InputError fifty(std::vector<Fault>(50, {"a", "x", "", ""}));
    const InputError many(std::vector<Fault>(60, {"a", "x", "", ""}));
    EXPECT_EQ(many.what(), std::string(fifty.what()) + "\n... and 10 more");
    EXPECT_EQ(many.faults().size(), 60U);
}

TEST(Faults, ThrowNothingWhenThereIsNone) {
    const Faults faults;
    EXPECT_TRUE(faults.empty());
    EXPECT_NO_THROW(faults.throw_if_any());
}

TEST(Faults, AreToldInTheirOrder) {
    Faults faults, others;
    faults.add({"a", "x", "", ""});
    others.add({"b", "y", "", ""});
    faults.add(others);
    ASSERT_EQ(faults.all().size(), 2U);
    EXPECT_EQ(faults.all()[0].where, "a");
    EXPECT_EQ(faults.all()[1].where, "b");
    EXPECT_EQ(others.size(), 1U);
}

TEST(Faults, ThrowAllAtOnce) {
    Faults faults;
    faults.add({"a", "x", "", ""});
    faults.add(InputError({{"b", "y", "", ""}, {"c", "z", "", ""}}));
    EXPECT_EQ(faults.size(), 3U);
    try {
        faults.throw_if_any();
        FAIL() << "nothing was thrown";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "a: x\nb: y\nc: z");
    }
}

TEST(InputError, HoldsNothingThatATerminalRunsOrThatIsNotUtf8) {
    const InputError error({{"a\x1B", "name 'bl\xE4tt'", "", ""}});
    EXPECT_STREQ(error.what(), "a : name 'bl?tt'");
    EXPECT_EQ(error.faults()[0].problem, "name 'bl?tt'");
}

}  // namespace
}  // namespace quasimc
