#include "coupling/protocol/messages.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "coupling/protocol/trailing_values.h"
#include "coupling_testing.h"

namespace quasimc::test {
namespace {

std::string fault_of(const std::string& message) {
    try {
        static_cast<void>(pass_of(message));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

const std::string kTurtle = " 1 2 3\n 0 6.12e-17 -1\n -1 0 -0\n 0 1 0\n";

TEST(Messages, GiveQueriesWithModuleAndTurtle) {
    const Pass pass = pass_of("24 E(1)P(0.5,2e-1)\n" + kTurtle + "41 E(-1)Triangle(1)\n" + kTurtle);
    ASSERT_EQ(pass.queries.size(), 2U);
    const Query& query = pass.queries.front();
    EXPECT_EQ(query.id, 24);
    EXPECT_TRUE(query.asks);
    EXPECT_EQ(query.slots, 1U);
    EXPECT_EQ(query.organ, "P");
    EXPECT_EQ(pass.parameters_of(query)[1], 0.2);
    EXPECT_EQ(query.turtle.position, (Vec3{1, 2, 3}));
    EXPECT_EQ(query.turtle.heading, (Vec3{0, 6.12e-17, -1}));
    EXPECT_FALSE(pass.queries[1].asks);
    EXPECT_EQ(pass.queries[1].organ, "Triangle");
}

TEST(Messages, MayLeaveSlotsUnsetAndModulesOut) {
    const Pass pass = pass_of(
        "0 E(,1)P(,2)\n" + kTurtle + "1 E\n" + kTurtle + "2 E(nan)]\n" + kTurtle + "3 E(1)\n" +
        kTurtle);
    EXPECT_TRUE(pass.queries[0].asks);
    EXPECT_EQ(pass.queries[0].slots, 2U);
    EXPECT_TRUE(std::isnan(pass.parameters_of(pass.queries[0])[0]));
    EXPECT_FALSE(pass.queries[1].asks);  // there is no slot for an answer
    EXPECT_FALSE(pass.queries[2].asks);
    EXPECT_EQ(pass.queries[2].organ, "]");
    EXPECT_EQ(pass.queries[3].organ, "");
}

/// Every way of writing that scanf takes, and what does not belong to the number.
TEST(Messages, TakeNumbersAsScanfDoes) {
    const Pass pass = pass_of(
        "0 E(+1)P(1.,.5,0x1p-3,inf)\n1 2 3\n\t0\t1.\v+0 and so on\n -0x1P0 -.0 0X0\n+1e0 1E-400 "
        "-1e400\n");
    const Query& query = pass.queries.front();
    const auto parameters = pass.parameters_of(query);
    EXPECT_TRUE(query.asks);
    EXPECT_EQ(parameters[0], 1);
    EXPECT_EQ(parameters[1], 0.5);
    EXPECT_EQ(parameters[2], 0.125);
    EXPECT_EQ(parameters[3], HUGE_VAL);
    EXPECT_EQ(query.turtle.position, (Vec3{1, 2, 3}));  // without the blank of the format
    EXPECT_EQ(query.turtle.heading, (Vec3{0, 1, 0}));
    EXPECT_EQ(query.turtle.left, (Vec3{-1, 0, 0}));
    EXPECT_EQ(query.turtle.up, (Vec3{1, 0, -HUGE_VAL}));
}

TEST(Messages, TellTheSmallFromTheLargeBeyondTheRange) {
    const std::string zeros(400, '0');
    const Pass pass =
        pass_of("0 E(1)P(0." + zeros + "1,1" + zeros + ",-1" + zeros + ".5)\n" + kTurtle);
    const auto parameters = pass.parameters_of(pass.queries.front());
    EXPECT_EQ(parameters[0], 0);
    EXPECT_EQ(parameters[1], HUGE_VAL);
    EXPECT_EQ(parameters[2], -HUGE_VAL);
}

TEST(Messages, DoNotTakeSignsAloneForNumbers) {
    for (const char* word : {"+", "--1", "+-1", "-+1", "0x", "0x-1", ".", "e5"}) {
        EXPECT_NE(fault_of(std::string("0 E(1)P(") + word + ")\n" + kTurtle), "") << word;
    }
}

/// The text before the numbers may have the blanks of the format or not.
TEST(Messages, HaveTheTextBeforeTheNumbersSkipped) {
    RecordedNotices kept;
    for (const char* format : {" P: %f %f %f", "P:%f %f %f"}) {
        for (const char* line : {" P: 10 2 3", "P:10 2 3", "P: 10 2 3"}) {
            MessageParser parser(read_comm_text(
                std::string("turtle position:") + format + "\n", "comm.e", kept.notices));
            Pass pass;
            static_cast<void>(
                parser.parse("0 E(1)P(1)\n" + std::string(line) + "\nControl: 5 0\n", pass));
            EXPECT_EQ(pass.queries[0].turtle.position, (Vec3{10, 2, 3})) << format << line;
        }
    }
}

TEST(Messages, CarryPolygons) {
    const Pass pass = pass_of(
        "0 E(1)M(1)\n" + kTurtle +
        "Dbegin\nmaterial\n 0.1 0.2 0.3 0\n0 0 0 0\n 1 1 1 1  1\npolygon\n 0 0 0\n 1 0 0\n 0 0 1\n"
        "polygon\n 5 5 5\n 6 5 5\n 5 5 6\n 5 5 6\nsphere 3\nDend\n1 E(1)P(1,1)\n" +
        kTurtle);
    ASSERT_EQ(pass.queries.size(), 2U);
    ASSERT_EQ(pass.queries[0].polygons.count, 2U);
    EXPECT_EQ(pass.polygons[0].count, 3U);
    EXPECT_EQ(pass.polygons[1].count, 4U);
    EXPECT_EQ(pass.vertices[3], (Vec3{5, 5, 5}));
    EXPECT_EQ(pass.queries[1].polygons.count, 0U);
    EXPECT_EQ(pass.other_graphics, std::vector<std::string>{"sphere"});
}

TEST(Messages, TellChunksAndExit) {
    MessageParser parser(usual_format());
    Pass pass;
    EXPECT_FALSE(parser.parse("Control: 1 0\n", pass).is_last);
    EXPECT_FALSE(parser.parse("Control: 0 0\n", pass).is_last);
    const Control last = parser.parse("Control: 4 12\n", pass);
    EXPECT_TRUE(last.is_last);
    EXPECT_EQ(last.step, 12);
    EXPECT_TRUE(parser.parse("Control: 8 0\n", pass).is_exit);
    EXPECT_TRUE(parser.parse("Control: 9 0\nControl: 5 0\n", pass).is_exit);
}

TEST(Messages, AreRefusedWithTheirLine) {
    EXPECT_NE(fault_of("x E(1)\n" + kTurtle).find("line 1"), std::string::npos);
    EXPECT_NE(fault_of("0 E(1)P(1\n" + kTurtle).find("not closed"), std::string::npos);
    EXPECT_NE(fault_of("0 E(1)P(a)\n" + kTurtle).find("'a'"), std::string::npos);
    EXPECT_NE(fault_of("0 E(1)P(1,1)\n 1 2 3\n 1 2\n").find("line 3"), std::string::npos);
    EXPECT_NE(
        fault_of("0 E(1)P(1,1)\n 1 2 3\n 1 2\n").find("3 numbers of the turtle are expected"),
        std::string::npos);
    EXPECT_NE(
        fault_of("0 E(1)P(1,1)\n" + kTurtle + "Dbegin\npolygon\n").find("Dend"), std::string::npos);
}

TEST(Messages, HaveThePositionOfLpfgThatTheFileDoesNotMention) {
    RecordedNotices kept;
    MessageParser parser(
        read_comm_text("turtle heading: %f %f %f\nturtle up: %f %f %f\n", "comm.e", kept.notices));
    Pass pass;
    static_cast<void>(parser.parse(
        "0 E(1.000000)P(1.000000)\n 7 8 9\n 0 1 0\n 0 0 1\n1 E(1.000000)\n 1 1 1\n 0 1 0\n 0 0 1\n"
        "Control: 5 0\n",
        pass));
    EXPECT_EQ(pass.queries[0].turtle.position, (Vec3{7, 8, 9}));
    EXPECT_EQ(pass.queries[1].turtle.up, (Vec3{0, 0, 1}));
}

TEST(NumberStyles, AreToldApart) {
    for (const char* fixed : {"1.000000", "-0.000000", "0.523290", "12.345678"}) {
        EXPECT_EQ(style_of(fixed), NumberStyle::fixed) << fixed;
    }
    for (const char* general : {"1", "0.2", "1e-05", "6.12323e-17", "0.52809", "1.23457"}) {
        EXPECT_EQ(style_of(general), NumberStyle::general) << general;
    }
    for (const char* either : {"0.123456", "-0.123456", "nan", "-inf", ""}) {
        EXPECT_EQ(style_of(either), NumberStyle::unknown) << either;
    }
}

RC_GTEST_PROP(NumberStyles, NeverTakeOneSimulatorForTheOther, ()) {
    const auto value = *rc::gen::arbitrary<float>();
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), "%g", static_cast<double>(value));
    RC_ASSERT(style_of(text.data()) != NumberStyle::fixed);
    std::snprintf(text.data(), text.size(), "%f", static_cast<double>(value));
    RC_ASSERT(style_of(text.data()) != NumberStyle::general);
}

TEST(TrailingValues, OfLpfgAreRemoved) {
    Pass pass = pass_of(
        "0 E(1.000000)P(0.500000,2.000000,0.000000,nan)\n" + kTurtle +
        "1 E(1.000000)EB(-0.000000)\n" + kTurtle);
    TrailingValues().remove(pass, NumberStyle::fixed);
    EXPECT_EQ(pass.queries[0].parameters.count, 2U);
    EXPECT_EQ(pass.queries[1].parameters.count, 0U);
}

TEST(TrailingValues, AreNotExpectedFromCpfgNorFromAMendedLpfg) {
    Pass pass = pass_of("0 E(1)P(0.5,2,1,1)\n" + kTurtle);
    TrailingValues trailing;
    trailing.remove(pass, NumberStyle::general);
    EXPECT_EQ(pass.queries[0].parameters.count, 4U);
    Pass mended = pass_of(
        "0 E(1.000000)P(0.500000,2.000000)\n" + kTurtle + "1 E(1.000000)P(0.5,2.0,1.0)\n" +
        kTurtle);
    trailing.remove(mended, NumberStyle::fixed);
    EXPECT_EQ(mended.queries[0].parameters.count, 2U);
    EXPECT_EQ(mended.queries[1].parameters.count, 3U);
    trailing.remove(pass, NumberStyle::fixed);  // it stays mended
    EXPECT_EQ(pass.queries[0].parameters.count, 4U);
}

TEST(Answers, HaveEmptySlotsForWhatIsNotThere) {
    std::string text;
    const std::array<double, 3> values{0.62, 1e-7, std::nan("")};
    append_answer(text, 7, 5, values);
    EXPECT_EQ(text, "7 E(0.62,1e-07,,,)\n");
}

TEST(Answers, StayWithinALineOfTheSimulators) {
    std::string text;
    const std::vector<double> values(20, -1.23456e-300);
    append_answer(text, 123456789, 20, values);
    EXPECT_LE(text.size(), 255U);
    EXPECT_EQ(std::count(text.begin(), text.end(), ','), 19);
}

RC_GTEST_PROP(Answers, AreNumbersAsPrintfWritesThem, ()) {
    const auto value = *rc::gen::arbitrary<double>();
    std::string text;
    append_answer(text, 0, 1, std::array{value});
    std::array<char, 40> expected{};
    std::snprintf(expected.data(), expected.size(), "0 E(%g)\n", value);
    RC_ASSERT(text == expected.data());
}

/// Pieces of every size; each byte is read once, except those that may begin the line.
RC_GTEST_PROP(MessageEnd, IsFoundInPieces, ()) {
    const std::string line(*rc::gen::inRange<std::size_t>(0, 2000), 'x');
    const std::string start = *rc::gen::element<std::string>("", "Contro\n", line + "\n");
    const std::string bytes = start + "Control: 5 " + line + "\n";
    const auto piece = *rc::gen::inRange<std::size_t>(1, 300);
    MessageEndFinder finder;
    for (std::size_t size = 0; size < bytes.size(); size += piece) {
        RC_ASSERT(finder.find(std::string_view(bytes).substr(0, size)) == std::string::npos);
        RC_ASSERT(finder.offset() + 8 > size);
    }
    RC_ASSERT(finder.find(bytes + "0 E(1)\n") == bytes.size());
}

TEST(MessageEnd, StandsAfterTheControlLine) {
    EXPECT_EQ(message_end("0 E(1)\nControl: 5\nrest"), 18U);
    EXPECT_EQ(message_end("Control: 5\n"), 11U);
    EXPECT_EQ(message_end("0 E(1)\nControl: 5"), std::string::npos);
    EXPECT_EQ(message_end("a Control: 5\n"), std::string::npos);
}

}  // namespace
}  // namespace quasimc::test
