#include "io/results/json_stream.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace quasimc::test {
namespace {

/// {"a": [1, "b"], "c": {"d": true}, "e": []} with all containers in one layout.
std::string small_document(JsonLayout layout) {
    JsonStream json;
    json.begin_object(layout);
    json.key("a");
    json.begin_list(layout);
    json.count(1);
    json.text("b");
    json.end_list();
    json.key("c");
    json.begin_object(layout);
    json.key("d");
    json.boolean(true);
    json.end_object();
    json.key("e");
    json.begin_list(layout);
    json.end_list();
    json.end_object();
    return json.take();
}

TEST(JsonStream, WritesEveryLayout) {
    EXPECT_EQ(small_document(JsonLayout::compact), R"({"a":[1,"b"],"c":{"d":true},"e":[]})");
    EXPECT_EQ(small_document(JsonLayout::spaced), R"({"a": [1, "b"], "c": {"d": true}, "e": []})");
    EXPECT_EQ(
        small_document(JsonLayout::rows),
        "{\n\"a\": [\n1,\n\"b\"\n],\n\"c\": {\n\"d\": true\n},\n\"e\": [\n]\n}");
    EXPECT_EQ(
        small_document(JsonLayout::pretty),
        "{\n  \"a\": [\n    1,\n    \"b\"\n  ],\n  \"c\": {\n    \"d\": true\n  },\n  \"e\": "
        "[]\n}");
}

TEST(JsonStream, IndentsAsTheLibraryDoes) {
    const auto parsed = nlohmann::ordered_json::parse(small_document(JsonLayout::compact));
    EXPECT_EQ(small_document(JsonLayout::pretty), parsed.dump(2));
}

TEST(JsonStream, MixesLayouts) {
    JsonStream json;
    json.begin_object(JsonLayout::spaced);
    json.key("n");
    json.integer(-3);
    json.key("rows");
    json.begin_list(JsonLayout::rows);
    json.raw("{\"x\":1}");
    json.raw("[");
    json.raw_continued("]");
    json.end_list();
    json.end_object();
    EXPECT_EQ(json.take(), "{\"n\": -3, \"rows\": [\n{\"x\":1},\n[]\n]}");
    EXPECT_EQ(json.take(), "");
}

TEST(JsonStream, WritesNumbers) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    JsonStream json;
    json.begin_list(JsonLayout::compact);
    for (const double x : {1.0, 0.1, 1e-300, kInfinity}) {
        json.number(x);
        json.real(x);
    }
    json.null();
    json.end_list();
    EXPECT_EQ(json.take(), "[1,1.0,0.1,0.1,1e-300,1e-300,null,null,null]");
}

TEST(JsonStream, QuotesTexts) {
    EXPECT_EQ(JsonStream::quoted("a\"\\\n\x01"), R"("a\"\\\n\u0001")");
    EXPECT_EQ(JsonStream::quoted("\xff"), "\"\xEF\xBF\xBD\"") << "what is no UTF-8 is replaced";
}

TEST(JsonStream, GivesItsTextInPieces) {
    std::string text;
    std::size_t longest = 0;
    JsonStream json([&](std::string_view piece) {
        text += piece;
        longest = std::max(longest, piece.size());
    });
    json.begin_list(JsonLayout::rows);
    for (int i = 0; i < 100000; ++i) {
        json.raw("\"some text\"");
    }
    json.end_list();
    EXPECT_GT(text.size(), 1000000U) << "before the end";
    json.flush();
    EXPECT_LT(longest, 100000U);
    EXPECT_EQ(nlohmann::json::parse(text).size(), 100000U);
}

}  // namespace
}  // namespace quasimc::test
