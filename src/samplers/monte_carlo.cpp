#include "samplers/monte_carlo.h"

#include "samplers/hash.h"

namespace quasimc {
namespace {

/// Philox2x64-10 with the constants of Salmon et al. (2011), section 3.3: the key is a Weyl
/// sequence.
inline std::array<std::uint64_t, 2> encrypted(
    std::array<std::uint64_t, 2> counter, std::uint64_t key) {
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
        constexpr std::uint64_t kMultiplier = 0xd2b74407b1ce6e93U;
        counter = {
            multiply_high(kMultiplier, counter[0]) ^ key ^ counter[1], kMultiplier * counter[0]};
        key += 0x9e3779b97f4a7c15U;
    }
    return counter;
}

std::uint64_t cipher_key(const Stream& stream) {
    return mix64(fold(stream.seed ^ 0x510e527fade682d1U, stream.sequence ^ 0x9b05688c2b3e6c1fU));
}

std::uint64_t counter_word(const Stream& stream, std::uint32_t dimension) {
    return std::uint64_t{stream.replicate} << 32 | dimension;
}

class MonteCarlo final : public Sampler {
  public:
    double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        return random_number(stream, point, dimension);
    }
    void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const override {
        random_numbers(stream, point, dimension, out);
    }
};

}  // namespace

std::array<std::uint64_t, 2> philox2x64(std::array<std::uint64_t, 2> counter, std::uint64_t key) {
    return encrypted(counter, key);
}

double random_number(const Stream& stream, std::uint64_t point, std::uint32_t dimension) {
    const auto words = encrypted({point / 2, counter_word(stream, dimension)}, cipher_key(stream));
    return unit_number(words[point % 2]);
}

void random_numbers(
    const Stream& stream, std::uint64_t point, std::uint32_t dimension, std::span<double> out) {
    if (out.empty()) {
        return;
    }
    const std::uint64_t key = cipher_key(stream);
    const std::uint64_t word = counter_word(stream, dimension);
    std::size_t i = 0;
    if (point % 2 == 1) {
        out[i++] = unit_number(encrypted({point / 2, word}, key)[1]);
    }
    for (; i + 1 < out.size(); i += 2) {
        const auto words = encrypted({(point + i) / 2, word}, key);
        out[i] = unit_number(words[0]);
        out[i + 1] = unit_number(words[1]);
    }
    if (i < out.size()) {
        out[i] = unit_number(encrypted({(point + i) / 2, word}, key)[0]);
    }
}

std::unique_ptr<Sampler> make_monte_carlo() {
    return std::make_unique<MonteCarlo>();
}

}  // namespace quasimc
