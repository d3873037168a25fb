#include "solvers/ray_bundles/bright_spots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "optics/directions.h"
#include "samplers/hash.h"
#include "solvers/direct/visibility.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// A spot is brighter than the mean of what its side sees by more than this factor.
constexpr double kBrighter = 4;
/// The minimum surrounded fraction of a side with spots.
constexpr double kSurrounded = 0.25;
/// Pairs of points: this part of the paths, and limits for each spot.
constexpr double kPairsPerPath = 0.25, kMinPairs = 1, kMaxPairs = 256;
/// Rays that leave each point of a pair of which one point is lit.
constexpr int kRays = 4;
/// Points drawn to find one on a cut patch, which is a part of four patches or more.
constexpr int kMaxTries = 256;

/// A sequence of random numbers.
class Numbers {
  public:
    explicit Numbers(std::uint64_t key) : key_(key) {}
    double next() { return unit_number(mix64(key_ ^ mix64(++count_))); }

  private:
    std::uint64_t key_, count_ = 0;
};

/// A bright patch of a triangle.
struct Spot {
    const PatchScene::Surface* surface = nullptr;
    std::uint32_t patch = 0;  ///< in the triangle
};

/// Finds spots.
class SpotFinder {
  public:
    explicit SpotFinder(PatchIrradiance& irradiance)
        : irradiance_(irradiance),
          scene_(irradiance.light->scene()),
          seen_(2 * scene_.region_areas.size()) {
        for (const PatchScene::Surface& surface : scene_.surfaces) {
            add_seen(surface);
        }
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            const double met = irradiance.lines->areas.found[i / 2];
            const double surrounded = met - irradiance.lines->ended[i];
            seen_[i] = seen_[i] > 0 && surrounded > kSurrounded * met
                           ? seen_[i] / surrounded
                           : std::numeric_limits<double>::infinity();
        }
    }

    [[nodiscard]] std::vector<Spot> find() const {
        std::vector<Spot> spots;
        for (const PatchScene::Surface& surface : scene_.surfaces) {
            const std::uint32_t first = scene_.patches.first(surface.triangle);
            const std::uint32_t end = scene_.patches.first(surface.triangle + 1);
            for (std::uint32_t i = 0; i < end - first && !surface.is_sensor; ++i) {
                if (is_bright(surface, i) && scene_.patches.share(surface.triangle, i) > 0) {
                    spots.push_back({&surface, i});
                }
            }
        }
        return spots;
    }

  private:
    /// Sums light of a patch's side over all bands.
    template <typename Of>
    [[nodiscard]] double sum(const Of& of) const {
        double all = 0;
        for (std::size_t pack = 0; pack < irradiance_.light->packs().size(); ++pack) {
            const PatchSides<0> sides = irradiance_.light->sides(pack);
            const double* numbers = of(sides);
            for (std::size_t b = 0; b < sides.columns(); ++b) {
                all += numbers[b];
            }
        }
        return all;
    }

    void add_seen(const PatchScene::Surface& surface) {
        const std::size_t end = std::size_t{2} * scene_.patches.first(surface.triangle + 1);
        for (std::size_t s = std::size_t{2} * scene_.patches.first(surface.triangle); s < end;
             ++s) {
            seen_[2 * std::size_t{surface.region} + s % 2] +=
                sum([&](const PatchSides<0>& sides) { return sides.incident(s); });
        }
    }

    [[nodiscard]] bool is_bright(const PatchScene::Surface& surface, std::uint32_t own) const {
        const std::size_t patch = scene_.patches.first(surface.triangle) + own;
        for (std::size_t side = 0; side < 2; ++side) {
            const double sent =
                sum([&](const PatchSides<0>& sides) { return sides.exitance(2 * patch + side); });
            if (sent > kBrighter * seen_[2 * std::size_t{surface.region} + side]) {
                return true;
            }
        }
        return false;
    }

    PatchIrradiance& irradiance_;
    const PatchScene& scene_;
    /// By 2 * region + side: mean exitance of the surfaces that the side sees; infinite for sides
    /// that see hardly any.
    std::vector<double> seen_;
};

