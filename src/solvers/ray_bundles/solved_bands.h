#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
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
///
/// Each origin of light has columns of its own, one for each solved band.
class SolvedBands {
  public:
    /// @param shares  amounts of the lights, [light][band]
    SolvedBands(
        const Scene& scene, std::span<const std::vector<double>> shares, std::size_t origins = 1);
    /// The bands of a run.
    [[nodiscard]] static SolvedBands of(const PreparedScene& prepared);

    /// Number of all bands.
    [[nodiscard]] std::size_t all() const { return all_; }
    [[nodiscard]] bool are_all() const { return bands_.size() == all_; }
    /// Number of solved bands of all origins, the columns of PatchLight.
    [[nodiscard]] std::size_t count() const { return bands_.size() * origins_; }
    [[nodiscard]] std::size_t origins() const { return origins_; }
    /// The numbers of solved bands, the same for each origin, [column].
    [[nodiscard]] std::vector<double> select(std::span<const double> numbers) const;
    /// The start weights of a light in the columns of its origin, 0 in others, [column].
    [[nodiscard]] std::vector<double> weights_of(const BoundSource& light) const;

    /// Interpolates the light of an origin.
    /// @param light  in the solved bands, [column of the origin]
    /// @param deviations  by band, in standard errors of the interpolation, which are added
    /// @param all  receives the light in all bands; solved ones keep theirs
    void interpolate(
        std::span<const double> light,
        std::span<const double> deviations,
        std::span<double> all) const;

  private:
    std::size_t all_ = 0, origins_ = 1;
    std::vector<std::size_t> bands_;    // by column of an origin
    std::vector<std::size_t> columns_;  // in the order of choice
    std::vector<double> factor_;        // Cholesky factor of the kernel, [in order of choice][band]
    std::vector<double> unexplained_;   // by band, root
};

/// SolvedBands::count() before a scene is prepared: the amounts of its lights are then known
/// approximately.
/// @param origins  as RunSpec::origins
[[nodiscard]] std::size_t count_solved_bands(
    const Scene& scene, const Sources& sources, std::span<const std::string> origins = {});

}  // namespace quasimc
