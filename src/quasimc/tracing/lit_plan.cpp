#include "quasimc/tracing/lit_plan.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

/// One line costs about as much as this many paths, and goes with as many.
constexpr double kPathsPerLine = 96;
/// A beam has at least so many.
constexpr std::uint32_t kFewestLines = 16;

/// Pixels that go with a path.
constexpr double kPixelsPerPath = 20;
/// Pixels of a direction of a sky: of few triangles so many for each, which leaves more directions;
/// then enough to see leaves; of very many triangles again so many for each.
constexpr double kPixelsPerFew = 16, kPixelsPerMany = 2;
constexpr double kFewestPixels = 1024, kUsualPixels = 8192, kMostPixels = 2048 * 2048;
/// Directions of a sky: at least so many, in at most so many blocks of work.
constexpr std::uint32_t kFewestDirections = 16;
constexpr std::uint32_t kDirectionBlocks = 16;

}  // namespace

std::vector<LitPart> LitPlan::parts(const Round& round) const {
    std::vector<LitPart> parts;
    for (std::uint32_t i = 0; i < stage_.lights().size(); ++i) {
        const Light& light = stage_.lights()[i];
        if (light.source->is_sun()) {
            add_beams(i, light.probability * static_cast<double>(round.count), parts);
        }
    }
    if (!skies_.skies().empty()) {
        add_skies(skies_.probability() * static_cast<double>(round.count), parts);
    }
    std::uint64_t first = 0;
    for (LitPart& part : parts) {
        part.first_block = first;
        first += part.blocks;
    }
    return parts;
}

void LitPlan::add_beams(std::uint32_t light, double paths, std::vector<LitPart>& parts) const {
    const bool is_disk = !stage_.lights()[light].emitter->beam_direction();
    const std::uint32_t beams = is_disk ? kDiskBeams : 1;
    // A disk's beams need more lines than their share: errors fall with the third power.
    const double lines = paths / kPathsPerLine * (is_disk ? 2 : 1) / beams;
    const std::uint32_t count = std::max(kFewestLines, static_cast<std::uint32_t>(lines));
    const std::uint64_t blocks = (count + kLinesPerBlock - 1) / kLinesPerBlock;
    for (std::uint32_t beam = 0; beam < beams; ++beam) {
        parts.push_back({false, light, beam, beams, count, 0, blocks});
    }
}

void LitPlan::add_skies(double paths, std::vector<LitPart>& parts) const {
    const double directions = std::round(kPixelsPerPath * paths / pixels());
    const auto skies = static_cast<std::uint32_t>(skies_.skies().size());
    const std::uint32_t count =
        std::max({kFewestDirections, skies, static_cast<std::uint32_t>(directions)});
    parts.push_back({true, 0, 0, 1, count, 0, std::min(count, kDirectionBlocks)});
}

double LitPlan::pixels() const {
    const double triangles = stage_.caster().mesh().triangle_count();
    return std::clamp(
        std::max(std::min(kPixelsPerFew * triangles, kUsualPixels), kPixelsPerMany * triangles),
        kFewestPixels, kMostPixels);
}

}  // namespace quasimc
