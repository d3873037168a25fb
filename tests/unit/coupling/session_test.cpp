#include "coupling/protocol/session.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

Answers answers_for(const Pass& pass) {
    Answers answers;
    for (std::uint32_t i = 0; i < pass.queries.size(); ++i) {
        answers.values.push_back(0.5);
        answers.list.push_back({i, {i, 1}});
    }
    return answers;
}

Pass many(int count) {
    std::string queries;
    for (int i = 0; i < count; ++i) {
        queries += flat(i, "P(1,1)", 1);
    }
    return pass_of(queries);
}

TEST(Replies, OfAFewAnswersAreOneChunk) {
    const Pass pass = many(2);
    const auto chunks = reply_chunks(pass, answers_for(pass), 100, 1000);
    ASSERT_EQ(chunks.size(), 1U);
    EXPECT_EQ(chunks[0], "0 E(0.5)\n1 E(0.5)\nControl: 5\n");
    EXPECT_EQ(reply_chunks(pass, {}, 100, 1000).front(), "Control: 5\n");
}

RC_GTEST_PROP(Replies, AreWholeInWhateverChunks, ()) {
    const int count = *rc::gen::inRange(1, 60);
    const auto chunk = *rc::gen::inRange<std::size_t>(1, 30);
    const auto capacity = *rc::gen::inRange<std::size_t>(40, 400);
    const Pass pass = many(count);
    const auto chunks = reply_chunks(pass, answers_for(pass), chunk, capacity);
    std::string all;
    for (const std::string& text : chunks) {
        RC_ASSERT(text.size() <= capacity);
        const std::size_t control = text.find("Control");
        all += text.substr(0, control);
        const bool is_first = &text == &chunks.front(), is_last = &text == &chunks.back();
        const std::string flags = is_first && is_last ? "5" : is_first ? "1" : is_last ? "4" : "0";
        RC_ASSERT(text.substr(control) == "Control: " + flags + "\n");
    }
    std::string expected;
    for (int i = 0; i < count; ++i) {
        expected += std::to_string(i) + " E(0.5)\n";
    }
    RC_ASSERT(all == expected);
}

}  // namespace
}  // namespace quasimc::test
