#include "picture/true_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/additive_recurrence.h"
#include "base/checks.h"
#include "base/parallel.h"
#include "base/vec3.h"
#include "light/daylight/daylight.h"
#include "light/daylight/spectrum.h"
#include "light/models/source.h"
#include "optics/material.h"
#include "picture/camera_ray_caster.h"
#include "samplers/hash.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

LinearRgb& operator+=(LinearRgb& sum, const LinearRgb& more) {
    for (std::size_t c = 0; c < sum.size(); ++c) {
        sum[c] += more[c];
    }
    return sum;
}

double overlap(double from, double to, double low, double high) {
    return std::max(0.0, std::min(to, high) - std::max(from, low));
}

/// Reflectance and transmittance of a Lambertian surface, per band and side of incidence.
struct DiffuseSide {
    std::vector<double> reflected, transmitted;
};

DiffuseSide matt_side(const Side& side, std::size_t bands) {
    DiffuseSide diffuse{std::vector<double>(bands), std::vector<double>(bands)};
    for (const Lobe& lobe : side.lobes()) {
        auto& sum = lobe.shape->hemisphere() == Hemisphere::reflected ? diffuse.reflected
                                                                      : diffuse.transmitted;
        for (std::size_t b = 0; b < bands; ++b) {
            sum[b] += lobe.albedo[b];
        }
    }
    return diffuse;
}

/// Light of all sources on a plane facing it, as red, green and blue: the exitance of a white
/// surface. 1 where there is none.
LinearRgb white_of(const TrueLightSpec& spec) {
    LinearRgb white{};
    for (const auto& source : *spec.sources) {
        for (std::size_t b = 0; b < spec.bands.size(); ++b) {
            for (std::size_t c = 0; c < white.size(); ++c) {
                white[c] += spec.bands[b][c] * source->spectrum()[b];
            }
        }
    }
    for (double& channel : white) {
        channel = channel > 0 ? channel : 1;
    }
    return white;
}

/// Tone mapping: light approaches white asymptotically, encoded for sRGB (IEC 61966-2-1).
std::uint8_t encoded(double light) {
    const double toned = 1 - std::exp(-light);
    const double coded =
        toned <= 0.0031308 ? 12.92 * toned : 1.055 * std::pow(toned, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * coded));
}

class TrueLight {
  public:
    TrueLight(const Scene& scene, const Camera& camera, const TrueLightSpec& spec)
        : scene_(scene),
          spec_(spec),
          hits_(scene, camera, spec.cuts),
          white_(white_of(spec)),
          light_(spec.width * spec.height),
          coverage_(spec.width * spec.height) {
        for (const Material& material : data_of(scene).materials) {
            materials_.push_back(
                {matt_side(material.side(SurfaceSide::upper), spec.bands.size()),
                 matt_side(material.side(SurfaceSide::lower), spec.bands.size())});
        }
    }

    Image image() {
        parallel_blocks(
            spec_.height, thread_count(spec_.threads), [this](std::uint64_t y, unsigned) {
                for (std::size_t x = 0; x < spec_.width; ++x) {
                    sample_pixel(x, y);
                }
            });
        const double scale = exposure();
        Image image(spec_.width, spec_.height, spec_.background);
        for (std::size_t i = 0; i < light_.size(); ++i) {
            const LinearRgb& light = light_[i];
            const Rgb own{
                encoded(scale * light[0]), encoded(scale * light[1]), encoded(scale * light[2])};
            image.pixels[i] = mixed(spec_.background, own, coverage_[i]);
        }
        return image;
    }

  private:
    /// Samples four points of a pixel, a rotated grid.
    void sample_pixel(std::size_t x, std::size_t y) {
        constexpr std::array<PixelPoint, 4> kOffsets{
            {{.375, .125}, {.875, .375}, {.625, .875}, {.125, .625}}};
        const std::size_t pixel = y * spec_.width + x;
        LinearRgb sum{};
        double count = 0;
        for (std::size_t i = 0; i < kOffsets.size(); ++i) {
            const PixelPoint at{
                static_cast<double>(x) + kOffsets[i].x, static_cast<double>(y) + kOffsets[i].y};
            if (const auto seen = hits_.trace(at)) {
                sum += tinted(
                    light_from(*seen, mix64(kOffsets.size() * pixel + i)),
                    scene_.regions()[seen->region].organ.value);
                ++count;
            }
        }
        for (std::size_t c = 0; c < sum.size() && count > 0; ++c) {
            light_[pixel][c] = sum[c] / count / white_[c];
        }
        coverage_[pixel] = count / kOffsets.size();
    }

    [[nodiscard]] LinearRgb tinted(LinearRgb light, std::uint32_t organ) const {
        for (std::size_t c = 0; c < light.size() && !spec_.tints.empty(); ++c) {
            light[c] *= spec_.tints[organ][c];
        }
        return light;
    }

