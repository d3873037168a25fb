#include "io/sha256_blocks.h"

#include <bit>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

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

using Schedule = std::array<std::uint32_t, kRounds>;

/// The words W of a block, section 6.2.2 step 1.
Schedule schedule_of(const char* bytes) {
    Schedule w{};
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

void take_block(Sha256State& state, const char* bytes) {
    const Schedule w = schedule_of(bytes);
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

#if defined(__x86_64__)

/// Intel Architecture Instruction Set Extensions, chapter 8: two registers hold A B E F and C D G
/// H, an instruction does two rounds, two more do the schedule of four words.
__attribute__((target("sha,sse4.1"))) void take_by_instructions(
    Sha256State& state, const char* bytes, std::size_t blocks) {
    const auto load = [](const void* from) __attribute__((target("sha,sse4.1"))) {
        return _mm_loadu_si128(static_cast<const __m128i*>(from));
    };
    const __m128i swap_bytes = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    const __m128i badc = _mm_shuffle_epi32(load(&state[0]), 0xB1);
    const __m128i hgfe = _mm_shuffle_epi32(load(&state[4]), 0x1B);
    __m128i abef = _mm_alignr_epi8(badc, hgfe, 8);
    __m128i cdgh = _mm_blend_epi16(hgfe, badc, 0xF0);
    for (; blocks > 0; --blocks, bytes += kSha256Block) {
        const __m128i abef_before = abef;
        const __m128i cdgh_before = cdgh;
        __m128i w[4];
        for (std::size_t i = 0; i < kRounds / 4; ++i) {
            __m128i& now = w[i % 4];
            if (i < 4) {
                now = _mm_shuffle_epi8(load(bytes + 16 * i), swap_bytes);
            } else {
                const __m128i last = w[(i + 3) % 4];
                const __m128i seven_before = _mm_alignr_epi8(last, w[(i + 2) % 4], 4);
                now = _mm_sha256msg1_epu32(now, w[(i + 1) % 4]);
                now = _mm_sha256msg2_epu32(_mm_add_epi32(now, seven_before), last);
            }
            const __m128i sum = _mm_add_epi32(now, load(&kConstants[4 * i]));
            cdgh = _mm_sha256rnds2_epu32(cdgh, abef, sum);
            abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(sum, 0x0E));
        }
        abef = _mm_add_epi32(abef, abef_before);
        cdgh = _mm_add_epi32(cdgh, cdgh_before);
    }
    const __m128i abef_turned = _mm_shuffle_epi32(abef, 0x1B);
    const __m128i ghcd = _mm_shuffle_epi32(cdgh, 0xB1);
    _mm_storeu_si128(
        reinterpret_cast<__m128i*>(&state[0]), _mm_blend_epi16(abef_turned, ghcd, 0xF0));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[4]), _mm_alignr_epi8(ghcd, abef_turned, 8));
}

/// Leaf 7 of cpuid, bit 29 of EBX: __builtin_cpu_supports does not know it in older compilers.
bool has_instructions() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    const bool has_sse = static_cast<int>(__builtin_cpu_supports("sse4.1")) != 0;
    return has_sse && __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b >> 29U & 1U) != 0;
}

#endif

}  // namespace

void sha256_take_plainly(Sha256State& state, std::string_view blocks) {
    for (std::size_t i = 0; i < blocks.size(); i += kSha256Block) {
        take_block(state, blocks.data() + i);
    }
}

void sha256_take(Sha256State& state, std::string_view blocks) {
#if defined(__x86_64__)
    static const bool kHasInstructions = has_instructions();
    if (kHasInstructions) {
        take_by_instructions(state, blocks.data(), blocks.size() / kSha256Block);
        return;
    }
#endif
    sha256_take_plainly(state, blocks);
}

}  // namespace quasimc
