#include "transport/absorbed_light.h"

namespace quasimc {

void score_absorbed(const PreparedScene& prepared, const Arrival& arrival, Tally& tally) {
    const LightBlocks& blocks = tally.blocks();
    if (!blocks.has_absorbed()) {
        return;
    }
    const Side& side = prepared.material(arrival.region).side(arrival.side);
    const std::size_t first = arrival.part == LightPart::scattered
                                  ? blocks.absorbed_scattered(arrival.region, arrival.origin)
                                  : blocks.absorbed_direct(arrival.region, arrival.origin);
    const bool is_beam = arrival.part == LightPart::beam && blocks.has_sun_shade();
    for (std::size_t b = 0; b < arrival.weights.size(); ++b) {
        const double absorptance = side.absorptance(b, arrival.cosine);
        const std::int64_t absorbed = to_fixed(arrival.factor * arrival.weights[b] * absorptance);
        tally.add(first + b, absorbed);
        if (is_beam) {
            tally.add(blocks.absorbed_beam(arrival.region) + b, absorbed);
        }
    }
}

}  // namespace quasimc
