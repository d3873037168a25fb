#include "coupling/vlab/comm_file.h"

#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

CommFile read(const std::string& text, RecordedNotices& kept) {
    return read_comm_text(text, "comm.e", kept.notices);
}

TEST(CommFile, TellsTransportAndChunks) {
    RecordedNotices kept;
    const CommFile file = read("communication type: sockets 50\n", kept);
    EXPECT_EQ(file.transport, Transport::sockets);
    EXPECT_EQ(file.chunk, 50U);
    EXPECT_EQ(read("", kept).transport, Transport::pipes);
    EXPECT_TRUE(kept.texts.empty());
}

TEST(CommFile, CountsTheNumbersOfATurtleLineAndWhatStandsBefore) {
    RecordedNotices kept;
    const CommFile file = read("turtle position:P:%.3f %.3f %.3f\nturtle line width: %f\n", kept);
    EXPECT_EQ(file.line(TurtleField::position).skip, 2U);
    EXPECT_EQ(file.line(TurtleField::position).values, 3U);
    EXPECT_EQ(file.line(TurtleField::line_width).values, 1U);
    EXPECT_FALSE(file.line(TurtleField::up).is_sent);
}

TEST(CommFile, TellsWhetherModulesAreInterpreted) {
    RecordedNotices kept;
    EXPECT_TRUE(read("interpreted modules: all\n", kept).interprets_modules);
    EXPECT_TRUE(read("when interpret: -1\n", kept).interprets_modules);
    EXPECT_FALSE(read("interpreted modules:\n", kept).interprets_modules);
    EXPECT_FALSE(read("", kept).interprets_modules);
    EXPECT_TRUE(kept.texts.empty());
}

TEST(CommFile, TakesYesAndOnForTheFollowingModule) {
    RecordedNotices kept;
    for (const char* value : {"yes", "on", "maybe"}) {
        EXPECT_TRUE(read(std::string("following module: ") + value, kept).following_module);
    }
    for (const char* value : {"no", "off"}) {
        EXPECT_FALSE(read(std::string("following module: ") + value, kept).following_module);
    }
    EXPECT_TRUE(read("", kept).following_module);
}

TEST(CommFile, SkipsWhatIsNotKnownWithANotice) {
    RecordedNotices kept;
    static_cast<void>(read("Turtle position: %f\nexecutable: a:b\n\nno colon\n", kept));
    EXPECT_TRUE(kept.has("comm.e:1"));
    EXPECT_TRUE(kept.has("did you mean 'turtle position'?"));
    EXPECT_TRUE(kept.has("comm.e:4"));
    EXPECT_EQ(kept.texts.size(), 2U);
}

TEST(CommFile, NamesAllItsFaultsAtOnce) {
    RecordedNotices kept;
    try {
        static_cast<void>(read("binary data: on\nbinary data: on\n", kept));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().size(), 2U);
    }
}

/// The simulator reads the same line, and the two must agree.
TEST(CommFile, TakesPipesForWhatTheSimulatorDoesNotKnow) {
    RecordedNotices kept;
    EXPECT_EQ(read("communication type: Pipes\n", kept).transport, Transport::pipes);
    EXPECT_TRUE(kept.texts.empty());
    EXPECT_EQ(read("communication type: Files 5\n", kept).transport, Transport::pipes);
    EXPECT_TRUE(kept.has("comm.e:1: 'Files' is not a communication type"));
    EXPECT_EQ(
        read("communication type: sockets\ncommunication type: File\n", kept).transport,
        Transport::sockets);
    EXPECT_FALSE(read("communication type: files 0\n", kept).chunk.has_value());
    EXPECT_TRUE(kept.has("the default is used"));
}

}  // namespace
}  // namespace quasimc::test
