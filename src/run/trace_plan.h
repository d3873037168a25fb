#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "quasimc/run_spec.h"

namespace quasimc {

/// Differences of a trace from the specification of its run or series.
struct TracePlan {
    std::optional<Method> method = {};
    std::optional<std::uint64_t> seed = {}, paths = {}, max_paths = {};
    std::optional<double> target_error = {};
    std::optional<std::string> sampler = {};
    std::optional<double> roulette_threshold = {};
    bool organs_alone = false;  ///< without ratios and groups
};

/// The specification of a trace.
[[nodiscard]] RunSpec planned_spec(const RunSpec& spec, const TracePlan& plan);

}  // namespace quasimc
