#include "coupling/vlab/arguments.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

Arguments parse(const std::vector<const char*>& words) {
    return parse_arguments(words);
}

TEST(Arguments, AreReadInAnyOrder) {
    // Groups of words: cpfg and lpfg put them in different orders.
    std::vector<std::vector<const char*>> groups{
        {"-e", "comm.e"}, {"-k", "61616"}, {"-ext", "15404.0"}, {"light.qmc"}, {"-no_xserver"}};
    std::sort(groups.begin(), groups.end());
    do {
        std::vector<const char*> words;
        for (const auto& group : groups) {
            words.insert(words.end(), group.begin(), group.end());
        }
        const Arguments a = parse(words);
        EXPECT_EQ(a.comm_file, "comm.e");
        EXPECT_EQ(a.key, 61616);
        EXPECT_EQ(a.extension, "15404.0");
        EXPECT_EQ(a.specification, "light.qmc");
    } while (std::next_permutation(groups.begin(), groups.end()));
}

TEST(Arguments, TakeEveryWordWithHForTheHost) {
    EXPECT_EQ(parse({"-k", "9", "-hostname", "there", "s"}).host, "there");
    EXPECT_EQ(parse({"-h", "there", "s"}).host, "there");
}

TEST(Arguments, MayAskForThePage) {
    EXPECT_TRUE(parse({"-e", "comm.e", "--view", "light.qmc"}).view);
    EXPECT_FALSE(parse({"light.qmc"}).view);
}

TEST(Arguments, ThatCantBeUnderstoodAreRefused) {
    const std::vector<std::vector<const char*>> all{
        {"-k"}, {"-k", "many"}, {"one", "two"}, {"-x", "spec"}, {"-C", "-m"}, {"--spec", "qq"}};
    for (const auto& words : all) {
        EXPECT_THROW(parse(words), UsageError) << words.front();
    }
}

TEST(Arguments, NameTheKindOfTheSpecification) {
    EXPECT_EQ(parse({"--spec", "montecarlo", "s"}).kind, SpecificationKind::montecarlo);
    EXPECT_EQ(parse({"s"}).kind, SpecificationKind::automatic);
}

TEST(Arguments, FollowTheNameOfTheProgram) {
    EXPECT_EQ(kind_of_program("MonteCarlo"), SpecificationKind::montecarlo);
    EXPECT_EQ(kind_of_program("/usr/bin/MonteCarlo"), SpecificationKind::montecarlo);
    EXPECT_EQ(kind_of_program("/opt/MonteCarlo/QuasiMC"), SpecificationKind::automatic);
    const std::vector<const char*> words{"s"}, given{"--spec", "quasimc", "s"};
    EXPECT_EQ(
        parse_arguments(words, SpecificationKind::montecarlo).kind, SpecificationKind::montecarlo);
    EXPECT_EQ(
        parse_arguments(given, SpecificationKind::montecarlo).kind, SpecificationKind::quasimc);
}

}  // namespace
}  // namespace quasimc::test
