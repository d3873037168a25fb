#include "options/options.h"

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// A value that an option takes and that is not its default.
OptionValue another_value(const Option& option) {
    const OptionValue usual = option.get(RunSpec{});
    if (const auto* range = std::get_if<IntegerDomain>(&option.domain)) {
        return std::get<std::int64_t>(usual) == range->low ? range->low + 1 : range->low;
    }
    if (const auto* range = std::get_if<RealDomain>(&option.domain)) {
        return std::get<double>(usual) == range->high ? range->low : range->high;
    }
    if (const auto* choice = std::get_if<ChoiceDomain>(&option.domain)) {
        const bool is_first = std::get<std::string>(usual) == choice->names.front();
        return std::string(is_first ? choice->names.back() : choice->names.front());
    }
    if (std::holds_alternative<RealsDomain>(option.domain)) {
        return std::vector<double>{0, .5, 2};
    }
    return std::vector<std::string>{"R:FR", "B:R"};
}

TEST(Options, EveryRowSetsWhatItGets) {
    for (const Option& option : option_table()) {
        RunSpec spec;
        const OptionValue value = another_value(option);
        ASSERT_FALSE(check_option(option, value)) << option.key;
        option.set(spec, value);
        EXPECT_EQ(option.get(spec), value) << option.key;
    }
}

TEST(Options, EveryRowSetsAFieldOfItsOwn) {
    for (const Option& option : option_table()) {
        RunSpec spec;
        option.set(spec, another_value(option));
        for (const Option& other : option_table()) {
            if (other.key != option.key) {
                EXPECT_EQ(other.get(spec), other.get(RunSpec{})) << option.key << " " << other.key;
            }
        }
    }
}

TEST(Options, EveryDefaultIsInItsDomain) {
    for (const Option& option : option_table()) {
        EXPECT_FALSE(check_option(option, option.get(RunSpec{}))) << option.key;
    }
}

TEST(Options, EveryRowReadsFromTextWhatItPrints) {
    for (const Option& option : option_table()) {
        const OptionValue value = another_value(option);
        std::string text = option_toml(value);
        std::erase_if(text, [](char c) { return c == '"' || c == '[' || c == ']'; });
        RunSpec spec;
        option.set(spec, parse_option(option, text));
        EXPECT_EQ(option.get(spec), value) << option.key;
    }
}

TEST(Options, RefuseValuesOutOfRangeAndSayTheRange) {
    const Option& option = *find_option("paths");
    const auto fault = check_option(option, std::int64_t{0});
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->text(), "0 is out of range (1 to 2^30)");
    EXPECT_TRUE(check_option(option, std::int64_t{-1}));
    EXPECT_TRUE(check_option(option, std::int64_t{1} << 40));
}

TEST(Options, RefuseWhatIsNotFinite) {
    const Option& option = *find_option("max_seconds");
    EXPECT_TRUE(check_option(option, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_TRUE(check_option(option, std::numeric_limits<double>::infinity()));
}

TEST(Options, RefuseValuesOfAnotherType) {
    EXPECT_TRUE(check_option(*find_option("paths"), 1024.0));
    EXPECT_TRUE(check_option(*find_option("paths"), std::string("many")));
    EXPECT_TRUE(check_option(*find_option("sampler"), std::int64_t{3}));
    EXPECT_TRUE(check_option(*find_option("ratios"), std::string("R:FR")));
    EXPECT_FALSE(check_option(*find_option("max_seconds"), std::int64_t{3}));
}

TEST(Options, SuggestTheNearestChoice) {
    const auto fault = check_option(*find_option("sampler"), std::string("sobel"));
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->suggestion, "did you mean 'sobol'?");
}

TEST(Options, MakeFlagsOfKeys) {
    EXPECT_EQ(option_flag(*find_option("max_depth")), "--max-depth");
    EXPECT_EQ(find_option("no_such_option"), nullptr);
}

TEST(Options, TheManualHoldsTheTable) {
    const std::string page = repository_file("docs/reference/options.md");
    EXPECT_NE(page.find(options_markdown()), std::string::npos)
        << "docs/reference/options.md should hold what `quasimc list options-markdown` prints:\n"
        << options_markdown();
}

TEST(Options, OfWholeNumbersMayBeWrittenAsReals) {
    const Option& paths = *find_option("paths");
    EXPECT_EQ(parse_option(paths, "1e5"), OptionValue(std::int64_t{100000}));
    EXPECT_EQ(parse_option(paths, "256.5"), OptionValue(256.5));
    EXPECT_TRUE(check_option(paths, parse_option(paths, "256.5")).has_value());
    EXPECT_TRUE(check_option(paths, parse_option(paths, "1e300")).has_value());
    RunText text;
    text.run = "[run]\npaths = 1e5\n";
    EXPECT_EQ(read_text(text.text()).spec.paths, 100000U);
    EXPECT_EQ(read_text(text.text(), {}, {{"paths", "1e6", "--paths"}}).spec.paths, 1000000U);
}

}  // namespace
}  // namespace quasimc::test
