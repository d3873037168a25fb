#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "solvers/ray_bundles/kept_lines.h"
#include "solvers/ray_bundles/patch_light.h"

namespace quasimc {

/// Directions of one step, and how densely lines stand along each.
struct BundleGroup {
    std::uint32_t directions = 2;  ///< even
    double line_area = 1;          ///< wanted, across each direction: local units squared
    std::uint64_t key = 0;         ///< places them
};

/// Direction `i` of a group, on the upper half of the sphere: a spiral of the golden angle, turned
/// and shifted at random. Each is uniform in its layer of the hemisphere, and two neighbours
/// together are exactly half as high as the zenith, on average: the horizontal has its exact
/// area in every group.
[[nodiscard]] Vec3 bundle_direction(const BundleGroup& group, std::uint32_t i);

/// Exchanges light between patches along bundles of parallel lines.
///
/// All light that leaves matt patches goes along lines to the next patch, both ways: along a line
/// that stands for the area a and the solid angle w of its direction, a patch of exitance B sends
/// the flux B a w / pi. Objects are used by one thread, which may start more.
class BundleExchange {
  public:
    BundleExchange(const PatchScene& patches, const ProjectedScene& seen)
        : patches_(patches), seen_(seen) {}

    /// Light that leaves the scene: its direction, and flux in each column of PatchLight.
    using OnEscape = std::function<void(const Vec3& direction, std::span<const double> flux)>;
    /// The sides, [2 * patch + side], from which lines leave the scene along a direction, line by
    /// line, and the flux that one of them takes from a patch of exitance 1.
    using OnEnds = std::function<void(
        std::span<const std::uint32_t> sides, const Vec3& direction, double weight)>;
    /// Who is told what becomes of lines, direction by direction in their order; or nobody.
    struct Tell {
        OnEscape on_escape;
        OnEnds on_ends;
    };

    /// Lets the exitance go along all lines, and adds it to the light incident on what it meets.
    /// @returns stretches of lines along which light went
    /// @param threads  at most; the same light comes of any number
    std::uint64_t exchange(
        const BundleGroup& group, unsigned threads, PatchLight& light, const Tell& tell);

  private:
    /// A direction, and the flux that one of its lines takes from a patch of exitance 1.
    struct Beam {
        Vec3 direction;
        double weight = 0;
    };
    /// What becomes of the lines of a direction.
    struct Found {
        std::vector<double> forwards, backwards;  // escaped, by column
        std::vector<std::uint32_t> ends;          // see OnEnds, the first end_count
        std::size_t end_count = 0;

        /// Before light goes along so many stretches.
        void begin(std::size_t columns, std::size_t stretches) {
            forwards.assign(columns, 0);
            backwards.assign(columns, 0);
            ends.resize(std::max(ends.size(), stretches));  // more than enough
            end_count = 0;
        }
    };

    struct Pack {
        std::size_t index = 0;
        bool finds_ends = false;
    };

    void exchange_along(
        const Columns& lines, const Beam& beam, PatchLight& light, const Tell& tell);
    void exchange_kept(unsigned threads, PatchLight& light, const Tell& tell);
    template <typename Lines>
    void exchange_pack(
        const Lines& lines, const Beam& beam, const Pack& pack, PatchLight& light, Found& found);
    static void tell_found(const Beam& beam, const Found& found, const Tell& tell);

    const PatchScene& patches_;
    const ProjectedScene& seen_;
    std::vector<std::unique_ptr<Columns>> columns_;  // of each thread
    Found found_;                                    // along lines that are not kept
    KeptLines kept_;
    std::vector<Beam> beams_;  // whose lines are kept
};

}  // namespace quasimc
