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
    .over_triangles = 16,
    .paths_per_triangle = 2,
    .times_few = 4,
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

/// Minimum number of lines of a beam, and of a sun's single beam in an open scene, where they take
/// less time than the preparation.
constexpr std::uint32_t kMinLines = 16, kMinWhereCheap = 32;
/// Minimum number of lines of few beams together: they take no more time than the preparation.
constexpr std::uint32_t kMinOfFew = 128;

/// Maximum number of projected triangles for each path of a sun. Suns with fewer paths share lines.
/// If all together have too few, or if cuts leave too few lines, paths from the sun are more
/// efficient (docs/develop/notebook/choosing.md).
constexpr double kMaxTrianglesPerPath = 20;
/// Maximum number for each organ as well: few organs have many paths each, and lines improve them
/// less.
constexpr double kMaxTrianglesPerPathOfOrgan = 2;
/// Minimum number of suns that are picked of more. Of fewer, total light varies too much, and the
/// replicates do not show all of the error (SamplingStrategy::many).
constexpr std::uint32_t kMinPicks = 5;
/// Minimum number of lines of a sun with costly cuts. In an infinite
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
/// Number of paths up to which scattered light by bundles takes longer than they.
constexpr double kFewPaths = 8192;
/// Minimum number of directions of all skies.
constexpr std::uint32_t kMinDirections = 4;
/// Maximum number of blocks of directions.
constexpr std::uint32_t kDirectionBlocks = 16;
/// Cost of projecting a triangle, in pixels; twice that in periodic scenes.
constexpr double kPixelsPerTriangle = 20;
/// The directions cost at most this multiple of the pixels of their paths.
constexpr double kMaxOverPixels = 30;
/// The variance of an organ's light from kFewDirections directions, and the power of their number
/// with which it falls. The unit is that of one path for each organ.
constexpr double kFewDirections = 4, kVarianceOfFew = 0.04, kPowerOfDirections = 1.6;

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
    std::uint32_t beams = 0;
    for (const BoundSource& light : prepared.lights()) {
        beams += light.source->is_sun() ? beams_of(light) : 0;
    }
    fewest_lines_ = std::max(kMinLines, kMinOfFew / std::max(beams, 1U));
    set_lines(LineCost(seen), paths);
    sees_skies_ =
        !skies.skies().empty() && are_directions_better(skies.probability() * worth_of(paths));
}

void SamplingBudget::set_lines(const LineCost& cost, std::uint64_t first) {
    const double paths = worth_of(first);
    const auto suns = std::ranges::count_if(
        prepared_.lights(), [](const BoundSource& light) { return light.source->is_sun(); });
    projection_ =
        prepared_.caster().mesh().triangle_count() /
        std::min(
            (suns < kMinPicks ? density_.over_triangles : 1) * kMaxTrianglesPerPath,
            kMaxTrianglesPerPathOfOrgan * std::max(1., measured_organs(prepared_.scene())));
    std::vector<ManySuns::Sun> many;
    for (std::uint32_t i = 0; i < prepared_.lights().size(); ++i) {
        const BoundSource& light = prepared_.lights()[i];
        cuts_per_line_.push_back(0);
        has_lines_.push_back(false);
        if (!light.source->is_sun()) {
            continue;
        }
        const SourceSampler& sampler = *light.source_sampler;
        const Vec3 direction = sampler.beam_direction()
                                   ? *sampler.beam_direction()
                                   : sampler.draw_direction(0.5, 0.5).direction;
        cuts_per_line_[i] = cost.cuts_per_line(direction);
        const double own = light.probability * paths;
        const double fewest = fewest_paths(i, own);
        if (own < fewest) {
            if (are_close(lines_of({.light = i, .probability = fewest / paths}, paths), first)) {
                many.push_back({i, light.probability, fewest, direction});
            }
        } else if (are_close(lines_of(whole(i), paths), first)) {
            alone_.push_back(i);
            has_lines_[i] = true;
        }
    }
    many_ = ManySuns(std::move(many));
    if (many_.affordable(paths) < std::min<std::size_t>(kMinPicks, many_.suns().size())) {
        many_ = {};
    }
    for (const ManySuns::Sun& sun : many_.suns()) {
        has_lines_[sun.light] = true;
    }
}

double SamplingBudget::worth_of(std::uint64_t paths) const {
    const auto own = static_cast<double>(paths);
    return std::max(
        {own, std::min(density_.times_few * own, kFewPaths),
         density_.paths_per_triangle * prepared_.caster().mesh().triangle_count()});
}

VisibilityTask SamplingBudget::whole(std::uint32_t light) const {
    const BoundSource& sun = prepared_.lights()[light];
    return {.light = light, .probability = sun.probability, .beams = beams_of(sun)};
}

double SamplingBudget::fewest_paths(std::size_t light, double own) const {
    const std::uint32_t beams = beams_of(prepared_.lights()[light]);
    const double lines = beams * std::min(usual_lines(beams, own), kMinWhereCostly / beams);
    return std::max(projection_, lines * cuts_per_line_[light] / density_.cuts_per_path);
}

