#include "weather/civil_time_text.h"

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::optional<CivilTime> parse(std::string_view text, std::optional<double> offset = {}) {
    Faults faults;
    const auto time = parse_civil_time(text, offset, "t", faults);
    EXPECT_NE(time.has_value(), !faults.empty()) << text;
    return time;
}

std::string fault(std::string_view text, std::optional<double> offset = {}) {
    Faults faults;
    static_cast<void>(parse_civil_time(text, offset, "t", faults));
    try {
        faults.throw_if_any();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CivilTimeText, IsReadInTheFormsOfIso8601) {
    const CivilTime noon{2024, 6, 21, 12, 0, 0, 2};
    EXPECT_EQ(parse("2024-06-21T12:00+02:00"), noon);
    EXPECT_EQ(parse(" 2024-06-21 12:00:00+0200 "), noon);
    EXPECT_EQ(parse("2024-06-21T12:00+02"), noon);
    EXPECT_EQ(parse("2024-06-21T12:00", 2), noon);
    EXPECT_EQ(parse("2024-06-21T12:00Z")->utc_offset_hours, 0);
    EXPECT_EQ(parse("2024-06-21T12:00-03:30")->utc_offset_hours, -3.5);
    EXPECT_EQ(parse("2024-06-21T12:00-0330")->utc_offset_hours, -3.5);
    EXPECT_EQ(parse("2024-06-21T12:00:07.25Z")->second, 7.25);
    EXPECT_EQ(parse("2024-06-21", 1)->hour, 0);
}

TEST(CivilTimeText, KnowsLeapDaysLeapSecondsAndTheEndOfADay) {
    EXPECT_EQ(parse("2024-02-29T00:00Z")->day, 29);
    EXPECT_NE(fault("2023-02-29T00:00Z"), "");
    EXPECT_NE(fault("1900-02-29T00:00Z"), "");
    EXPECT_EQ(parse("2016-12-31T23:59:60Z")->second, 60);
    EXPECT_NE(fault("2016-12-30T23:59:60Z"), "");
    const CivilTime next = *parse("2024-12-31T24:00+01:00");
    EXPECT_EQ(next.year, 2025);
    EXPECT_EQ(next.day, 1);
    EXPECT_EQ(next.hour, 0);
}

TEST(CivilTimeText, RefusesWhatIsNoTime) {
    for (const std::string_view text :
         {"", "noon", "-0044-03-15T12:00Z", "2024", "2024-06", "21-06", "2024/06/21T12:00Z",
          "2024-06-21T12", "2024-06-21T12:00 CET", "2024-06-21T25:00Z", "2024-06-21T12:60Z",
          "2024-13-01T12:00Z", "2024-06-31T12:00Z", "2024-06-21T12:00+15:00",
          "2024-06-21T12:00+02:75", "2024-06-21T12:00Zulu", "99999999999999999999-01-01T00:00Z",
          "2024-06-21T12:00:1e9Z"}) {
        EXPECT_NE(fault(text), "") << text;
    }
    EXPECT_TRUE(mentions({fault("2024-06-21T12:00")}, "has no time zone"));
}

TEST(CivilTimeText, ReadsBackWhatItWrites) {
    for (const std::string_view text :
         {"2024-06-21T12:00+02:00", "2024-06-21T00:00:30-03:30", "1900-01-01T23:59+00:00",
          "2016-12-31T23:59:60+00:00"}) {
        EXPECT_EQ(civil_time_text(*parse(text)), text);
    }
    // Half a tenth of a millisecond off, as computed times are.
    EXPECT_EQ(civil_time_text({2024, 6, 21, 11, 59, 59.99995, 1}), "2024-06-21T12:00+01:00");
    EXPECT_EQ(date_text({2024, 6, 1}), "2024-06-01");
}

}  // namespace
}  // namespace quasimc::test
