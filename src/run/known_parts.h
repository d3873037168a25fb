#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "quasimc/run.h"

namespace quasimc {

/// The parts of a run that were read without faults.
struct KnownParts {
    bool bands = true;
    bool scene = true;  ///< without its sensors
    bool sensors = true, sources = true;
    std::vector<std::string_view> unknown_options = {};  ///< keys

    /// Whether the groups of the run are known, if its scene is.
    [[nodiscard]] bool knows_groups() const {
        return scene && knows({"groups", "layers", "layer_heights"});
    }
    /// Whether all of these options are known.
    [[nodiscard]] bool knows(std::initializer_list<std::string_view> options) const {
        return std::ranges::none_of(options, [&](std::string_view key) {
            return std::ranges::find(unknown_options, key) != unknown_options.end();
        });
    }
};

/// check_run() of the known parts: checks that need another one are left out.
/// @param scene  with the bands of the run, even if its organs are unknown
/// @param sources  ignored if they are unknown
void check_known_parts(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const KnownParts& known,
    Faults& faults);

}  // namespace quasimc