bool SamplingBudget::are_close(const VisibilityTask& task, std::uint64_t first) const {
    if (task.count >= usual_lines(task.beams, task.probability * worth_of(first))) {
        return true;
    }
    const Round round{.count = first};
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
    const double of_few = skies_of(paths).count / kFewDirections;
    const double variance = kVarianceOfFew * std::pow(of_few, -kPowerOfDirections);
    return variance * paths <= std::max(1., measured_organs(prepared_.scene()));
}

std::vector<VisibilityTask> SamplingBudget::tasks(const Round& round, double pick) const {
    const double paths = worth_of(round.count);
    std::vector<VisibilityTask> tasks;
    add_suns(paths, tasks);
    add_picks(paths, pick, tasks);
    if (sees_skies_) {
        tasks.push_back(skies_of(skies_.probability() * paths));
    }
    std::uint64_t first = 0;
    for (VisibilityTask& task : tasks) {
        task.first_block = first;
        first += task.blocks;
    }
    return tasks;
}

std::vector<VisibilityTask> SamplingBudget::largest_tasks(const Round& round) const {
    const double paths = worth_of(round.count);
    std::vector<VisibilityTask> tasks;
    if (picks_suns()) {
        tasks.push_back({.is_picked = true, .probability = many_.light_of_each(picks(paths))});
    } else {
        add_suns(paths, tasks);
    }
    if (sees_skies_) {
        tasks.push_back(skies_of(skies_.probability() * paths));
    }
    return tasks;
}

double SamplingBudget::light_per_sample(const VisibilityTask& task, const Round& round) const {
    const auto paths = static_cast<double>(round.count);
    if (task.is_sky) {
        return skies_.probability() * paths / task.count;
    }
    if (task.is_picked) {
        return task.probability * paths;
    }
    const EntryBox& box = prepared_.projection().entry_box();
    const SourceSampler& sampler = *prepared_.lights()[task.light].source_sampler;
    const double area = sampler.beam_direction()
                            ? sampler.flux()
                            : box.projected_area(sampler.draw_direction(0.5, 0.5).direction);
    return task.probability * paths / task.beams * spacing(task) / area;
}

double SamplingBudget::spacing(const VisibilityTask& task) const {
    // At most the width of the scene over the number of lines.
    return length(prepared_.projection().entry_box().bounds.size()) / task.count;
}

std::uint32_t SamplingBudget::usual_lines(std::uint32_t beams, double paths) const {
    const bool is_disk = beams > 1;
    // A disk's beams need more lines than their share: errors fall with the third power.
    const double usual = density_.paths_per_line > 0 ? paths / density_.paths_per_line
                                                     : density_.lines_per_root * std::sqrt(paths);
    const double lines = usual * (is_disk ? 2 : 1) / beams;
    const bool are_cheap = !is_disk && !prepared_.scene().cell().periodic();
    return std::max(
        are_cheap ? std::max(fewest_lines_, kMinWhereCheap) : fewest_lines_,
        static_cast<std::uint32_t>(lines));
}

VisibilityTask SamplingBudget::lines_of(VisibilityTask beams, double paths) const {
    const double own = beams.probability * paths;
    beams.count = usual_lines(beams.beams, own);
    const double cuts = beams.beams * cuts_per_line_[beams.light];
    if (beams.count * cuts > density_.cuts_per_path * own) {
        const auto cheap = static_cast<std::uint32_t>(density_.cuts_per_path * own / cuts);
        beams.count = std::min(beams.count, std::max(kMinWhereCostly / beams.beams, cheap));
    }
    beams.blocks = ScanLines::strips(beams.count);
    return beams;
}

void SamplingBudget::add_suns(double paths, std::vector<VisibilityTask>& tasks) const {
    for (const std::uint32_t sun : alone_) {
        VisibilityTask task = lines_of(whole(sun), paths);
        for (; task.beam < task.beams; ++task.beam) {
            tasks.push_back(task);
        }
    }
}

std::uint32_t SamplingBudget::picks(double paths) const {
    return std::max(1U, many_.affordable(paths));
}

void SamplingBudget::add_picks(
    double paths, double pick, std::vector<VisibilityTask>& tasks) const {
    if (!picks_suns()) {
        return;
    }
    for (const auto& [light, probability] : many_.pick(picks(paths), pick)) {
        tasks.push_back(
            lines_of({.is_picked = true, .light = light, .probability = probability}, paths));
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

std::uint64_t blocks_of(const std::vector<VisibilityTask>& tasks) {
    return tasks.empty() ? 0 : tasks.back().first_block + tasks.back().blocks;
}

std::uint32_t task_of_block(const std::vector<VisibilityTask>& tasks, std::uint64_t block) {
    const auto after = std::upper_bound(
        tasks.begin(), tasks.end(), block,
        [](std::uint64_t b, const VisibilityTask& task) { return b < task.first_block; });
    return static_cast<std::uint32_t>(after - tasks.begin() - 1);
}

}  // namespace quasimc
