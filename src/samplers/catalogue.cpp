#include "samplers/catalogue.h"

#include <array>

#include "samplers/faure.h"
#include "samplers/halton.h"
#include "samplers/korobov.h"
#include "samplers/monte_carlo.h"
#include "samplers/sobol.h"

namespace quasimc {
namespace {

// To add a sampler: write <name>.h with its manual page on top and a make_<name>(), <name>.cpp with
// a final class derived from Sampler, one row here, one name in CMakeLists.txt, and <name>_test.cpp
// for what is special to it. Every test of tests/unit/samplers/every_sampler_test.cpp runs on the
// new row by itself.
constexpr std::array kCatalogue{
    SamplerEntry{"monte_carlo", "independent random numbers (Philox2x64-10)", make_monte_carlo},
    SamplerEntry{"korobov", "randomly shifted Korobov lattice; rounds of 2^m points", make_korobov},
    SamplerEntry{"sobol", "Sobol' sequence under Owen's scrambling", make_sobol},
    SamplerEntry{"halton", "Halton sequence under Owen's scrambling", make_halton},
    SamplerEntry{"faure", "Faure sequence in base 11 under Owen's scrambling", make_faure},
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
