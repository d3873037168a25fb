#include "solvers/ray_bundles/near_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "optics/directions.h"
#include "samplers/hash.h"
#include "solvers/direct/visibility.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// The minimum part of the light of a side that comes from near, for this to be corrected.
constexpr double kMinNear = 0.5;
/// Pairs of points: this number times the root of the paths, and at least and at most for each side
/// of a patch.
constexpr double kPairsPerRoot = 64, kMinPairs = 1. / 8, kMaxPairs = 256;
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

/// A side of a patch whose light is corrected.
struct NearSide {
    const PatchScene::Surface* surface = nullptr;
    std::uint32_t side = 0;  ///< 2 * patch + side
    double area = 0;
    double until = 0;  ///< the light that leaves all of them up to this one, over all bands
};

/// Finds the sides that send others much of their light from near.
class NearSides {
  public:
    NearSides(const NearLines& near, PatchLight& light)
        : near_(near), light_(light), scene_(light.scene()) {}

    /// Sides of regions that receive much of their light from near, by 2 * region + side.
    [[nodiscard]] std::vector<bool> lit_from_near() const {
        std::vector<double> all(2 * scene_.region_areas.size()), near(all.size());
        for (std::uint32_t side = 0; side < 2 * scene_.patches.count(); ++side) {
            all[2 * scene_.region_of_patch[side / 2] + side % 2] += incident(side);
        }
        for (const NearLine& line : near_.lines) {
            near[line.to] += line.weight * exitance(line.from);
        }
        std::vector<bool> is_lit;
        for (std::size_t i = 0; i < all.size(); ++i) {
            is_lit.push_back(near[i] > kMinNear * all[i]);
        }
        return is_lit;
    }

    /// The sides that send light to these.
    [[nodiscard]] std::vector<NearSide> find(const std::vector<bool>& lit_from_near) const {
        std::vector<bool> is_near(2 * near_.groups.size());
        for (const NearLine& line : near_.lines) {
            if (lit_from_near[line.to]) {
                is_near[group_of(line.from)] = true;
            }
        }
        std::vector<NearSide> found;
        double until = 0;
        for (const PatchScene::Surface& surface : scene_.surfaces) {
            const std::uint32_t first = 2 * scene_.patches.first(surface.triangle);
            const std::uint32_t end = 2 * scene_.patches.first(surface.triangle + 1);
            for (std::uint32_t side = first; side < end && !surface.is_sensor; ++side) {
                const double sent = is_near[group_of(side)] ? exitance(side) : 0;
                if (sent > 0) {
                    const double share = scene_.patches.share(surface.triangle, (side - first) / 2);
                    const double area = surface.area * share;
                    until += sent * area;
                    found.push_back({&surface, side, area, until});
                }
            }
        }
        return found;
    }

  private:
    [[nodiscard]] std::size_t group_of(std::uint32_t side) const {
        return std::size_t{2} * near_.groups[side / 2] + side % 2;
    }

    /// Sums over all bands.
    [[nodiscard]] double exitance(std::uint32_t side) const {
        return sum([&](const PatchSides<0>& sides) { return sides.exitance(side); });
    }
    [[nodiscard]] double incident(std::uint32_t side) const {
        return sum([&](const PatchSides<0>& sides) { return sides.incident(side); });
    }
    template <typename Of>
    [[nodiscard]] double sum(const Of& of) const {
        double all = 0;
        for (std::size_t pack = 0; pack < light_.packs().size(); ++pack) {
            const PatchSides<0> sides = light_.sides(pack);
            const double* numbers = of(sides);
            all = std::accumulate(numbers, numbers + sides.columns(), all);
        }
        return all;
    }

    const NearLines& near_;
    PatchLight& light_;
    const PatchScene& scene_;
};

/// Traces pairs of points on near sides.
class PairTracer {
  public:
    PairTracer(
        const PreparedScene& prepared,
        const std::vector<bool>& lit_from_near,
        double paths,
        std::uint64_t key,
        PatchLight& light)
        : prepared_(prepared),
          lit_from_near_(lit_from_near),
          mesh_(prepared.caster().mesh()),
          paths_(paths),
          numbers_(key),
          light_(light),
          scene_(light.scene()),
          weights_(scene_.bands.count()) {
        found_.on_regions.resize(2 * scene_.region_areas.size() * weights_.size());
    }