/// Traces the light of spots.
class SpotTracer {
  public:
    SpotTracer(
        const PreparedScene& prepared, double paths, std::uint64_t key, PatchIrradiance& irradiance)
        : prepared_(prepared),
          mesh_(prepared.caster().mesh()),
          paths_(paths),
          numbers_(key),
          light_(*irradiance.light),
          scene_(light_.scene()),
          weights_(prepared.bands()) {
        found_.on_regions.resize(2 * scene_.region_areas.size() * prepared.bands());
    }

    SpotLight trace(const std::vector<Spot>& spots) {
        const double most = kPairsPerPath * paths_ / static_cast<double>(spots.size());
        const double pairs = std::clamp(std::ceil(most), kMinPairs, kMaxPairs);
        for (const Spot& spot : spots) {
            const ConvexPiece within = corners_about(spot);
            for (int i = 0; i < pairs; ++i) {
                trace_pair(spot, within, 1 / pairs);
            }
        }
        return std::move(found_);
    }

  private:
    /// Two points of a triangle.
    struct Pair {
        std::uint32_t triangle;
        std::array<Vec3, 2> points;
        Vec3 up;  // unit normal of the upper side
    };
    /// Light from one direction: as a number of paths per area across it.
    struct Incoming {
        const BoundSource* light;
        Vec3 direction;
        double paths;
    };

    /// A uniform point of a triangle, by its corners.
    Point2 point_in(const ConvexPiece& corners) {
        double s = numbers_.next();
        double t = numbers_.next();
        if (s + t > 1) {
            s = 1 - s;
            t = 1 - t;
        }
        const Point2 &a = corners[0], &b = corners[1], &c = corners[2];
        return {a.s + s * (b.s - a.s) + t * (c.s - a.s), a.t + s * (b.t - a.t) + t * (c.t - a.t)};
    }

    /// The corners of a spot, or of the triangle in which a cut one lies.
    [[nodiscard]] ConvexPiece corners_about(const Spot& spot) const {
        const int level = scene_.patches.level(spot.surface->triangle);
        const CutTriangle* cut = scene_.patches.cut_of(spot.surface->triangle);
        return cut == nullptr ? TriangleParts(level).corners(spot.patch)
                              : TriangleParts(level - 1).corners(cut->parent(spot.patch));
    }

    /// A uniform point of a spot; none if its patch is too small a piece to be found.
    /// @param within  corners_about() it
    std::optional<Vec3> point_on(const Spot& spot, const ConvexPiece& within) {
        const std::uint32_t triangle = spot.surface->triangle;
        const bool is_cut = scene_.patches.cut_of(triangle) != nullptr;
        const std::uint32_t patch = scene_.patches.first(triangle) + spot.patch;
        for (int i = 0; i < kMaxTries; ++i) {
            const Point2 at = point_in(within);
            if (!is_cut || scene_.patches.at(triangle, at.s, at.t) == patch) {
                return mesh_.point(triangle, at.s, at.t);
            }
        }
        return {};
    }

    /// Light of a sun or sky, drawn in proportion to the paths of the sources; none from lamps.
    std::optional<Incoming> incoming() {
        const std::array<double, 3> u{numbers_.next(), numbers_.next(), numbers_.next()};
        const BoundSource& light = prepared_.lights()[prepared_.lights().pick(u[0]).index];
        if (light.source->is_lamp()) {
            return {};
        }
        const double per_area = paths_ / light.source_sampler->flux();
        if (const auto& beam = light.source_sampler->beam_direction()) {
            return Incoming{&light, *beam, per_area};
        }
        const DirectionSample from = light.source_sampler->draw_direction(u[1], u[2]);
        const double radiance = model_of(*light.source).radiance(-from.direction);
        return Incoming{&light, from.direction, per_area * radiance / from.density};
    }

    bool is_lit(std::uint32_t triangle, const Vec3& point, const Vec3& direction) {
        ++found_.rays;
        constexpr double kFarAway = std::numeric_limits<double>::infinity();
        return is_visible_source(prepared_, point, -direction, kFarAway, triangle);
    }

