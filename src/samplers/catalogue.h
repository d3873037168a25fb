#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "samplers/sampler.h"

namespace quasimc {

/// One row of the table of samplers.
struct SamplerEntry {
    std::string_view name;     ///< in run files: `sampler = "..."`
    std::string_view summary;  ///< one line for the manual
    std::unique_ptr<Sampler> (*make)();
    /// Whether its points are independent; otherwise tests of every sampler expect them to be more
    /// uniform than random ones.
    bool is_random = false;
    /// Whether a set of more points begins with the same points.
    bool is_sequence = true;
};

/// All samplers, in the order of the manual.
[[nodiscard]] std::span<const SamplerEntry> sampler_catalogue();

/// The sampler of that name, or null if there is none.
[[nodiscard]] std::unique_ptr<Sampler> make_sampler(std::string_view name);

}  // namespace quasimc