    /// Pairs are shared among the sides in proportion to the light that leaves them.
    NearLight trace(std::span<const NearSide> near) {
        const double all = near.back().until;
        const auto sides = static_cast<double>(near.size());
        const double pairs = std::ceil(
            std::clamp(kPairsPerRoot * std::sqrt(paths_), kMinPairs * sides, kMaxPairs * sides));
        const double shift = numbers_.next();
        std::size_t i = 0;
        for (double n = 0; n < pairs; ++n) {
            while (i + 1 < near.size() && near[i].until <= (n + shift) / pairs * all) {
                ++i;
            }
            const double own = near[i].until - (i > 0 ? near[i - 1].until : 0);
            trace_pair(near[i], all / (pairs * own));
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

    /// The corners of a patch, or of the triangle in which a cut one lies.
    [[nodiscard]] ConvexPiece corners_about(const NearSide& side) const {
        const std::uint32_t triangle = side.surface->triangle;
        const std::uint32_t patch = side.side / 2 - scene_.patches.first(triangle);
        const int level = scene_.patches.level(triangle);
        const CutTriangle* cut = scene_.patches.cut_of(triangle);
        return cut == nullptr ? TriangleParts(level).corners(patch)
                              : TriangleParts(level - 1).corners(cut->parent(patch));
    }

    /// A uniform point of a patch; none if it is too small a piece to be found.
    /// @param within  corners_about() it
    std::optional<Vec3> point_on(const NearSide& side, const ConvexPiece& within) {
        const std::uint32_t triangle = side.surface->triangle;
        const bool is_cut = scene_.patches.cut_of(triangle) != nullptr;
        const std::uint32_t patch = side.side / 2;
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

    /// @param share  of the light of the side that the pair represents
    void trace_pair(const NearSide& side, double share) {
        const ConvexPiece within = corners_about(side);
        const std::uint32_t triangle = side.surface->triangle;
        const std::optional<Vec3> first = point_on(side, within), second = point_on(side, within);
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
        // Half, for each of the points may be the lit one.
        const double amount =
            (is_first ? .5 : -.5) * share * side.area * std::abs(along) * in->paths;
        const SurfaceSide lit = along > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        const PatchOptics& optics = scene_.of(side.surface->material, lit);
        // Light that leaves the other side may not be near.
        const bool is_reflected = index_of(lit) == side.side % 2;
        const std::vector<double>& scattered = is_reflected ? optics.reflected : optics.transmitted;
        weights_ = scene_.bands.weights_of(*in->light);
        for (std::size_t c = 0; c < weights_.size(); ++c) {
            weights_[c] = amount / kRays * weights_[c] * scattered[c];
        }
        for (int i = 0; i < kRays; ++i) {
            send(pair, side.side % 2 == 0 ? pair.up : -pair.up);
        }
    }

    /// Sends the weights from the first point, and takes them from the second, unless neither goes
    /// to a side that receives much light from near: the patch may send others its mean.
    void send(const Pair& pair, const Vec3& normal) {
        const double turn = numbers_.next();
        const Vec3 direction = cosine_direction(normal, numbers_.next(), turn);
        const std::array<CastHit, 2> ends{
            cast(pair.points[0], direction, pair.triangle),
            cast(pair.points[1], direction, pair.triangle)};
        const double near = near_distance(scene_, scene_.representative(pair.triangle));
        if (is_near(ends[0], direction, near) || is_near(ends[1], direction, near)) {
            follow(ends[0], direction, 1);
            follow(ends[1], direction, -1);
        }
    }

    /// Whether a ray ends within a distance on a side that receives much light from near.
    [[nodiscard]] bool is_near(const CastHit& at, const Vec3& direction, double distance) const {
        if (at.end != RayEnd::hit || !(at.hit.t < distance)) {
            return false;
        }
        const Surface surface = surface_at(prepared_, at.hit, direction);
        return lit_from_near_[std::size_t{2} * surface.region + index_of(surface.side)];
    }

    CastHit cast(const Vec3& origin, const Vec3& direction, std::uint32_t self) {
        ++found_.rays;
        return prepared_.caster().cast(origin, direction, self);
    }

    /// Follows a ray from its first end through sensors, and adds the weights where it arrives.
    void follow(CastHit at, const Vec3& direction, double sign) {
        for (;;) {
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
            at = cast(point_of(prepared_, at.hit), direction, surface.triangle);
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
    const std::vector<bool>& lit_from_near_;  // by 2 * region + side
    const LocalMesh& mesh_;
    double paths_;
    Numbers numbers_;
    PatchLight& light_;
    const PatchScene& scene_;
    std::vector<double> weights_;  // of a ray, per column
    NearLight found_;
};

}  // namespace

NearLight trace_near_light(
    const PreparedScene& prepared,
    const NearLines& lines,
    double paths,
    std::uint64_t key,
    PatchLight& light) {
    const NearSides sides(lines, light);
    const std::vector<bool> lit_from_near = sides.lit_from_near();
    const std::vector<NearSide> near = sides.find(lit_from_near);
    return near.empty() ? NearLight{}
                        : PairTracer(prepared, lit_from_near, paths, key, light).trace(near);
}

}  // namespace quasimc
