#include "files/sha256.h"

#include <utility>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

// Messages and digests of NIST's examples to FIPS 180-4 (SHA256.pdf and SHA2_Additional.pdf).
constexpr const char* kTwoBlocks = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";

TEST(Sha256, HasTheDigestsOfTheStandard) {
    EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(
        sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(
        sha256_hex(kTwoBlocks), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(
        sha256_hex("\xbd"), "68325720aabd7c82f30f554b313d0570c95accbb7dc4b5aae11204c08ffe732b");
}

/// Of lengths about that of a block, where the padding changes, and of a million letters.
TEST(Sha256, HasTheDigestsOfTheStandardAtEveryPadding) {
    const std::pair<std::size_t, const char*> zeros[]{
        {55, "02779466cdec163811d078815c633f21901413081449002f24aa3e80f0b88ef7"},
        {56, "d4817aa5497628e7c77e6b606107042bbba3130888c5f47a375e6179be789fbb"},
        {57, "65a16cb7861335d5ace3c60718b5052e44660726da4cd13bb745381b235a1785"},
        {64, "f5a5fd42d16a20302798ef6ed309979b43003d2320d9f0e8ea9831a92759fb4b"},
        {1000, "541b3e9daa09b20bf85fa273e5cbd3e80185aa4ec298e765db87742b70138a53"}};
    for (const auto& [size, digest] : zeros) {
        EXPECT_EQ(sha256_hex(std::string(size, '\0')), digest) << size << " zero bytes";
    }
    EXPECT_EQ(
        sha256_hex(std::string(1000, 'A')),
        "c2e686823489ced2017f6059b8b239318b6364f6dcd835d0a519105a1eadd6e4");
    EXPECT_EQ(
        sha256_hex(std::string(1000000, 'a')),
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, TakesBytesInPiecesOfAnySize) {
    std::string bytes;
    for (int i = 0; i < 300; ++i) {
        bytes += static_cast<char>(i * 7);
    }
    for (std::size_t piece = 1; piece < 140; ++piece) {
        Sha256 digest;
        for (std::size_t i = 0; i < bytes.size(); i += piece) {
            digest.add(std::string_view(bytes).substr(i, piece));
            digest.add("");
        }
        EXPECT_EQ(digest.hex(), sha256_hex(bytes)) << "pieces of " << piece;
    }
}

TEST(Sha256, MayBeReadBeforeItsEnd) {
    Sha256 digest;
    digest.add("ab");
    EXPECT_EQ(digest.hex(), sha256_hex("ab"));
    digest.add("c");
    EXPECT_EQ(digest.hex(), sha256_hex("abc"));
}

}  // namespace
}  // namespace quasimc::test
