// Lamps: sources at a finite distance.
//
// The flux of an opening is sampled as a point on it and a direction. Paths of light tracing start
// either by the lamp's pattern, or, for a lamp outside the bounding sphere of an open scene,
// uniformly in the cone that the sphere subtends at the point. Pilot starts on a fixed lattice show
// which of the two has the smaller variance; they also give flux(), which only scales the
// weights, so that its error cancels. Outside the scene's box, a path is moved on to its entry
// point: rays are cast in single precision about the scene.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/additive_recurrence.h"
#include "base/checks.h"
#include "light/models/lamp_body.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

/// A start of a path, weight relative to the whole flux of the lamp.
struct Start {
    Vec3 origin, direction;
    double weight = 0;
};

/// Draws the starts of paths.
class LampStarts {
  public:
    LampStarts(const LampBody& local_body, Pattern pattern, const SceneProjection& projection)
        : body_(local_body), pattern_(std::move(pattern)), box_(projection.entry_box().bounds) {
        const Cell& cell = projection.cell();
        open_x_ = !cell.along_x;
        open_y_ = !cell.along_y;
        ball_ = {box_.center(), 0.5 * length(box_.size())};
        const bool can_aim =
            !cell.periodic() && length(body_.center - ball_.center) > ball_.radius + body_.radius();
        choose(can_aim);
    }

    /// The fraction of the lamp's flux that paths carry; 0: no pilot start hits the scene.
    [[nodiscard]] double fraction() const { return fraction_; }
    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const {
        const Start start = is_aimed_ ? aimed(u) : by_pattern(u);
        return {entry(start).value_or(start.origin), start.direction, start.weight / fraction_};
    }

  private:
    /// The numbers that select the direction: the first two where the opening is a point.
    [[nodiscard]] std::array<double, 2> direction_numbers(const std::array<double, 4>& u) const {
        return body_.opening.kind == Opening::Kind::point ? std::array{u[0], u[1]}
                                                          : std::array{u[2], u[3]};
    }

    [[nodiscard]] Start by_pattern(const std::array<double, 4>& u) const {
        const LampBody::SurfacePoint start = body_.draw_point(u[0], u[1]);
        const auto [v0, v1] = direction_numbers(u);
        const Pattern::Drawn drawn = pattern_.draw(v0, v1);
        return {start.position, normalized(from_axes(start.axes, drawn.direction)), drawn.weight};
    }

    [[nodiscard]] Start aimed(const std::array<double, 4>& u) const {
        const LampBody::SurfacePoint start = body_.draw_point(u[0], u[1]);
        const auto [v0, v1] = direction_numbers(u);
        const Vec3 towards = ball_.center - start.position;
        const double distance = length(towards);
        const double t = cone_of_sphere(ball_.radius, distance);
        const Vec3 direction = normalized(direction_in_cone(towards / distance, v0 * t, v1));
        const double intensity = pattern_.intensity(to_axes(start.axes, direction));
        return {start.position, direction, intensity * 4 * std::numbers::pi * t};
    }

    /// The point where a path enters the box of the scene, or its origin if it starts inside;
    /// nothing if it misses. Along periodic axes the box is infinite.
    [[nodiscard]] std::optional<Vec3> entry(const Start& start) const {
        double enter = 0;
        double leave = std::numeric_limits<double>::infinity();
        const auto clip = [&](double from, double along, double low, double high) {
            if (along == 0) {
                leave = from < low || from > high ? -1 : leave;
                return;
            }
            const double a = (low - from) / along;
            const double b = (high - from) / along;
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        };
        const Vec3& o = start.origin;
        const Vec3& d = start.direction;
        if (open_x_) {
            clip(o.x, d.x, box_.low.x, box_.high.x);
        }
        if (open_y_) {
            clip(o.y, d.y, box_.low.y, box_.high.y);
        }
        clip(o.z, d.z, box_.low.z, box_.high.z);
        return leave < enter ? std::nullopt : std::optional(o + enter * d);
    }

    /// Estimates from the pilot starts of one kind.
    struct Pilot {
        double fraction = 0;  ///< mean weight
        double hits = 0;      ///< mean weight of those that hit the box
        double second = 0;    ///< mean square of these weights
    };
    template <typename Draw>
    [[nodiscard]] Pilot trial_of(const Draw& draw) const {
        constexpr int kTrials = 1 << 14;
        Pilot pilot;
        for (int i = 0; i < kTrials; ++i) {
            const Start start = draw(additive_recurrence_point(i));
            const double hit = entry(start) ? start.weight : 0;
            pilot.fraction += start.weight / kTrials;
            pilot.hits += hit / kTrials;
            pilot.second += hit * hit / kTrials;
        }
        return pilot;
    }

