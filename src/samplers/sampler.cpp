#include "samplers/sampler.h"

namespace quasimc {

void Sampler::coordinates(
    const Stream& stream,
    std::uint64_t point,
    std::uint32_t dimension,
    std::span<double> out) const {
    for (double& x : out) {
        x = coordinate(stream, point++, dimension);
    }
}

}  // namespace quasimc
