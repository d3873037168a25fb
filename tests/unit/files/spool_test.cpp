#include "files/spool.h"

#include <string>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

std::string text_of(Spool& spool) {
    std::string text;
    spool.copy_to([&](std::string_view piece) { text += piece; });
    return text;
}

TEST(Spool, GivesBackWhatItGot) {
    Spool spool;
    std::string expected;
    for (int i = 0; i < 100000; ++i) {
        const std::string piece = std::to_string(i);
        spool.add(piece);
        expected += piece;
    }
    EXPECT_EQ(text_of(spool), expected);
}

TEST(Spool, MayBeEmpty) {
    Spool spool;
    EXPECT_EQ(text_of(spool), "");
}

}  // namespace
}  // namespace quasimc::test
