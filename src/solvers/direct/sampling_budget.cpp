#include "solvers/direct/sampling_budget.h"

#include <algorithm>
#include <cmath>

#include "raster/scan_lines.h"
#include "transport/organ_shares.h"

namespace quasimc {
namespace {

/// If all bands scatter most of the light, most noise is in the paths: fewer lines and pixels leave
/// time for more paths.
constexpr SamplingDensity kDarkDensity{
    .paths_per_line = 80,
    .pixels_per_path = 40,
    .pixels_per_root = 640,
    .cuts_per_path = 10,
    .paths_per_sample = 4};
constexpr SamplingDensity kBrightDensity{
    .paths_per_line = 160,
    .pixels_per_path = 10,
    .pixels_per_root = 640,
    .cuts_per_path = 10,
    .paths_per_sample = 4};
/// Errors of lines fall with the third power of their number, those of bundles with the square root
/// of theirs, at every albedo. Bundles take several times as long per path, and so may lines.
constexpr SamplingDensity kBrightBundleDensity{
    .lines_per_root = 12.8,
    .pixels_per_path = 160,
    .pixels_per_root = 320,
    .most_over_root = 2,
    .cuts_per_path = 160,
    .paths_per_sample = 2};
/// The density with `times` as many pixels in each direction.
constexpr SamplingDensity with_pixels(SamplingDensity density, double times) {
    density.pixels_per_path *= times;
    density.pixels_per_root *= times;
    return density;
}
/// Scattered light of low-albedo leaves has small errors; pixels have most of the error.
constexpr SamplingDensity kDarkBundleDensity = with_pixels(kBrightBundleDensity, 3);
/// The largest albedo of a scene from which on a band is bright.
constexpr double kBrightAlbedo = 0.5;

/// Whether all bands scatter most of the light.
bool is_bright(const PreparedScene& prepared) {
    const std::vector<double> albedos = largest_albedos(prepared.scene());
    return std::all_of(
        albedos.begin(), albedos.end(), [](double albedo) { return albedo >= kBrightAlbedo; });
}

const SamplingDensity& sampling_density(const PreparedScene& prepared, ScatteredBy scattered) {
    if (scattered == ScatteredBy::bundles) {
        return is_bright(prepared) ? kBrightBundleDensity : kDarkBundleDensity;
    }
    return is_bright(prepared) ? kBrightDensity : kDarkDensity;
}

/// Minimum number of lines: of a beam, of all beams together if they are hundreds, and of each of
/// these.
constexpr std::uint32_t kMinLines = 16, kMinLinesInAll = 4096, kMinOfMany = 4;
/// Minimum number of lines of few beams together: they take no more time than the preparation.
constexpr std::uint32_t kMinOfFew = 128;

/// The minimum number of lines of each beam.
std::uint32_t fewest_lines(std::uint32_t suns, std::uint32_t beams) {
    const std::uint32_t of_many =
        std::clamp(kMinLinesInAll / std::max(suns, 1U), kMinOfMany, kMinLines);
    return std::max(of_many, kMinOfFew / std::max(beams, 1U));
}

/// Maximum number of projected triangles for each path of a sun. If they would be more, or if cuts
/// leave too few lines, paths from the sun are more efficient (docs/develop/notebook/choosing.md).
constexpr double kMaxTrianglesPerPath = 20;
/// Maximum number for each organ as well: few organs have many paths each, and lines improve them
/// less.
constexpr double kMaxTrianglesPerPathOfOrgan = 2;
/// Minimum number of lines of a sun with costly cuts, unless it is one of many. In an infinite
/// stand, 37 lines at an elevation of 1 degree had 500 times the error of as many paths, 41 lines
/// at 5 degrees 5 times.
constexpr std::uint32_t kMinWhereCostly = 64;

/// Pixels of a direction of a sky. Projecting a triangle costs as much as some pixels, and many
/// triangles need less accuracy each: pixels grow with the square root of their number, with at
/// least two for each. For very many paths pixels dominate over directions in the error, and each
/// direction gets more.
constexpr double kMinPerTriangle = 2;
/// Pixels per triangle if scattered light has small errors, limited by most_over_root.
constexpr double kWantedPerTriangle = 6;
constexpr double kManyPaths = 65536, kGrowthOfPixels = 3.0 / 8;
constexpr double kMinPixels = 1024, kMaxPixels = 2048 * 2048;
/// Factor for periodic scenes, where no pixel is empty.
constexpr double kShareOfLayer = 1.0 / 3;
/// Minimum number of directions of a sky, and maximum number of blocks.
constexpr std::uint32_t kMinDirections = 4;
constexpr std::uint32_t kDirectionBlocks = 16;
/// Cost of projecting a triangle, in pixels; twice that in periodic scenes.
constexpr double kPixelsPerTriangle = 20;
/// The directions cost at most this multiple of the pixels of their paths.
constexpr double kMaxOverPixels = 30;
/// The variance of an organ's light from kMinDirections directions, and the power of their number
/// with which it falls. The unit is that of one path for each organ.
constexpr double kVarianceOfFew = 0.04, kPowerOfDirections = 1.6;

/// Number of measured organs, without the ground.
double measured_organs(const Scene& scene) {
    return static_cast<double>(std::count_if(
        scene.organs().begin(), scene.organs().end(),
        [](const Organ& organ) { return organ.measured && !organ.is_ground && organ.area > 0; }));
}

}  // namespace

std::uint32_t beams_of(const BoundSource& sun) {
    return sun.source_sampler->beam_direction() ? 1 : kDiskBeams;
}

SamplingBudget::SamplingBudget(
    const PreparedScene& prepared,
    const SkyDirections& skies,
    const ProjectedScene& seen,
    std::uint64_t paths,
    ScatteredBy scattered)
    : prepared_(prepared), skies_(skies), density_(sampling_density(prepared, scattered)) {
    std::uint32_t suns = 0, beams = 0;
    for (const BoundSource& light : prepared.lights()) {
        if (light.source->is_sun()) {
            ++suns;
            beams += beams_of(light);
        }
    }
    fewest_lines_ = fewest_lines(suns, beams);
    set_lines(LineCost(seen), static_cast<double>(paths));
    sees_skies_ = !skies.skies().empty() &&
                  are_directions_better(skies.probability() * static_cast<double>(paths));
}

void SamplingBudget::set_lines(const LineCost& cost, double paths) {
    const double triangles = prepared_.caster().mesh().triangle_count();
    const double most_triangles = std::min(
        kMaxTrianglesPerPath,
        kMaxTrianglesPerPathOfOrgan * std::max(1., measured_organs(prepared_.scene())));
    for (std::size_t i = 0; i < prepared_.lights().size(); ++i) {
        const BoundSource& light = prepared_.lights()[i];
        cuts_per_line_.push_back(0);
        has_lines_.push_back(false);
        if (light.source->is_sun()) {
            const SourceSampler& sampler = *light.source_sampler;
            cuts_per_line_[i] = cost.cuts_per_line(
                sampler.beam_direction() ? *sampler.beam_direction()
                                         : sampler.draw_direction(0.5, 0.5).direction);
            const double own = light.probability * paths;
            const VisibilityTask task = lines_of(i, own);
            has_lines_[i] =
                triangles <= most_triangles * own &&
                task.beams * task.count * cuts_per_line_[i] <= density_.cuts_per_path * own &&
                are_close(task, paths);
        }
    }
}

bool SamplingBudget::are_close(const VisibilityTask& task, double paths) const {
    const BoundSource& light = prepared_.lights()[task.light];
    if (task.count >= usual_lines(task.light, light.probability * paths)) {
        return true;
    }
    const Round round{.count = static_cast<std::uint64_t>(paths)};
    const double organ = std::sqrt(median_measured_area(prepared_.scene()));
    // On an organ that no line finds lit, twice the distance of lines may be lit
    // (theory/statistics.md).
    return light_per_sample(task, round) * std::min(organ, 2 * spacing(task)) <=
           density_.paths_per_sample;
}

bool SamplingBudget::traces_suns() const {
    for (std::size_t i = 0; i < prepared_.lights().size(); ++i) {
        if (prepared_.lights()[i].source->is_sun() && !has_lines_[i]) {
            return true;
        }
    }
    return false;
}

bool SamplingBudget::are_directions_better(double paths) const {
    const double of_few = skies_of(paths).count / double{kMinDirections};
    const double variance = kVarianceOfFew * std::pow(of_few, -kPowerOfDirections);
    return variance * paths <= std::max(1., measured_organs(prepared_.scene()));
}

std::vector<VisibilityTask> SamplingBudget::tasks(const Round& round) const {
    std::vector<VisibilityTask> tasks;
    for (std::uint32_t i = 0; i < prepared_.lights().size(); ++i) {
        const BoundSource& light = prepared_.lights()[i];
        if (has_lines_[i]) {
            add_beams(i, light.probability * static_cast<double>(round.count), tasks);
        }
    }
    if (sees_skies_) {
        tasks.push_back(skies_of(skies_.probability() * static_cast<double>(round.count)));
    }
    std::uint64_t first = 0;
    for (VisibilityTask& task : tasks) {
        task.first_block = first;
        first += task.blocks;
    }
    return tasks;
}

double SamplingBudget::light_per_sample(const VisibilityTask& task, const Round& round) const {
    const auto paths = static_cast<double>(round.count);
    if (task.is_sky) {
        return skies_.probability() * paths / task.count;
    }
    const BoundSource& light = prepared_.lights()[task.light];
    const EntryBox& box = prepared_.projection().entry_box();
    const SourceSampler& sampler = *light.source_sampler;
    const double area = sampler.beam_direction()
                            ? sampler.flux()
                            : box.projected_area(sampler.draw_direction(0.5, 0.5).direction);
    return light.probability * paths / task.beams * spacing(task) / area;
}

double SamplingBudget::spacing(const VisibilityTask& task) const {
    // At most the width of the scene over the number of lines.
    return length(prepared_.projection().entry_box().bounds.size()) / task.count;
}

std::uint32_t SamplingBudget::usual_lines(std::size_t light, double paths) const {
    const std::uint32_t beams = beams_of(prepared_.lights()[light]);
    const bool is_disk = beams > 1;
    // A disk's beams need more lines than their share: errors fall with the third power.
    const double usual = density_.paths_per_line > 0 ? paths / density_.paths_per_line
                                                     : density_.lines_per_root * std::sqrt(paths);
    const double lines = usual * (is_disk ? 2 : 1) / beams;
    return std::max(fewest_lines_, static_cast<std::uint32_t>(lines));
}

VisibilityTask SamplingBudget::lines_of(std::size_t light, double paths) const {
    const std::uint32_t beams = beams_of(prepared_.lights()[light]);
    std::uint32_t count = usual_lines(light, paths);
    const double cuts = beams * cuts_per_line_[light];
    if (count * cuts > density_.cuts_per_path * paths) {
        const auto cheap = static_cast<std::uint32_t>(density_.cuts_per_path * paths / cuts);
        const std::uint32_t fewest = std::max(kMinOfMany, kMinWhereCostly / beams);
        count = std::min(count, std::max(fewest, cheap));
    }
    return {
        .light = static_cast<std::uint32_t>(light),
        .beams = beams,
        .count = count,
        .blocks = ScanLines::strips(count)};
}

void SamplingBudget::add_beams(
    std::uint32_t light, double paths, std::vector<VisibilityTask>& tasks) const {
    VisibilityTask task = lines_of(light, paths);
    for (; task.beam < task.beams; ++task.beam) {
        tasks.push_back(task);
    }
}

VisibilityTask SamplingBudget::skies_of(double paths) const {
    const double images = prepared_.scene().cell().periodic() ? 2 : 1;
    const double triangles = prepared_.caster().mesh().triangle_count();
    const double all = density_.pixels_per_path * paths;
    const double pixels = pixels_for(paths, density_.most_over_root);
    const double wanted = std::round(all / pixels_for(paths, 1));
    const double cheap = kMaxOverPixels * all / (pixels + kPixelsPerTriangle * images * triangles);
    const auto skies = static_cast<std::uint32_t>(skies_.skies().size());
    const auto count = static_cast<std::uint32_t>(std::min(wanted, cheap));
    const std::uint32_t directions = std::max({kMinDirections, skies, count});
    return {
        .is_sky = true,
        .count = directions,
        .pixels = pixels,
        .blocks = std::min(directions, kDirectionBlocks)};
}

double SamplingBudget::pixels_for(double paths, double most_over_root) const {
    const double triangles = prepared_.caster().mesh().triangle_count();
    const double share = prepared_.scene().cell().periodic() ? kShareOfLayer : 1;
    const double growth = std::pow(std::max(1.0, paths / kManyPaths), kGrowthOfPixels);
    const double root = density_.pixels_per_root * std::sqrt(triangles);
    const double wanted = std::clamp(kWantedPerTriangle * triangles, root, most_over_root * root);
    const double pixels = std::max(share * wanted, kMinPerTriangle * triangles);
    return std::clamp(growth * pixels, kMinPixels, kMaxPixels);
}

bool bundles_trace_suns_alone(const PreparedScene& prepared, std::uint64_t paths) {
    const BoundLights& lights = prepared.lights();
    if (lights.empty() || !std::all_of(lights.begin(), lights.end(), [](const BoundSource& light) {
            return light.source->is_sun();
        })) {
        return false;
    }
    const ProjectedScene seen{
        &prepared.caster().mesh(),
        prepared.projection().cell(),
        {},
        prepared.projection().outline(),
        nullptr};
    return SamplingBudget(prepared, SkyDirections(prepared), seen, paths, ScatteredBy::bundles)
        .traces_suns();
}

std::uint32_t task_of_block(const std::vector<VisibilityTask>& tasks, std::uint64_t block) {
    const auto after = std::upper_bound(
        tasks.begin(), tasks.end(), block,
        [](std::uint64_t b, const VisibilityTask& task) { return b < task.first_block; });
    return static_cast<std::uint32_t>(after - tasks.begin() - 1);
}

}  // namespace quasimc
