#include "samplers/catalogue.h"

#include <array>

#include "samplers/faure.h"
#include "samplers/halton.h"
#include "samplers/korobov.h"
#include "samplers/monte_carlo.h"
#include "samplers/sobol.h"

namespace quasimc {

// To add a sampler, tools/new.py sampler NAME makes name.cpp (a final class derived from Sampler),
// name_test.cpp and docs/theory/name.md, and enters the sampler here. Every test of
// tests/unit/samplers/every_sampler_test.cpp runs on the new row by itself.

// (tools/new.py declares a sampler above this line)

namespace {

constexpr std::array kCatalogue{
    SamplerEntry{
        "monte_carlo", "independent random numbers (Philox2x64-10)", make_monte_carlo, true},
    SamplerEntry{
        "korobov", "randomly shifted Korobov lattice; rounds of 2^m points", make_korobov, false,
        false},
    SamplerEntry{"sobol", "Sobol' sequence under Owen's scrambling", make_sobol},
    SamplerEntry{"halton", "Halton sequence under Owen's scrambling", make_halton},
    SamplerEntry{"faure", "Faure sequence in base 11 under Owen's scrambling", make_faure},
    // (tools/new.py enters a sampler above this line)
};

}  // namespace

std::span<const SamplerEntry> sampler_catalogue() {
    return kCatalogue;
}

std::unique_ptr<Sampler> make_sampler(std::string_view name) {
    for (const SamplerEntry& entry : kCatalogue) {
        if (entry.name == name) {
            return entry.make();
        }
    }
    return nullptr;
}

}  // namespace quasimc
