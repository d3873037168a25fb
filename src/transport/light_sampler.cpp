#include "transport/light_sampler.h"

#include <algorithm>
#include <cmath>

namespace quasimc {

LightSampler::LightSampler(const PreparedScene& prepared, std::uint64_t points)
    : prepared_(prepared) {
    constexpr std::uint64_t kFinest = 1024, kEach = 8;
    const auto& lights = prepared.lights();
    const std::uint64_t steps = std::min(points, kFinest);
    if (lights.size() < 2 || lights.size() * kEach > steps) {
        return;
    }
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const double by_flux = lights[i].before + lights[i].probability;
        const auto nearest =
            static_cast<std::uint64_t>(std::llround(by_flux * static_cast<double>(steps)));
        const std::uint64_t after = lights.size() - 1 - i;
        end = after == 0 ? steps : std::clamp(nearest, end + 1, steps - after);
        ends_.push_back(static_cast<double>(end) / static_cast<double>(steps));
    }
}

}  // namespace quasimc
