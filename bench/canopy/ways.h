#pragma once

#include <array>

#include "quasimc/tracing/run_spec.h"

namespace quasimc::bench {

/// A way of tracing with a point set.
struct Way {
    TraceFrom from;
    const char* sampler;
    const char* name;
};

/// The plainest first.
inline constexpr std::array kWays{
    Way{TraceFrom::sources, "monte_carlo", "sources monte_carlo"},
    Way{TraceFrom::sources, "korobov", "sources korobov"},
    Way{TraceFrom::sources, "sobol", "sources sobol"},
    Way{TraceFrom::organs, "sobol", "organs sobol"},
    Way{TraceFrom::lit_surfaces, "sobol", "lit sobol"},
    Way{TraceFrom::lit_surfaces, "korobov", "lit korobov"}};

}  // namespace quasimc::bench
