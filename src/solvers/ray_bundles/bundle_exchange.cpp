#include "solvers/ray_bundles/bundle_exchange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/checks.h"
#include "base/parallel.h"
#include "samplers/hash.h"
#include "solvers/ray_bundles/for_bands.h"
#include "solvers/ray_bundles/line_exchange.h"
#include "solvers/ray_bundles/sky_view.h"

namespace quasimc {
namespace {

/// Maximum number of hits in the cache of lines, 4 bytes each.
constexpr std::size_t kMaxCached = std::size_t{1} << 21U;
/// The smallest height of a direction: flatter lines through an infinite canopy would be extremely
/// long, for 1e-10 of the light on the horizontal.
constexpr double kFlattest = 1e-5;

/// The number of a direction that has this purpose, in [0, 1).
double number_of(const BundleGroup& group, std::uint64_t direction, std::uint64_t purpose) {
    return unit_number(mix64(group.key ^ mix64(4 * direction + purpose + 1)));
}

}  // namespace

Vec3 bundle_direction(const BundleGroup& group, std::uint32_t i) {
    EXPECT(group.directions % 2 == 0);
    const double up = number_of(group, ~std::uint64_t{0}, 0);
    const double turn = number_of(group, ~std::uint64_t{0}, 1);
    const double height = std::max(kFlattest, (i + (i % 2 == 0 ? up : 1 - up)) / group.directions);
    const double turns = i * (std::numbers::phi - 1) + turn;
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    const double flat = std::sqrt(std::max(0.0, 1 - height * height));
    return {flat * std::cos(angle), flat * std::sin(angle), height};
}

/// One exchange.
class BundleExchange {
  public:
    BundleExchange(
        PatchExitance exitance,
        const BundleGroup& group,
        const ExchangeOptions& options,
        BundleScratch& scratch)
        : group_(group),
          options_(options),
          scratch_(scratch),
          field_(static_cast<PatchField&&>(exitance)),
          light_(*field_.light),
          scene_(light_.scene()),
          found_areas_(scene_.surfaces.size()),
          open_(options.skies != nullptr ? 2 * scene_.region_areas.size() : 0) {
        while (scratch.threads_.size() < std::max(options.threads, 1U)) {
            scratch.threads_.push_back(std::make_unique<BundleScratch::Thread>());
        }
        scratch.cache_.clear();
        scratch.cached_beams_.clear();
    }

    PatchIrradiance run() {
        const bool is_cached = light_.packs().size() > 1;
        ordered_blocks(
            group_.directions, options_.threads,
            [&](std::uint64_t i, unsigned thread) {
                BundleScratch::Thread& own = *scratch_.threads_[thread];
                own.lines = lines_along(static_cast<std::uint32_t>(i), own.scratch);
            },
            [&](std::uint64_t i, unsigned thread) {
                const LineHits& lines = scratch_.threads_[thread]->lines;
                // Each direction represents the solid angle 2 pi / n; the cosine law has a factor
                // of 1 / pi.
                const Beam beam{
                    bundle_direction(group_, static_cast<std::uint32_t>(i)),
                    2 * lines.line_area() / group_.directions};
                count(lines, beam);
                is_cached ? cache(lines, beam) : exchange_along(lines, beam);
            });
        exchange_cached();
        const double lines_per_area = group_.directions / (2 * group_.line_area);
        return {
            std::move(field_),
            LineStatistics{
                met_areas(scene_, found_areas_, lines_per_area), std::move(open_), segments_}};
    }

  private:
    using Beam = BundleScratch::Beam;
    [[nodiscard]] bool has_ends() const { return options_.skies != nullptr; }
    using Leaving = BundleScratch::Leaving;

    [[nodiscard]] LineHits lines_along(std::uint32_t i, LineHitScratch& scratch) const {
        return find_line_hits(
            scene_.projected, scene_.drawn,
            {.direction = bundle_direction(group_, i),
             .rotation = number_of(group_, i, 0),
             .shift_s = number_of(group_, i, 1),
             .shift_t = number_of(group_, i, 2),
             .line_area = group_.line_area},
            scratch);
    }

    void count(const LineHits& lines, const Beam& beam) {
        segments_ += lines.size();
        const std::span<const std::uint32_t> counts = lines.counts();
        EXPECT(counts.size() == found_areas_.size());
        for (std::size_t i = 0; i < counts.size(); ++i) {
            found_areas_[i] += beam.weight * counts[i];
        }
    }

