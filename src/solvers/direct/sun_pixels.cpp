#include "solvers/direct/sun_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/checks.h"
#include "light/models/source.h"
#include "solvers/direct/direct_beams.h"
#include "transport/sky_directions.h"

namespace quasimc {
namespace {

/// Dimensions of a beam's point: rotation and shift of the pixels, and the direction on the sun's
/// disk.
constexpr std::uint32_t kPixelDimension = 0, kDiskDimension = 3;
/// The minimum number of pixels of a beam.
constexpr double kMinOfBeam = 256;

}  // namespace

SunPixels::SunPixels(const SolverInput& input, double pixels)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      spec_(input.spec),
      stop_(input.stop),
      projection_input_(input.prepared, &stop_),
      pixels_(pixels) {
    projection_input_.store_blocks();
}

SunLight SunPixels::find(std::uint32_t replicate, ItemScratch& scratch) const {
    const std::size_t regions = prepared_.scene().regions().size();
    const std::size_t bands = prepared_.bands();
    SunLight found{
        std::vector<double>(2 * regions * bands), std::vector<double>(regions),
        std::vector<double>(bands), std::vector<double>(bands)};
    std::uint64_t beams = 0;
    for (const BoundSource& light : prepared_.lights()) {
        EXPECT(light.source->is_sun());
        beams += beams_of(light);
    }
    const Stream stream{spec_.seed, 0, replicate, 0, std::bit_ceil(beams)};
    std::uint64_t point = 0;
    for (const BoundSource& light : prepared_.lights()) {
        const std::uint32_t count = beams_of(light);
        const std::uint64_t first = point;
        for (; point < first + count; ++point) {
            View view = view_of(light, {stream, first, point});
            const ItemBuffer image = draw(
                projection_input_.projected(),
                {.direction = view.direction,
                 .rotation = sampler_.coordinate(stream, point, kPixelDimension),
                 .shift_s = sampler_.coordinate(stream, point, kPixelDimension + 1),
                 .shift_t = sampler_.coordinate(stream, point, kPixelDimension + 2),
                 .pixels = std::max(kMinOfBeam, pixels_ / count)},
                scratch);
            view.of_pixel *= image.pixel_area();
            score(view, image, found);
        }
    }
    normalize(found);
    return found;
}

/// All beams of a disk are placed by the same three numbers.
SunPixels::View SunPixels::view_of(const BoundSource& light, const Placing& placing) const {
    const SourceSampler& sampler = *light.source_sampler;
    if (const auto direction = sampler.beam_direction()) {
        return {light, *direction, light.probability, light.probability / sampler.flux()};
    }
    const auto coordinate = [&](std::uint32_t i) {
        return sampler_.coordinate(placing.stream, placing.first, kDiskDimension + i);
    };
    const DirectionSample from = lattice_direction(
        light, static_cast<std::uint32_t>(placing.point - placing.first), kDiskBeams,
        {coordinate(0), coordinate(1), coordinate(2)});
    const double area = prepared_.projection().entry_box().projected_area(from.direction);
    const double per_area = model_of(*light.source).radiance(-from.direction) /
                            (sampler.flux() * from.density * kDiskBeams);
    return {
        light, from.direction, light.probability * per_area * area, light.probability * per_area};
}

/// Adds the light of one view; light that meets nothing opaque escapes.
void SunPixels::score(const View& view, const ItemBuffer& image, SunLight& found) const {
    const std::size_t bands = prepared_.bands();
    const std::vector<double>& weights = view.light.start_weights;
    double stopped = 0;
    for (const ItemBuffer::Item& item : image.items()) {
        const std::uint32_t region = prepared_.region(item.triangle);
        const double seen = view.of_pixel * item.pixels;
        const double cosine = std::abs(item.cosine);
        const double amount =
            seen * prepared_.rounding().light_share(item.triangle, view.direction, item.cosine);
        stopped += prepared_.material(region).is_transparent() ? 0 : amount;
        if (!prepared_.fields_of_view().contain(region, cosine)) {
            continue;
        }
        const SurfaceSide side = item.cosine > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        double* flux = &found.flux[(std::size_t{2} * region + index_of(side)) * bands];
        for (std::size_t b = 0; b < bands; ++b) {
            flux[b] += amount * weights[b];
        }
        if (view.light.lit_area > 0 && cosine > 0 &&
            prepared_.rounding().is_sunlit(item.triangle, view.direction, item.cosine)) {
            found.sunlit_area[region] += seen * prepared_.rounding().area_share(item.triangle) *
                                         view.light.lit_area / cosine;
        }
    }
    for (std::size_t b = 0; b < bands; ++b) {
        found.emitted[b] += view.part * weights[b];
        found.escaped[b] += (view.part - stopped) * weights[b];
    }
}

/// Converts fractions of the light to light. The beams of a disk carry more or less than its light;
/// their ratio to the known flux improves the estimate.
void SunPixels::normalize(SunLight& found) const {
    const std::size_t bands = prepared_.bands();
    for (std::size_t b = 0; b < bands; ++b) {
        const double drawn = found.emitted[b];
        const double scale = drawn > 0 ? prepared_.lights().flux()[b] / drawn : 0;
        found.emitted[b] *= scale;
        found.escaped[b] *= scale;
        for (std::size_t i = b; i < found.flux.size(); i += bands) {
            found.flux[i] *= scale;
        }
    }
    for (double& area : found.sunlit_area) {
        area *= prepared_.lights().sun_area();
    }
}

}  // namespace quasimc
