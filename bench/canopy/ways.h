#pragma once

#include <array>

#include "quasimc/run_spec.h"

namespace quasimc::bench {

/// A method with a sampler.
struct Way {
    Method from;
    const char* sampler;
    const char* name;
};

/// The reference first.
inline constexpr std::array kWays{
    Way{Method::light_tracing, "monte_carlo", "sources monte_carlo"},
    Way{Method::light_tracing, "korobov", "sources korobov"},
    Way{Method::light_tracing, "sobol", "sources sobol"},
    Way{Method::from_organs, "sobol", "organs sobol"},
    Way{Method::first_hits, "sobol", "lit sobol"},
    Way{Method::first_hits, "korobov", "lit korobov"}};

}  // namespace quasimc::bench