    /// Pi times the radiance towards the camera.
    [[nodiscard]] LinearRgb light_from(const PrimaryHit& seen, std::uint64_t key) const {
        const Region& region = scene_.regions()[seen.region];
        const auto& sides = materials_[region.material.value];
        const Vec3 normal =
            normalized(Vec3{seen.hit.normal[0], seen.hit.normal[1], seen.hit.normal[2]});
        const bool sees_upper = dot(normal, seen.direction) < 0;
        LinearRgb light = scattered_by(region.organ.value, sides);
        const LocalMesh& mesh = hits_.caster().mesh();
        const Vec3 local = mesh.point(seen.hit.triangle, seen.hit.u, seen.hit.v);
        const Vec3 p = mesh.to_world(local);
        for (const auto& source : *spec_.sources) {
            constexpr int kOfExtended = 8;
            const int draws = source->is_directional() ? 1 : kOfExtended;
            for (int i = 0; i < draws; ++i) {
                const auto [u0, u1] = point_of(key, i);
                const Illumination from = model_of(*source).illuminate(p, u0, u1);
                const double cosine = dot(normal, from.to_light);
                if (cosine == 0 ||
                    hits_.caster().occluded(
                        local, from.to_light, seen.hit.triangle, from.distance * mesh.scale)) {
                    continue;
                }
                const bool lights_upper = cosine > 0;
                const DiffuseSide& side = sides[lights_upper ? 0 : 1];
                const auto& part = lights_upper == sees_upper ? side.reflected : side.transmitted;
                add(source->spectrum(), part, from.weight * std::abs(cosine) / draws, light);
            }
        }
        return light;
    }

    /// Light from other surfaces, assumed equal on both sides of an organ.
    [[nodiscard]] LinearRgb scattered_by(
        std::uint32_t organ, const std::array<DiffuseSide, 2>& sides) const {
        constexpr double kQuarter = 0.25;  // two sides of incidence, two of exitance
        const std::size_t bands = spec_.bands.size();
        const std::span<const double> falls =
            std::span(spec_.scattered).subspan(organ * bands, bands);
        LinearRgb light{};
        for (const DiffuseSide& side : sides) {
            add(falls, side.reflected, kQuarter, light);
            add(falls, side.transmitted, kQuarter, light);
        }
        return light;
    }

    void add(
        std::span<const double> falls,
        const std::vector<double>& part,
        double factor,
        LinearRgb& light) const {
        for (std::size_t b = 0; b < falls.size(); ++b) {
            const double sent = std::isfinite(falls[b]) ? falls[b] * part[b] * factor : 0;
            for (std::size_t c = 0; c < light.size(); ++c) {
                light[c] += spec_.bands[b][c] * sent;
            }
        }
    }

    /// Uniformly distributed points of the unit square (the lattice of the plastic number), by
    /// pixel.
    static std::pair<double, double> point_of(std::uint64_t key, int i) {
        const auto unit = [](std::uint64_t bits) {
            return static_cast<double>(bits >> 11U) * 0x1p-53;
        };
        const double u0 = unit(key) + i * kPlaneSteps[0],
                     u1 = unit(mix64(key)) + i * kPlaneSteps[1];
        return {u0 - std::floor(u0), u1 - std::floor(u1)};
    }

    /// Exposure: the brightest hundredth of the pixels begins to saturate.
    [[nodiscard]] double exposure() const {
        std::vector<double> brightness;
        for (std::size_t i = 0; i < light_.size(); ++i) {
            if (coverage_[i] > 0) {
                // Luminance of linear sRGB (ITU-R BT.709).
                brightness.push_back(
                    0.2126 * light_[i][0] + 0.7152 * light_[i][1] + 0.0722 * light_[i][2]);
            }
        }
        if (brightness.empty()) {
            return 1;
        }
        constexpr double kBrightest = 0.99, kExposed = 1.2;
        const auto at =
            brightness.begin() +
            static_cast<std::ptrdiff_t>(kBrightest * static_cast<double>(brightness.size() - 1));
        std::nth_element(brightness.begin(), at, brightness.end());
        return *at > 0 ? kExposed / *at : 1;
    }

    const Scene& scene_;
    const TrueLightSpec& spec_;
    CameraRayCaster hits_;
    LinearRgb white_;
    std::vector<std::array<DiffuseSide, 2>> materials_;
    std::vector<LinearRgb> light_;
    std::vector<double> coverage_;  // covered fraction of each pixel
};

}  // namespace

std::vector<LinearRgb> colors_of_bands(const std::vector<Band>& bands) {
    constexpr std::array<std::array<double, 2>, 3> kChannels{{{600, 700}, {500, 600}, {400, 500}}};
    std::vector<LinearRgb> colors(bands.size());
    LinearRgb total{};
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const SpectralSpan span =
            span_of_band(bands[b].name, bands[b].from_nm, bands[b].to_nm).value_or(SpectralSpan{});
        const double from = span.from_nm, to = span.to_nm;
        for (std::size_t c = 0; c < kChannels.size() && to > from; ++c) {
            colors[b][c] = overlap(from, to, kChannels[c][0], kChannels[c][1]) / (to - from);
        }
        total += colors[b];
    }
    const auto reached = std::count_if(total.begin(), total.end(), [](double x) { return x > 0; });
    if (reached == 0) {
        return {};
    }
    for (LinearRgb& color : colors) {
        const double mean = (color[0] + color[1] + color[2]) / static_cast<double>(reached);
        for (std::size_t c = 0; c < color.size(); ++c) {
            color[c] = total[c] > 0 ? color[c] : mean;
        }
    }
    return colors;
}

Image render_true_light(const Scene& scene, const Camera& camera, const TrueLightSpec& spec) {
    EXPECT(spec.scattered.size() == scene.organs().size() * spec.bands.size());
    return TrueLight(scene, camera, spec).image();
}

}  // namespace quasimc
