#include "picture/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/checks.h"
#include "base/parallel.h"
#include "base/vec3.h"

namespace quasimc {
namespace {

constexpr std::uint32_t kNothing = 0xFFFFFFFFU;

/// The hit of a camera ray.
struct PixelHit {
    std::uint32_t organ = kNothing;
    float facing = 1;  // cosine between normal and camera ray

    /// Whether it resembles the next pixel, so that nothing can be missed between them.
    [[nodiscard]] bool is_like(const PixelHit& other) const {
        return organ == other.organ && std::abs(facing - other.facing) < 0.1F;
    }
};

class Renderer {
  public:
    Renderer(const Scene& scene, const Camera& camera, const RenderSpec& spec)
        : scene_(scene),
          spec_(spec),
          sight_caster_(scene, camera, spec.cuts),
          hits_(spec.width * spec.height) {}

    Image image() {
        const unsigned threads = thread_count(spec_.threads);
        parallel_blocks(spec_.height, threads, [this](std::uint64_t y, unsigned) {
            for (std::size_t x = 0; x < spec_.width; ++x) {
                hit_at(x, y) = trace(center(x, y));
            }
        });
        Image image(spec_.width, spec_.height, spec_.background);
        parallel_blocks(spec_.height, threads, [&](std::uint64_t y, unsigned) {
            for (std::size_t x = 0; x < spec_.width; ++x) {
                image.at(x, y) = is_edge(x, y) ? smooth_color(x, y) : color(hit_at(x, y));
            }
        });
        return image;
    }

  private:
    static PixelPoint center(std::size_t x, std::size_t y) {
        return {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
    }
    PixelHit& hit_at(std::size_t x, std::size_t y) { return hits_[y * spec_.width + x]; }

    [[nodiscard]] PixelHit trace(const PixelPoint& pixel) const {
        const std::optional<PrimaryHit> seen = sight_caster_.trace(pixel);
        if (!seen) {
            return {};
        }
        const Vec3 normal{seen->hit.normal[0], seen->hit.normal[1], seen->hit.normal[2]};
        const double facing = std::abs(dot(normalized(normal), seen->direction));
        return {scene_.regions()[seen->region].organ.value, static_cast<float>(facing)};
    }

    bool is_edge(std::size_t x, std::size_t y) {
        const PixelHit& own = hit_at(x, y);
        return (x > 0 && !own.is_like(hit_at(x - 1, y))) ||
               (y > 0 && !own.is_like(hit_at(x, y - 1))) ||
               (x + 1 < spec_.width && !own.is_like(hit_at(x + 1, y))) ||
               (y + 1 < spec_.height && !own.is_like(hit_at(x, y + 1)));
    }

    [[nodiscard]] Rgb color(const PixelHit& seen) const {
        if (seen.organ == kNothing) {
            return spec_.background;
        }
        return mixed(spec_.colors[seen.organ], Rgb{}, spec_.shading * (1 - double{seen.facing}));
    }

    /// The mean over the centre of a pixel and four points about it, a rotated grid.
    Rgb smooth_color(std::size_t x, std::size_t y) {
        constexpr std::array<PixelPoint, 4> kAbout{
            {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}}};
        std::array<Rgb, 1 + kAbout.size()> colors{color(hit_at(x, y))};
        for (std::size_t k = 0; k < kAbout.size(); ++k) {
            const PixelPoint at = center(x, y);
            colors[k + 1] = color(trace({at.x + kAbout[k].x, at.y + kAbout[k].y}));
        }
        return mean(colors);
    }

    /// Mean in linear light: the square of a channel is nearly its light.
    static Rgb mean(std::span<const Rgb> colors) {
        std::array<double, 3> sum{};
        for (const Rgb& c : colors) {
            sum[0] += 1.0 * c.r * c.r;
            sum[1] += 1.0 * c.g * c.g;
            sum[2] += 1.0 * c.b * c.b;
        }
        const auto channel = [&colors](double total) {
            const double square = total / static_cast<double>(colors.size());
            return static_cast<std::uint8_t>(std::lround(std::sqrt(square)));
        };
        return {channel(sum[0]), channel(sum[1]), channel(sum[2])};
    }

    const Scene& scene_;
    const RenderSpec& spec_;
    CameraRayCaster sight_caster_;
    std::vector<PixelHit> hits_;
};

}  // namespace

Bounds shown_bounds(const Scene& scene, const std::vector<CutPlane>& cuts) {
    // Clipping planes along axes reduce the box; others do not.
    Bounds box = scene.bounds();
    const auto cut = [](double normal, double other, double offset, double& low, double& high) {
        if (other == 0 && normal > 0) {
            high = std::min(high, offset / normal);
        } else if (other == 0 && normal < 0) {
            low = std::max(low, offset / normal);
        }
    };
    for (const CutPlane& plane : cuts) {
        const Vec3& n = plane.normal;
        cut(n.x, std::abs(n.y) + std::abs(n.z), plane.offset, box.low.x, box.high.x);
        cut(n.y, std::abs(n.x) + std::abs(n.z), plane.offset, box.low.y, box.high.y);
        cut(n.z, std::abs(n.x) + std::abs(n.y), plane.offset, box.low.z, box.high.z);
    }
    const bool is_empty =
        box.low.x > box.high.x || box.low.y > box.high.y || box.low.z > box.high.z;
    return is_empty ? Bounds{} : box;
}

Image render(const Scene& scene, const Camera& camera, const RenderSpec& spec) {
    EXPECT(spec.colors.size() == scene.organs().size());
    return Renderer(scene, camera, spec).image();
}

}  // namespace quasimc
