#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quasimc/source.h"
#include "scene/scene.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// The bands in which scattered light is solved, and its interpolation in all others.
///
/// Scattered light is a power series in the reflectances and transmittances x of all materials, and
/// linear in the shares s of the lights in a band. So it is interpolated over bands with the kernel
/// k = t / (1 - t) * <s, s'>, t = <x, x'> / (2 max |x|^2). Bands are chosen by a pivoted Cholesky
/// factorization, until what they do not explain of the others is negligible. Few bands are all
/// solved, and so are bands that too many would have to explain. See docs/theory/ray-bundles.md.
class SolvedBands {
  public:
    /// @param shares  amounts of the lights, [light][band]
    SolvedBands(const Scene& scene, std::span<const std::vector<double>> shares);
    /// The bands of a run.
    [[nodiscard]] static SolvedBands of(const PreparedScene& prepared);

    /// Number of all bands.
    [[nodiscard]] std::size_t all() const { return all_; }
    [[nodiscard]] bool are_all() const { return bands_.size() == all_; }
    /// Number of solved bands, the columns of PatchLight.
    [[nodiscard]] std::size_t count() const { return bands_.size(); }
    /// The band of a column.
    [[nodiscard]] std::size_t operator[](std::size_t column) const { return bands_[column]; }
    /// The numbers of solved bands, [column].
    [[nodiscard]] std::vector<double> select(std::span<const double> numbers) const;

    /// Interpolates light.
    /// @param light  in the solved bands, [column]
    /// @param deviations  by band, in standard errors of the interpolation, which are added
    /// @param all  receives the light in all bands; solved ones keep theirs
    void interpolate(
        std::span<const double> light,
        std::span<const double> deviations,
        std::span<double> all) const;

  private:
    std::size_t all_ = 0;
    std::vector<std::size_t> bands_;    // by column
    std::vector<std::size_t> columns_;  // in the order of choice
    std::vector<double> factor_;        // Cholesky factor of the kernel, [in order of choice][band]
    std::vector<double> unexplained_;   // by band, root
};

/// Number of solved bands before a scene is prepared: the amounts of its lights are then known
/// approximately.
[[nodiscard]] std::size_t count_solved_bands(const Scene& scene, const Sources& sources);

}  // namespace quasimc
