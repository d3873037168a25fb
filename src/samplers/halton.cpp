#include "samplers/halton.h"

#include <algorithm>
#include <array>
#include <vector>

#include "samplers/digit_scramble.h"
#include "samplers/hash.h"
#include "samplers/monte_carlo.h"

namespace quasimc {
namespace {

constexpr std::array<std::uint32_t, kHaltonDimensions> make_primes() {
    std::array<std::uint32_t, kHaltonDimensions> primes{};
    std::uint32_t candidate = 2;
    for (std::uint32_t& prime : primes) {
        while (std::any_of(primes.begin(), primes.end(), [=](std::uint32_t p) {
            return p != 0 && candidate % p == 0;
        })) {
            ++candidate;
        }
        prime = candidate;
    }
    return primes;
}

constexpr std::array<std::uint32_t, kHaltonDimensions> kPrimes = make_primes();

class Halton final : public Sampler {
  public:
    Halton() : scrambles_(kPrimes.begin(), kPrimes.end()) {}

    double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        if (dimension >= kHaltonDimensions) {
            return random_number(stream, point, dimension);
        }
        const DigitScramble& scramble = scrambles_[dimension];
        const std::uint64_t period = point / scramble.period();
        const auto key = scramble.key(stream_key(stream, period, dimension));
        return scramble.coordinate(
            static_cast<std::uint32_t>(point - period * scramble.period()), key);
    }

    void coordinates(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        std::span<double> out) const override {
        if (dimension >= kHaltonDimensions) {
            return random_numbers(stream, point, dimension, out);
        }
        const DigitScramble& scramble = scrambles_[dimension];
        while (!out.empty()) {
            const std::uint64_t period = point / scramble.period();
            const std::uint64_t first = point - period * scramble.period();
            const std::size_t count =
                std::min<std::uint64_t>(scramble.period() - first, out.size());
            const auto key = scramble.key(stream_key(stream, period, dimension));
            for (std::size_t i = 0; i < count; ++i) {
                out[i] = scramble.coordinate(static_cast<std::uint32_t>(first + i), key);
            }
            point += count;
            out = out.subspan(count);
        }
    }

  private:
    std::vector<DigitScramble> scrambles_;
};

}  // namespace

std::uint32_t halton_base(std::uint32_t dimension) {
    return kPrimes[dimension];
}

std::unique_ptr<Sampler> make_halton() {
    return std::make_unique<Halton>();
}

}  // namespace quasimc