    /// Exchanges light along lines, in one pack of bands.
    void exchange_along(const LineHits& lines, const Beam& beam) {
        clear(scratch_.leaving_, has_ends() ? lines.size() : 0);
        exchange_pack(lines, beam, {0, has_ends()}, scratch_.leaving_);
        report(beam, scratch_.leaving_);
    }

    void cache(const LineHits& lines, const Beam& beam) {
        if (scratch_.cache_.size() + lines.size() > kMaxCached) {
            exchange_cached();
        }
        scratch_.cache_.add(lines);
        scratch_.cached_beams_.push_back(beam);
    }

    /// Exchanges light along all lines of the cache, pack by pack, and clears it. The first pack
    /// lists the ends of lines, if they are requested.
    void exchange_cached() {
        const std::vector<std::size_t>& packs = field_.packs;
        const std::vector<Beam>& beams = scratch_.cached_beams_;
        std::vector<Leaving> leaving(beams.size());
        for (std::size_t i = 0; i < beams.size(); ++i) {
            clear(leaving[i], has_ends() ? scratch_.cache_.beam(i).size() : 0);
        }
        parallel_blocks(packs.size(), options_.threads, [&](std::uint64_t block, unsigned) {
            for (std::size_t i = 0; i < beams.size(); ++i) {
                const Pack pack{packs[block], has_ends() && block == 0};
                exchange_pack(scratch_.cache_.beam(i), beams[i], pack, leaving[i]);
            }
        });
        for (std::size_t i = 0; i < beams.size(); ++i) {
            report(beams[i], leaving[i]);
        }
        scratch_.cache_.clear();
        scratch_.cached_beams_.clear();
    }

    /// @param segments  among which the ends of lines are
    void clear(Leaving& leaving, std::size_t segments) const {
        leaving.forwards.assign(light_.bands(), 0);
        leaving.backwards.assign(light_.bands(), 0);
        leaving.ends.resize(std::max(leaving.ends.size(), segments));
        leaving.end_count = 0;
    }

    struct Pack {
        std::size_t index = 0;
        bool has_ends = false;
    };
    template <typename Lines>
    void exchange_pack(const Lines& lines, const Beam& beam, const Pack& pack, Leaving& leaving) {
        const PatchSides<0> sides = light_.sides(pack.index);
        const BandPack& bands = light_.packs()[pack.index];
        std::array<double, kMaxInPack> forwards{}, backwards{};
        std::uint32_t* const ends = pack.has_ends ? leaving.ends.data() : nullptr;
        const bool has_sensors = scene_.prepared.optics().has_transparent;
        for_bands(bands.bands, [&]<std::size_t kBands>() {
            LineExchange<kBands> along(sides, beam.weight, forwards, backwards, ends);
            lines.for_each_line([&](std::span<const LineHits::Hit> line) {
                has_sensors ? along.exchange_through_sensors(line) : along.exchange(line);
            });
            if (pack.has_ends) {
                leaving.end_count = static_cast<std::size_t>(along.ends() - ends);
            }
        });
        std::copy_n(forwards.begin(), bands.bands, &leaving.forwards[bands.first]);
        std::copy_n(backwards.begin(), bands.bands, &leaving.backwards[bands.first]);
    }

    void report(const Beam& beam, const Leaving& leaving) {
        if (options_.on_escape) {
            options_.on_escape(beam.direction, leaving.forwards);
            options_.on_escape(-1 * beam.direction, leaving.backwards);
        }
        const auto ends = std::span(leaving.ends).first(leaving.end_count);
        if (options_.skies != nullptr) {
            add_open_ends(
                scene_, ends, beam.weight * sky_weight(*options_.skies, -1 * beam.direction),
                open_);
        }
    }

    const BundleGroup& group_;
    const ExchangeOptions& options_;
    BundleScratch& scratch_;
    PatchField field_;
    PatchLight& light_;
    const PatchScene& scene_;
    std::vector<double> found_areas_;  // by surface
    OpenAreas open_;
    std::uint64_t segments_ = 0;
};

PatchIrradiance exchange(
    PatchExitance exitance,
    const BundleGroup& group,
    const ExchangeOptions& options,
    BundleScratch& scratch) {
    return BundleExchange(std::move(exitance), group, options, scratch).run();
}

}  // namespace quasimc
