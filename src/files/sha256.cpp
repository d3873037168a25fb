#include "files/sha256.h"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

namespace quasimc {
namespace {

constexpr std::size_t kRounds = 64;

/// The constants K of FIPS 180-4, section 4.2.2.
constexpr std::array<std::uint32_t, kRounds> kConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/// The words W of a block, section 6.2.2 step 1.
std::array<std::uint32_t, kRounds> schedule_of(const char* bytes) {
    std::array<std::uint32_t, kRounds> w{};
    for (std::size_t t = 0; t < 16; ++t) {
        for (std::size_t i = 0; i < 4; ++i) {
            w[t] = w[t] << 8 | static_cast<unsigned char>(bytes[4 * t + i]);
        }
    }
    for (std::size_t t = 16; t < kRounds; ++t) {
        const std::uint32_t x = w[t - 15];
        const std::uint32_t y = w[t - 2];
        w[t] = w[t - 16] + (std::rotr(x, 7) ^ std::rotr(x, 18) ^ x >> 3) + w[t - 7] +
               (std::rotr(y, 17) ^ std::rotr(y, 19) ^ y >> 10);
    }
    return w;
}

/// Updates the hash value H with a block, section 6.2.2 steps 2 to 4.
void take_block(std::array<std::uint32_t, 8>& state, const char* bytes) {
    const auto w = schedule_of(bytes);
    auto [a, b, c, d, e, f, g, h] = state;
    for (std::size_t t = 0; t < kRounds; ++t) {
        const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                 ((e & f) ^ (~e & g)) + kConstants[t] + w[t];
        const std::uint32_t t2 =
            (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + t1;
        d = c;
        c = b;
        b = a;
        a = t1 + t2;
    }
    const std::array words{a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < words.size(); ++i) {
        state[i] += words[i];
    }
}

}  // namespace

void Sha256::add(std::string_view bytes) {
    while (!bytes.empty()) {
        const std::size_t filled = size_ % kBlock;
        const std::size_t taken = std::min(kBlock - filled, bytes.size());
        std::copy_n(bytes.data(), taken, pending_.data() + filled);
        size_ += taken;
        bytes.remove_prefix(taken);
        if (filled + taken == kBlock) {
            take_block(state_, pending_.data());
        }
    }
}

std::string Sha256::hex() const {
    constexpr std::size_t kLengthBytes = 8;
    Sha256 padded = *this;
    const std::size_t filled = size_ % kBlock;
    const std::size_t zeros =
        (filled < kBlock - kLengthBytes ? kBlock : 2 * kBlock) - kLengthBytes - filled - 1;
    std::string end = "\x80" + std::string(zeros, '\0');
    for (int shift = 56; shift >= 0; shift -= 8) {
        end += static_cast<char>(8 * size_ >> shift & 0xFF);
    }
    padded.add(end);
    std::string text;
    for (const std::uint32_t word : padded.state_) {
        text += fmt::format("{:08x}", word);
    }
    return text;
}

std::string sha256_hex(std::string_view bytes) {
    Sha256 digest;
    digest.add(bytes);
    return digest.hex();
}

}  // namespace quasimc
