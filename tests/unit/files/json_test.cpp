#include "text/json.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace quasimc::test {
namespace {

TEST(Json, WritesNumbersAndReplacesWhatIsNoText) {
    EXPECT_EQ(
        json_text({{"a", 1.0}, {"b", 1e-300}, {"c", std::numeric_limits<double>::infinity()}}),
        R"({"a":1.0,"b":1e-300,"c":null})");
    EXPECT_EQ(json_text("a\"\\\n\x01"), R"("a\"\\\n\u0001")");
    EXPECT_EQ(json_text("\xff"), "\"\xEF\xBF\xBD\"");
}

TEST(Json, PutsTextsTogether) {
    EXPECT_EQ(json_text_with({{"a", 1}}, "b", "[2]"), R"({"a":1,"b":[2]})");
    EXPECT_EQ(json_text_with(Json::object(), "b", "[2]"), R"({"b":[2]})");
    std::string list;
    append_json(list, 1);
    append_json(list, "x");
    EXPECT_EQ(list, R"(1,"x")");
}

TEST(JsonLines, WritesAMemberALine) {
    std::string text;
    JsonLines json([&](std::string_view piece) { text += piece; });
    json.begin('{');
    json.members({{"a", 1}, {"b", {{"c", true}}}});
    json.begin('[', "rows");
    json.line("{\"x\":1}");
    json.line("2");
    json.end(']');
    json.begin('[', "none");
    json.end(']');
    json.end('}');
    json.flush();
    EXPECT_EQ(
        text,
        "{\n\"a\": 1,\n\"b\": {\n  \"c\": true\n},\n\"rows\": [\n{\"x\":1},\n2\n],\n\"none\": "
        "[\n]\n}");
}

TEST(JsonLines, GivesItsTextInPieces) {
    std::string text;
    std::size_t longest = 0;
    JsonLines json([&](std::string_view piece) {
        text += piece;
        longest = std::max(longest, piece.size());
    });
    json.begin('[');
    for (int i = 0; i < 100000; ++i) {
        json.line("\"some text\"");
    }
    json.end(']');
    EXPECT_GT(text.size(), 1000000U) << "before the end";
    json.flush();
    EXPECT_LT(longest, 100000U);
    EXPECT_EQ(nlohmann::json::parse(text).size(), 100000U);
}

}  // namespace
}  // namespace quasimc::test