    /// @param share  of the spot's light that the pair represents
    void trace_pair(const Spot& spot, const ConvexPiece& within, double share) {
        const std::uint32_t triangle = spot.surface->triangle;
        const std::optional<Vec3> first = point_on(spot, within), second = point_on(spot, within);
        const std::optional<Incoming> in = incoming();
        if (!in || !first || !second) {
            return;
        }
        const Pair pair{triangle, {*first, *second}, normalized(mesh_.across(triangle))};
        const bool is_first = is_lit(triangle, pair.points[0], in->direction);
        if (is_first == is_lit(triangle, pair.points[1], in->direction)) {
            return;
        }
        const double along = dot(pair.up, in->direction);
        const double area = spot.surface->area * scene_.patches.share(triangle, spot.patch);
        // Half, for each of the points may be the lit one.
        const double amount = (is_first ? .5 : -.5) * share * area * std::abs(along) * in->paths;
        const SurfaceSide lit = along > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        const PatchOptics& optics = scene_.of(spot.surface->material, lit);
        for (int i = 0; i < kRays; ++i) {
            const bool is_reflected = choose_side(optics, *in->light, amount / kRays);
            send(pair, (lit == SurfaceSide::upper) == is_reflected ? pair.up : -pair.up);
        }
    }

    /// Sets the weights of a ray that is reflected or transmitted. @returns whether it is reflected
    bool choose_side(const PatchOptics& optics, const BoundSource& light, double amount) {
        double reflected = 0;
        double all = 0;
        for (std::size_t b = 0; b < weights_.size(); ++b) {
            reflected += light.start_weights[b] * optics.reflected[b];
            all += light.start_weights[b] * (optics.reflected[b] + optics.transmitted[b]);
        }
        const double chance = all > 0 ? reflected / all : 1;
        const bool is_reflected = numbers_.next() < chance;
        for (std::size_t b = 0; b < weights_.size(); ++b) {
            const double part =
                is_reflected ? optics.reflected[b] / chance : optics.transmitted[b] / (1 - chance);
            weights_[b] = amount * light.start_weights[b] * part;
        }
        return is_reflected;
    }

    /// Sends the weights from the first point, and takes them from the second.
    void send(const Pair& pair, const Vec3& normal) {
        const double turn = numbers_.next();
        const Vec3 direction = cosine_direction(normal, numbers_.next(), turn);
        trace_ray(pair.points[0], pair.triangle, direction, 1);
        trace_ray(pair.points[1], pair.triangle, direction, -1);
    }

    void trace_ray(Vec3 origin, std::uint32_t self, const Vec3& direction, double sign) {
        for (;;) {
            ++found_.rays;
            const CastHit at = prepared_.caster().cast(origin, direction, self);
            if (at.end != RayEnd::hit) {
                found_.escaped.push_back({direction, std::vector<double>(weights_.size())});
                add(sign, weights_, found_.escaped.back().flux.data());
                return;
            }
            const Surface surface = surface_at(prepared_, at.hit, direction);
            if (prepared_.fields_of_view().contain(surface.region, surface.cosine)) {
                const std::size_t i = 2 * std::size_t{surface.region} + index_of(surface.side);
                add(sign, weights_, &found_.on_regions[i * weights_.size()]);
            }
            if (!prepared_.material(surface.region).is_transparent()) {
                deposit(at.hit, surface, sign);
                return;
            }
            origin = point_of(prepared_, at.hit);
            self = surface.triangle;
        }
    }

    void deposit(const Hit& hit, const Surface& surface, double sign) {
        const std::size_t patch =
            scene_.patches.at(scene_.representative(surface.triangle), hit.u, hit.v);
        for (std::size_t pack = 0; pack < light_.packs().size(); ++pack) {
            const BandPack& bands = light_.packs()[pack];
            add(sign, std::span(weights_).subspan(bands.first, bands.bands),
                light_.sides(pack).incident(2 * patch + index_of(surface.side)));
        }
    }

    static void add(double sign, std::span<const double> weights, double* to) {
        for (std::size_t b = 0; b < weights.size(); ++b) {
            to[b] += sign * weights[b];
        }
    }

    const PreparedScene& prepared_;
    const LocalMesh& mesh_;
    double paths_;
    Numbers numbers_;
    PatchLight& light_;
    const PatchScene& scene_;
    std::vector<double> weights_;  // of a ray, per band
    SpotLight found_;
};

}  // namespace

SpotLight trace_bright_spots(
    const PreparedScene& prepared, double paths, std::uint64_t key, PatchIrradiance& irradiance) {
    const std::vector<Spot> spots = SpotFinder(irradiance).find();
    return spots.empty() ? SpotLight{} : SpotTracer(prepared, paths, key, irradiance).trace(spots);
}

}  // namespace quasimc
