#include "view/render.h"

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
constexpr std::size_t kTile = 4;  // pixels along a side of what is looked at together
static_assert(kTile * kTile == kPacket);

/// What a line of sight meets.
struct Sight {
    std::uint32_t organ = kNothing;
    float facing = 1;  // cosine between normal and line of sight

    /// Whether it looks like what the next pixel sees, so that nothing can be missed between them.
    [[nodiscard]] bool is_like(const Sight& other) const {
        return organ == other.organ && std::abs(facing - other.facing) < 0.1F;
    }
};

class Renderer {
  public:
    Renderer(const Scene& scene, const Camera& camera, const RenderSpec& spec)
        : scene_(scene),
          spec_(spec),
          sight_caster_(scene, camera, spec.cuts),
          sights_(spec.width * spec.height) {}

    Image image() {
        const unsigned threads = thread_count(spec_.threads);
        parallel_blocks((spec_.height + kTile - 1) / kTile, threads, [this](auto row, unsigned) {
            for (std::size_t x = 0; x < spec_.width; x += kTile) {
                look_at_tile(x, kTile * row);
            }
        });
        Image image(spec_.width, spec_.height, spec_.background);
        parallel_blocks(spec_.height, threads, [&](std::uint64_t y, unsigned) {
            std::vector<std::size_t> edges;
            for (std::size_t x = 0; x < spec_.width; ++x) {
                image.at(x, y) = color(sight(x, y));
                if (is_edge(x, y)) {
                    edges.push_back(x);
                }
            }
            smooth(edges, y, image);
        });
        return image;
    }

  private:
    static PixelPlace center(std::size_t x, std::size_t y) {
        return {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
    }
    Sight& sight(std::size_t x, std::size_t y) { return sights_[y * spec_.width + x]; }

    [[nodiscard]] Sight sight_of(const std::optional<SeenHit>& seen) const {
        if (!seen) {
            return {};
        }
        const Vec3 normal{seen->hit.normal[0], seen->hit.normal[1], seen->hit.normal[2]};
        const double facing = std::abs(dot(normalized(normal), seen->direction));
        return {scene_.regions()[seen->region].organ.value, static_cast<float>(facing)};
    }

    /// Looks at a square of pixels, or what of it lies in the picture.
    void look_at_tile(std::size_t left, std::size_t top) {
        std::array<PixelPlace, kPacket> places;
        std::array<Sight*, kPacket> sights{};
        std::size_t count = 0;
        for (std::size_t y = top; y < std::min(top + kTile, spec_.height); ++y) {
            for (std::size_t x = left; x < std::min(left + kTile, spec_.width); ++x) {
                places[count] = center(x, y);
                sights[count++] = &sight(x, y);
            }
        }
        const auto seen = sight_caster_.look(std::span(places).first(count));
        for (std::size_t i = 0; i < count; ++i) {
            *sights[i] = sight_of(seen[i]);
        }
    }

    bool is_edge(std::size_t x, std::size_t y) {
        const Sight& own = sight(x, y);
        return (x > 0 && !own.is_like(sight(x - 1, y))) ||
               (y > 0 && !own.is_like(sight(x, y - 1))) ||
               (x + 1 < spec_.width && !own.is_like(sight(x + 1, y))) ||
               (y + 1 < spec_.height && !own.is_like(sight(x, y + 1)));
    }

    [[nodiscard]] Rgb color(const Sight& seen) const {
        if (seen.organ == kNothing) {
            return spec_.background;
        }
        return mixed(spec_.colors[seen.organ], Rgb{}, spec_.shading * (1 - double{seen.facing}));
    }

    /// Gives pixels of a row the mean of their middle and four places about it, a rotated grid.
    void smooth(std::span<const std::size_t> row, std::size_t y, Image& image) {
        constexpr std::array<PixelPlace, 4> kAbout{
            {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}}};
        constexpr std::size_t kPixels = kPacket / kAbout.size();
        for (std::size_t first = 0; first < row.size(); first += kPixels) {
            const auto pixels = row.subspan(first, std::min(kPixels, row.size() - first));
            std::vector<PixelPlace> places;
            for (const std::size_t x : pixels) {
                for (const PixelPlace& step : kAbout) {
                    places.push_back({center(x, y).x + step.x, center(x, y).y + step.y});
                }
            }
            const auto seen = sight_caster_.look(places);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                std::array<Rgb, 1 + kAbout.size()> colors{color(sight(pixels[i], y))};
                for (std::size_t k = 0; k < kAbout.size(); ++k) {
                    colors[k + 1] = color(sight_of(seen[kAbout.size() * i + k]));
                }
                image.at(pixels[i], y) = mean(colors);
            }
        }
    }

    /// As light mixes: the square of a channel is nearly its light.
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
    SightCaster sight_caster_;
    std::vector<Sight> sights_;
};

}  // namespace

Bounds shown_bounds(const Scene& scene, const std::vector<CutPlane>& cuts) {
    // Planes along axes cut the box; others leave it as it is.
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
