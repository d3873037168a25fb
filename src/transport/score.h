#pragma once

// Score of light that arrives at a surface, for all methods.

#include <cstdint>
#include <span>

#include "sums/tally.h"
#include "transport/absorbed_light.h"
#include "transport/surface.h"

namespace quasimc {

/// Adds light that falls on a surface straight from its source, `amount` times its start weights.
inline void score_direct(
    const PreparedScene& prepared,
    const Surface& at,
    const BoundSource& light,
    double amount,
    Tally& tally) {
    const LightBlocks& blocks = tally.blocks();
    tally.add(blocks.direct(at.region, at.side, light.spectrum), to_fixed(amount));
    score_absorbed(
        prepared,
        {at.region, at.side, at.cosine, direct_part(light), light.origin, amount,
         light.start_weights},
        tally);
}

/// Adds scattered light of an origin on a surface, per band `factor` times weights[b].
inline void score_scattered(
    const PreparedScene& prepared,
    const Surface& at,
    std::size_t origin,
    double factor,
    std::span<const double> weights,
    Tally& tally) {
    const LightBlocks& blocks = tally.blocks();
    const std::size_t bins = blocks.scattered(at.region, at.side, origin);
    for (std::size_t b = 0; b < weights.size(); ++b) {
        tally.add(bins + b, to_fixed(weights[b] * factor));
    }
    score_absorbed(
        prepared, {at.region, at.side, at.cosine, LightPart::scattered, origin, factor, weights},
        tally);
}

}  // namespace quasimc