    /// Selects how paths start.
    void choose(bool can_aim) {
        const Pilot wide = trial_of([this](const auto& u) { return by_pattern(u); });
        fraction_ = wide.hits > 0 ? 1 : 0;
        if (!can_aim) {
            return;
        }
        const Pilot narrow = trial_of([this](const auto& u) { return aimed(u); });
        // Where the two disagree, the one with fewer hits has missed the light.
        constexpr double kAgree = 0.8;
        const bool is_missed = narrow.hits < kAgree * wide.hits;
        if (wide.hits == 0 || (!is_missed && narrow.second < wide.second)) {
            is_aimed_ = true;
            fraction_ = narrow.hits > 0 ? narrow.fraction : 0;
        }
    }

    LampBody body_;  // local coordinates
    Pattern pattern_;
    Bounds box_;
    bool open_x_ = true, open_y_ = true;
    BoundingSphere ball_;
    bool is_aimed_ = false;
    double fraction_ = 1;
};

class LampEmitter final : public SourceSampler {
  public:
    LampEmitter(LampStarts starts, const LampExtent& extent, double world_area)
        : SourceSampler(starts.fraction() / world_area),
          starts_(std::move(starts)),
          extent_(extent) {}

    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        return starts_.emit(u);
    }
    [[nodiscard]] std::optional<LampExtent> lamp_extent() const override { return extent_; }

  private:
    LampStarts starts_;
    LampExtent extent_;
};

class Lamp final : public SourceModel {
  public:
    explicit Lamp(LampSpec spec)
        : SourceModel(
              std::move(spec.name),
              std::move(spec.flux),
              kLampTraits,
              std::numeric_limits<double>::quiet_NaN()),
          body_{spec.position, spec.axes, spec.opening},
          pattern_(std::move(spec.pattern)),
          by_area_(has_unbounded_radiance()) {}

    [[nodiscard]] ModelParameters parameters() const override {
        ModelParameters lamp{"lamp", pattern_.parameters()};
        for (const Vec3& v : {body_.center, body_.axes.s, body_.axes.t, body_.axes.n}) {
            lamp.values.insert(lamp.values.end(), {v.x, v.y, v.z});
        }
        const Opening& opening = body_.opening;
        lamp.values.insert(
            lamp.values.end(),
            {static_cast<double>(opening.kind), opening.length, opening.width, opening.radius});
        return lamp;
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        LampBody local = body_;
        local.center = projection.to_local(body_.center);
        local.opening.length *= projection.scale();
        local.opening.width *= projection.scale();
        local.opening.radius *= projection.scale();
        const bool is_bounded = body_.opening.kind != Opening::Kind::point &&
                                body_.opening.kind != Opening::Kind::disk && !by_area_;
        const Vec3 half_line = body_.opening.kind == Opening::Kind::line
                                   ? 0.5 * local.opening.length * local.axes.n
                                   : Vec3{};
        auto sampler = std::make_unique<LampEmitter>(
            LampStarts(local, pattern_, projection),
            LampExtent{{local.center, local.radius()}, is_bounded, half_line},
            projection.world_area());
        return sampler->flux() > 0 ? std::move(sampler) : nullptr;
    }
    [[nodiscard]] Illumination illuminate(const Vec3& point, double u0, double u1) const override {
        const LampBody::LampSample seen =
            by_area_ ? body_.seen_by_area(point, u0, u1) : body_.seen_from(point, u0, u1);
        if (seen.factor == 0) {
            return {axis_back(), 0};
        }
        const double intensity = pattern_.intensity(to_axes(seen.axes, -seen.to_light));
        return {seen.to_light, intensity * seen.factor, seen.distance};
    }
    [[nodiscard]] double radiance(const Vec3&) const override { return 0; }

  private:
    [[nodiscard]] Vec3 axis_back() const { return -body_.axes.n; }

    /// Whether a flat opening emits sideways, so that its radiance there has no upper bound.
    [[nodiscard]] bool has_unbounded_radiance() const {
        constexpr int kAzimuths = 16;
        const double peak = pattern_.intensity({0, 0, 1});
        for (int i = 0; i < kAzimuths; ++i) {
            const double phi = 2 * std::numbers::pi * i / kAzimuths;
            if (pattern_.intensity({std::cos(phi), std::sin(phi), 0}) > 1e-9 * peak) {
                return body_.opening.kind == Opening::Kind::rectangle;
            }
        }
        return false;
    }

    LampBody body_;
    Pattern pattern_;
    bool by_area_;
};

}  // namespace

std::shared_ptr<const Source> make_lamp(LampSpec spec) {
    EXPECT(is_finite(spec.position));
    return std::make_shared<Lamp>(std::move(spec));
}

Frame lamp_axes(const Vec3& aim, const Vec3& along) {
    const Vec3 n = normalized(aim);
    const Vec3 across = along - dot(along, n) * n;
    constexpr double kParallel = 1e-9;
    if (length(across) <= kParallel * length(along)) {
        return frame_about(n);
    }
    const Vec3 s = normalized(across);
    return {s, cross(n, s), n};
}

}  // namespace quasimc
