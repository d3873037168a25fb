#include "io/results/json_scanner.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

std::string_view skipped(std::string_view text) {
    JsonScanner json(text, "result.json");
    const std::string_view value = json.skip();
    json.end();
    return value;
}

std::string fault_of(std::string_view text) {
    try {
        static_cast<void>(skipped(text));
    } catch (const InputError& error) {
        return error.faults().front().text();
    }
    return "";
}

TEST(JsonScanner, ReadsWhatIsAskedForAndPassesOverTheRest) {
    const std::string text =
        R"( {"a" : [1, -2.5e1, {"b": null}], "na\u006de\n": "t\"\u00e9xt", "c": {}} )";
    JsonScanner json(text, "result.json");
    std::vector<std::string> keys;
    std::vector<double> numbers;
    std::string word;
    json.object([&](std::string_view key) {
        keys.emplace_back(key);
        if (key == "a") {
            json.list([&](std::size_t index) {
                if (index < 2) {
                    numbers.push_back(json.number());
                } else {
                    EXPECT_EQ(json.kind(), JsonScanner::Kind::object);
                    EXPECT_EQ(json.skip(), R"({"b": null})");
                }
            });
        } else if (json.kind() == JsonScanner::Kind::string) {
            word = json.text();
        } else {
            EXPECT_EQ(text.substr(json.place(), 2), "{}");
            json.skip();
        }
    });
    json.end();
    EXPECT_EQ(keys, (std::vector<std::string>{"a", "name\n", "c"}));
    EXPECT_EQ(numbers, (std::vector<double>{1, -25}));
    EXPECT_EQ(word, "t\"\xC3\xA9xt");
}

TEST(JsonScanner, TellsWhereATextIsNoJson) {
    EXPECT_NE(fault_of("[1, 2").find("byte 6: not JSON"), std::string::npos) << fault_of("[1, 2");
    EXPECT_NE(fault_of("{\"a\" 1}").find("byte 6: not JSON"), std::string::npos);
    JsonScanner large("1e999", "result.json");
    EXPECT_THROW(static_cast<void>(large.number()), InputError);
    JsonScanner half(R"("\ud800")", "result.json");
    EXPECT_THROW(static_cast<void>(half.text()), InputError);
}

/// What it passes over is JSON exactly where another parser says so.
TEST(JsonScanner, AcceptsWhatIsJsonAndNothingElse) {
    const std::vector<std::string> texts{
        "0",
        "-0.5E+3",
        "01",
        "1.",
        ".5",
        "-",
        "+1",
        "1e",
        "nul",
        "null",
        "true",
        "falsey",
        "\"\"",
        "\"a",
        "\"\\u12\"",
        "\"\\x\"",
        "\"\n\"",
        "[]",
        "[,]",
        "[1,]",
        "[1 2]",
        "[[[]]]",
        "{}",
        "{,}",
        "{\"a\":1,}",
        "{\"a\":1,\"b\":[{}]}",
        "{a:1}",
        "{\"a\"}",
        "{1:2}",
        "[}",
        "{]",
        "[1]]",
        "",
        " ",
        " [ 1 , { } ] ",
        "[\"\\\\\"]",
        "[\"]\"]",
        "{\"}\":\"{\"}",
        "NaN"};
    int good = 0;
    for (const std::string& text : texts) {
        const bool is_json = nlohmann::json::accept(text);
        good += is_json ? 1 : 0;
        EXPECT_EQ(fault_of(text).empty(), is_json) << text;
    }
    EXPECT_EQ(good, 13);
}

TEST(JsonScanner, PassesOverAnyDepth) {
    const std::size_t depth = 1'000'000;
    const std::string text = std::string(depth, '[') + std::string(depth, ']');
    EXPECT_EQ(skipped(text).size(), 2 * depth);
}

}  // namespace
}  // namespace quasimc::test
