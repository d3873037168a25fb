#include "scene/fold_warnings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

Texts folded(const std::vector<Warning>& warnings) {
    Texts texts;
    for (const Warning& warning : fold_warnings(warnings)) {
        texts.push_back(warning.where + ": " + warning.text);
    }
    return texts;
}

TEST(FoldWarnings, MakesOneOfManyThatDifferInNamesAndNumbers) {
    std::vector<Warning> warnings;
    for (int i = 0; i < 94; ++i) {
        warnings.push_back(
            {fmt::format("run.toml:{}", i),
             fmt::format(
                 "material 'it's {}' of plants/a{}.obj can't reflect {:.2f}", i, i, i / 7.)});
    }
    warnings.insert(warnings.begin() + 2, {"", "the scene is small"});
    EXPECT_EQ(
        folded(warnings),
        (Texts{
            "run.toml:0, run.toml:1, run.toml:2 and others: material 'it's 0' of plants/a0.obj "
            "can't reflect 0.00 (94 warnings of this kind)",
            ": the scene is small"}));
}

TEST(FoldWarnings, AddsUpWhatIsFoldedAlready) {
    const std::vector<Warning> warnings{
        {"a", "organ 'x' has no area (5 warnings of this kind)"},
        {"b", "organ 'y' has no area"},
        {"c", "organ 'z' has no area (12 warnings of this kind)"}};
    EXPECT_EQ(folded(warnings).size(), 3U);
    std::vector<Warning> more = warnings;
    more.push_back({"d", "organ 'w' has no area"});
    EXPECT_EQ(
        folded(more),
        (Texts{"a, b, c and others: organ 'x' has no area (19 warnings of this kind)"}));
    EXPECT_EQ(folded(fold_warnings(more)), folded(more));
}

TEST(FoldWarnings, LeavesAFewAndOtherKindsAsTheyAre) {
    std::vector<Warning> warnings{
        {"a", "organ 'x' has no area"},
        {"b", "material 'x' is black"},
        {"c", "organ 'y' has no area"},
        {"d", "organ 'z' has no area"}};
    EXPECT_EQ(
        folded(warnings), (Texts{
                              "a: organ 'x' has no area", "b: material 'x' is black",
                              "c: organ 'y' has no area", "d: organ 'z' has no area"}));
    warnings.push_back({"a", "organ 'w' has no area"});
    EXPECT_EQ(
        folded(warnings), (Texts{
                              "a, c, d: organ 'x' has no area (4 warnings of this kind)",
                              "b: material 'x' is black"}));
}

}  // namespace
}  // namespace quasimc::test
