#pragma once

#include <cstdint>
#include <vector>

#include "solvers/direct/line_cost.h"
#include "solvers/direct/many_suns.h"
#include "solvers/solver.h"
#include "transport/sky_directions.h"

namespace quasimc {

/// Number of directions that represent the disk of a sun.
inline constexpr std::uint32_t kDiskBeams = 8;
/// Number of beams that represent a sun.
[[nodiscard]] std::uint32_t beams_of(const BoundSource& sun);

/// Part of the light from far away in one round: a beam that is cut into scan lines, or all skies.
struct VisibilityTask {
    bool is_sky = false;
    bool is_picked = false;   ///< a sun that represents others as well
    std::uint32_t light = 0;  ///< index of a light with beams
    double probability = 0;  ///< probability of the light that its beams represent, over all lights
    std::uint32_t beam = 0,
                  beams = 1;  ///< index among the directions of a sun's disk, and their number
    std::uint32_t count = 0;  ///< number of lines, or of directions
    double pixels = 0;        ///< per direction of the skies
    std::uint64_t first_block = 0, blocks = 0;
};

/// Method for scattered light. With bundles, direct light has more of the error and is sampled more
/// densely.
enum class ScatteredBy { paths, bundles };

/// Sampling density of direct light for a number of paths.
struct SamplingDensity {
    double paths_per_line = 0;  ///< 0: lines_per_root decides
    double lines_per_root = 0;  ///< lines per square root of the number of paths
    double pixels_per_path = 0;
    double pixels_per_root =
        0;  ///< pixels of a sky direction per square root of the number of triangles
    double most_over_root =
        1;  ///< largest factor on pixels_per_root if triangles would have few pixels
    double cuts_per_path = 0;  ///< limit of triangle images that the lines of a sun cut
    /// Factor on the limit of projected triangles where suns are too few to pick some of them.
    double over_triangles = 1;
    /// Paths for each triangle that take as long as the scattered light, however few there are:
    /// direct light is sampled for as many at least.
    double paths_per_triangle = 0;
    double times_few = 1;  ///< likewise, factor on the number of few paths
    /// Largest contribution of a line to a typical organ if cuts leave fewer lines than usual, as a
    /// number of paths.
    double paths_per_sample = 0;
};

/// Chooses the sampling density of direct light for a number of paths. Its constants maximize the
/// figure of merit of direct and scattered light together (docs/develop/notebook/first-hits.md).
class SamplingBudget {
  public:
    /// @param seen  input of projections
    /// @param paths  of the first round, which decides for all rounds
    SamplingBudget(
        const PreparedScene& prepared,
        const SkyDirections& skies,
        const ProjectedScene& seen,
        std::uint64_t paths,
        ScatteredBy scattered = ScatteredBy::paths);

    /// Whether the direct light of a sun is sampled along lines, of its own or as one of many suns
    /// of which some are picked. Paths from the sun are more efficient at dawn in an infinite
    /// stand, where a line cuts thousands of periodic images, and if there are few paths for many
    /// triangles. False for other lights.
    [[nodiscard]] bool has_lines(std::size_t light) const { return has_lines_[light]; }
    /// Whether each replicate picks some suns of many.
    [[nodiscard]] bool picks_suns() const { return !many_.empty(); }

    /// Whether there are skies and their direct light is sampled by item buffers. Paths from the
    /// skies are better if few directions would do for few organs with many paths each.
    [[nodiscard]] bool sees_skies() const { return sees_skies_; }

    /// The tasks of a round, their blocks one after the other: at most kDiskBeams for each sun, and
    /// one for all skies. Takes time in proportion to the suns.
    /// @param pick  random number in [0, 1) that picks suns of many
    [[nodiscard]] std::vector<VisibilityTask> tasks(const Round& round, double pick = 0) const;
    /// Tasks with the largest contributions that a round may have, without blocks. If suns are
    /// picked, one of these represents all suns.
    [[nodiscard]] std::vector<VisibilityTask> largest_tasks(const Round& round) const;

    /// has_lines() by light.
    [[nodiscard]] const std::vector<bool>& lights_with_lines() const { return has_lines_; }
    /// Whether some sun has no lines, and is sampled by paths.
    [[nodiscard]] bool traces_suns() const;

    /// The largest contribution of a sample of a task, as a number of paths: all light along a
    /// direction of the skies or of a picked sun, or the light per unit length of a scan line,
    /// local units.
    [[nodiscard]] double light_per_sample(const VisibilityTask& task, const Round& round) const;
    /// The largest distance of neighbouring scan lines of a task, local units.
    [[nodiscard]] double spacing(const VisibilityTask& task) const;

  private:
    /// The number of paths that take as long as scattered light does with this number.
    [[nodiscard]] double worth_of(std::uint64_t paths) const;
    /// @param first  paths of the first round
    void set_lines(const LineCost& cost, std::uint64_t first);
    /// Whether directions have smaller errors than `paths` paths from the skies.
    [[nodiscard]] bool are_directions_better(double paths) const;
    /// The smallest number of paths that take as long as the lines of a sun may. @param own  of it
    [[nodiscard]] double fewest_paths(std::size_t light, double own) const;
    /// Lines of each of the beams of a sun, regardless of the cost of cuts.
    [[nodiscard]] std::uint32_t usual_lines(std::uint32_t beams, double paths) const;
    /// The light of a sun, with its beams.
    [[nodiscard]] VisibilityTask whole(std::uint32_t light) const;
    /// The beams that represent the light of a sun, or more, and lines of each.
    /// @param paths  of all lights
    [[nodiscard]] VisibilityTask lines_of(VisibilityTask beams, double paths) const;
    /// The number of suns that are picked of many.
    [[nodiscard]] std::uint32_t picks(double paths) const;
    /// Whether the lines of a sun are as many as usual, or so close together that the largest
    /// contribution of one to an organ is no more than that of a few paths.
    [[nodiscard]] bool are_close(const VisibilityTask& task, std::uint64_t first) const;
    [[nodiscard]] VisibilityTask skies_of(double paths) const;
    /// Adds the beams of suns with lines of their own.
    void add_suns(double paths, std::vector<VisibilityTask>& tasks) const;
    /// Adds the beams of suns that are picked of many.
    void add_picks(double paths, double pick, std::vector<VisibilityTask>& tasks) const;
    /// Pixels of a direction. @param most_over_root  see SamplingDensity
    [[nodiscard]] double pixels_for(double paths, double most_over_root) const;

    const PreparedScene& prepared_;
    const SkyDirections& skies_;
    SamplingDensity density_;
    std::uint32_t fewest_lines_;         // of a beam
    double projection_ = 0;              // fewest paths of a sun for all triangles
    std::vector<double> cuts_per_line_;  // by light
    std::vector<bool> has_lines_;        // by light
    std::vector<std::uint32_t> alone_;   // suns with lines of their own
    ManySuns many_;                      // suns that share lines
    bool sees_skies_ = false;
};

/// The number of blocks of all tasks.
[[nodiscard]] std::uint64_t blocks_of(const std::vector<VisibilityTask>& tasks);
/// The index of the task that a block belongs to. @param block  less than the end of the
/// last task's blocks
[[nodiscard]] std::uint32_t task_of_block(
    const std::vector<VisibilityTask>& tasks, std::uint64_t block);

}  // namespace quasimc
