#include "transport/absorbed_light.h"

namespace quasimc {

void score_absorbed(const PreparedScene& prepared, const Arrival& arrival, Tally& tally) {
    const LightBlocks& blocks = tally.blocks();
    if (!blocks.has_absorbed()) {
        return;
    }
    const Side& side = prepared.material(arrival.region).side(arrival.side);
    const std::size_t first = arrival.part == LightPart::direct
                                  ? blocks.absorbed_direct(arrival.region, arrival.origin)
                                  : blocks.absorbed_scattered(arrival.region, arrival.origin);
    for (std::size_t b = 0; b < arrival.weights.size(); ++b) {
        const double absorbed = side.absorptance(b, arrival.cosine);
        tally.add(first + b, to_fixed(arrival.factor * arrival.weights[b] * absorbed));
    }
}

}  // namespace quasimc
