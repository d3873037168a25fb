#pragma once

#include <cstdint>
#include <vector>

#include "solvers/direct/line_cost.h"
#include "solvers/solver.h"
#include "transport/sky_directions.h"

namespace quasimc {

/// Directions that stand for the disk of a sun.
inline constexpr std::uint32_t kDiskBeams = 8;
/// How many beams stand for a sun.
[[nodiscard]] std::uint32_t beams_of(const BoundSource& sun);

/// Part of the light from far away in one round: a beam that is cut into scan lines, or all skies.
struct VisibilityTask {
    bool is_sky = false;
    std::uint32_t light = 0;            ///< of a beam
    std::uint32_t beam = 0, beams = 1;  ///< of a sun's disk: which direction, and of how many
    std::uint32_t count = 0;            ///< lines, or directions
    double pixels = 0;                  ///< of each direction of the skies
    std::uint64_t first_block = 0, blocks = 0;
};

/// What scattered light is found by. Along bundles it is known so much better for the time that
/// more of the error is in direct light, which then is sampled more densely.
enum class ScatteredBy { paths, bundles };

/// How densely direct light is sampled for each path that may start.
struct SamplingDensity {
    double paths_per_line = 0;  ///< 0: lines_per_root says
    double lines_per_root = 0;  ///< of the number of paths
    double pixels_per_path = 0;
    double pixels_per_root = 0;  ///< of the number of triangles, along each direction of a sky
    double most_over_root = 1;   ///< so many times that, where triangles would have few pixels
    double cuts_per_path = 0;    ///< images of triangles that the lines of a sun may cut
    /// Paths' light that a line may bring a typical organ where cuts leave fewer lines than usual.
    double paths_per_sample = 0;
};

/// How densely direct light is sampled for how many paths. Direct light and scattered light each
/// have their error; these numbers make the figure of merit of both together the largest in our
/// measurements (docs/develop/notebook/first-hits.md).
class SamplingBudget {
  public:
    /// @param seen  the scene as beams see it
    /// @param paths  of the first round: what is cheap in it is in all
    SamplingBudget(
        const PreparedScene& prepared,
        const SkyDirections& skies,
        const ProjectedScene& seen,
        std::uint64_t paths,
        ScatteredBy scattered = ScatteredBy::paths);

    /// Whether the direct light of a sun is found along lines. Not where they cost so much that
    /// paths from the sun do better for the time: as at dawn in an endless stand, whose images a
    /// line cuts by the thousand, or where few paths have many triangles; nor for lights that are
    /// no suns.
    [[nodiscard]] bool has_lines(std::size_t light) const { return has_lines_[light]; }

    /// Whether there are skies and their direct light is found by pixels. Not where few paths have
    /// so many triangles, or few organs so few directions, that paths from the skies do better for
    /// the time.
    [[nodiscard]] bool sees_skies() const { return sees_skies_; }

    /// The tasks of a round, their blocks one after the other: at most kDiskBeams for each sun, and
    /// one. Takes time in proportion to the suns.
    [[nodiscard]] std::vector<VisibilityTask> tasks(const Round& round) const;

    /// By light; as has_lines() says.
    [[nodiscard]] const std::vector<bool>& lights_with_lines() const { return has_lines_; }
    /// Whether some sun has none, and is traced from itself.
    [[nodiscard]] bool traces_suns() const;

    /// The largest contribution of a sample of a task, in paths' light: of a direction of the skies
    /// all light along it, of a scan line that on a unit of its length, local units.
    [[nodiscard]] double light_per_sample(const VisibilityTask& task, const Round& round) const;
    /// How far apart the scan lines of a task stand at most, local units.
    [[nodiscard]] double spacing(const VisibilityTask& task) const;

  private:
    void set_lines(const LineCost& cost, double paths);
    [[nodiscard]] bool are_skies_cheap(double paths) const;
    /// Lines of each beam of a sun, were it not for what they cut.
    [[nodiscard]] std::uint32_t usual_lines(std::size_t light, double paths) const;
    /// Beams of a sun, and lines of each.
    [[nodiscard]] VisibilityTask lines_of(std::size_t light, double paths) const;
    /// Whether the lines of a sun are as many as usual, or so close together that what one of them
    /// may bring an organ is no more than some paths do.
    [[nodiscard]] bool are_close(const VisibilityTask& task, double paths) const;
    [[nodiscard]] VisibilityTask skies_of(double paths) const;
    void add_beams(std::uint32_t light, double paths, std::vector<VisibilityTask>& tasks) const;
    /// Along a direction. @param most_over_root  see SamplingDensity
    [[nodiscard]] double pixels_for(double paths, double most_over_root) const;

    const PreparedScene& prepared_;
    const SkyDirections& skies_;
    SamplingDensity density_;
    std::uint32_t fewest_lines_;         // of a beam
    std::vector<double> cuts_per_line_;  // by light
    std::vector<bool> has_lines_;        // by light
    bool sees_skies_ = false;
};

/// Whether suns shine alone and bundles would not find the direct light of one of them along lines:
/// its light then lies on patches in spots of single paths, and what these scatter is better
/// traced.
/// @param paths  of the first round
[[nodiscard]] bool bundles_trace_suns_alone(const PreparedScene& prepared, std::uint64_t paths);

/// The index of the task that a block belongs to. @param block  less than the end of the
/// last task's blocks
[[nodiscard]] std::uint32_t task_of_block(
    const std::vector<VisibilityTask>& tasks, std::uint64_t block);

}  // namespace quasimc
