#include "results/where_expression.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

bool holds_for_leaf(const std::string& text) {
    const std::map<std::string, std::string, std::less<>> labels{
        {"kind", "leaf"}, {"plant", "12"}, {"height", "1.5"}, {"code", "012"}};
    return WhereExpression(text).holds([&](std::string_view name) -> std::optional<WhereValue> {
        const auto found = labels.find(name);
        return found == labels.end() ? std::nullopt
                                     : std::optional(WhereValue::of_text(found->second));
    });
}

TEST(Where, ComparesNumbersAsNumbersAndTextsAsTexts) {
    for (const std::string text :
         {"plant == 12", "plant == 12.0", "plant > 2", "plant == '12'", "kind == 'leaf'",
          "kind != \"stem\"", "height >= 1.5", "1 < height", "kind < 'stem'", "plant in [1, 12]",
          "kind in ['stem', 'leaf']", "plant > height", "code == 12", "code == '012'",
          "height > -1e3"}) {
        EXPECT_TRUE(holds_for_leaf(text)) << text;
    }
    for (const std::string text :
         {"plant == 13", "plant == '12.0'", "plant < 2", "kind == 12", "kind < 12", "kind > 12",
          "plant in [1, 2]", "code == '12'"}) {
        EXPECT_FALSE(holds_for_leaf(text)) << text;
    }
    EXPECT_TRUE(holds_for_leaf("kind != 12"));
}

TEST(Where, NotBindsBeforeAndBeforeOr) {
    EXPECT_TRUE(holds_for_leaf("kind == 'leaf' or plant == 1 and plant == 2"));
    EXPECT_FALSE(holds_for_leaf("(kind == 'leaf' or plant == 1) and plant == 2"));
    EXPECT_TRUE(holds_for_leaf("not plant == 1 and kind == 'leaf'"));
    EXPECT_FALSE(holds_for_leaf("not (plant == 1 or kind == 'leaf')"));
    EXPECT_TRUE(holds_for_leaf("not not plant==12"));
}

TEST(Where, AComparisonWithAMissingLabelIsFalse) {
    for (const std::string sign : {"==", "!=", "<", "<=", ">", ">="}) {
        EXPECT_FALSE(holds_for_leaf("species " + sign + " 'maize'")) << sign;
        EXPECT_FALSE(holds_for_leaf("plant " + sign + " species")) << sign;
    }
    EXPECT_FALSE(holds_for_leaf("species in ['maize']"));
    EXPECT_TRUE(holds_for_leaf("not species == 'maize'"));
}

std::string fault_of(const std::string& text) {
    try {
        const WhereExpression expression(text);
    } catch (const InputError& error) {
        return error.faults().front().text();
    }
    return "";
}

TEST(Where, SaysWhatIsWrong) {
    EXPECT_EQ(
        fault_of("kind = 'leaf'"),
        "where: \"kind = 'leaf'\": '=' sets nothing here; compare with '=='");
    const std::vector<std::pair<std::string, std::string>> table{
        {"", "a value is missing at its end"},
        {"kind", "a comparison is missing at its end"},
        {"kind ==", "a value is missing at its end"},
        {"kind == 'leaf", "'leaf has no second quote"},
        {"kind == 'leaf' plant == 1", "'plant == 1' does not belong here"},
        {"(kind == 'leaf'", "')' is missing at its end"},
        {"plant in 3", "'[' is missing before '3'"},
        {"plant in [1 2]", "']' is missing before '2]'"},
        {"plant == 1x", "'1x' is no number"},
        {"plant == inf", ""},
        {"plant == 1e999", "is no number"},
        {"sqrt(plant) > 1", "a comparison is missing before '(plant) > 1'"},
        {"kind == ;", "';' is no value"},
        {std::string(1000, '('), "nested too deeply"}};
    for (const auto& [text, problem] : table) {
        EXPECT_NE(fault_of(text).find(problem), std::string::npos)
            << text << ": " << fault_of(text);
    }
    EXPECT_EQ(fault_of("plant == inf"), "") << "inf is a name here";
}

TEST(Where, KnowsItsNames) {
    const WhereExpression where("specis == 'maize' and (plant > 1 or not plant in [kind, 2])");
    EXPECT_EQ(where.names(), (std::vector<std::string>{"specis", "plant", "kind"}));
    const std::vector<std::string_view> known{"species", "plant", "kind"};
    try {
        where.check_names(known, "label");
        FAIL();
    } catch (const InputError& error) {
        ASSERT_EQ(error.faults().size(), 1U);
        EXPECT_EQ(
            error.faults()[0].text(),
            "where: unknown label 'specis' in \"" + where.text() +
                "\" (labels are species, plant, kind); did you mean 'species'?");
    }
}

}  // namespace
}  // namespace quasimc::test
