#include "picture/scene_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/vec3.h"
#include "quasimc/error.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

constexpr Rgb kDark{30, 30, 30};
constexpr Rgb kFaint{110, 110, 110};
constexpr Rgb kSunMark{225, 120, 0};
constexpr double kLegendWidth = 170;
constexpr double kEdge = 18;

/// A heading in lines that fit.
struct Heading {
    static constexpr double kTitleSize = 20, kSubtitleSize = 14;
    static constexpr std::size_t kMaxLines = 2;

    std::vector<std::string> title, subtitle;

    Heading(const ScenePicture& picture, double width, double scale)
        : title(folded(picture.title, kTitleSize * scale, width, kMaxLines)),
          subtitle(folded(picture.subtitle, kSubtitleSize * scale, width, kMaxLines)) {}

    [[nodiscard]] double height() const {
        return 1.2 * kTitleSize * static_cast<double>(title.size()) +
               1.3 * kSubtitleSize * static_cast<double>(subtitle.size()) + 20;
    }
    void draw(Canvas& canvas, PixelPoint at, double scale) const {
        for (const std::string& line : title) {
            at.y += 1.2 * kTitleSize * scale;
            canvas.text(at, line, {.size = kTitleSize * scale});
        }
        at.y += 2 * scale;
        for (const std::string& line : subtitle) {
            at.y += 1.3 * kSubtitleSize * scale;
            canvas.text(at, line, {.size = kSubtitleSize * scale, .color = kFaint});
        }
    }
};

/// The size of annotations, relative to those of a picture 900 pixels high. Those of smaller
/// pictures are not much smaller, unless there is no room for them.
double scale_of(const ScenePicture& picture) {
    constexpr double kUsual = 900, kLegible = 0.85, kMinWidth = 500, kMinHeight = 400;
    const auto width = static_cast<double>(picture.width);
    const auto height = static_cast<double>(picture.height);
    const double legible = std::min({kLegible, width / kMinWidth, height / kMinHeight});
    return std::clamp(std::max(std::min(width, height) / kUsual, legible), 0.5, 8.0);
}

/// Layout of a picture.
struct Layout {
    double scale, width, height;  // of the picture
    double view_width, view_height, view_top = 0;
    std::optional<Heading> heading;

    explicit Layout(const ScenePicture& picture)
        : scale(scale_of(picture)),
          width(static_cast<double>(picture.width)),
          height(static_cast<double>(picture.height)),
          view_width(width),
          view_height(height) {
        if (picture.has_annotations) {
            heading.emplace(picture, width - 2 * kEdge * scale, scale);
            view_width = std::max(1.0, std::floor(width - kLegendWidth * scale));
            view_top = std::floor(heading->height() * scale);
            view_height = std::max(1.0, height - view_top);
        }
    }
};

void draw_arrow(
    Canvas& canvas, const PixelPoint& from, const PixelPoint& to, const Rgb& color, double s) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    canvas.line(from, to, color, 2 * s);
    if (length > 6 * s) {
        const double dx = (to.x - from.x) / length * 9 * s, dy = (to.y - from.y) / length * 9 * s;
        canvas.polygon(
            std::array<PixelPoint, 3>{
                {to,
                 {to.x - dx - 0.4 * dy, to.y - dy + 0.4 * dx},
                 {to.x - dx + 0.4 * dy, to.y - dy - 0.4 * dx}}},
            color);
    }
}

/// The position for a letter, as close as possible to `at`, that does not cover the marks of suns.
PixelPoint beside_suns(PixelPoint at, const std::vector<PixelPoint>& suns, double room) {
    for (const PixelPoint& sun : suns) {
        const double dx = at.x - sun.x, dy = at.y - sun.y, far = std::hypot(dx, dy);
        if (far < room) {
            at = far > 0 ? PixelPoint{sun.x + room * dx / far, sun.y + room * dy / far}
                         : PixelPoint{sun.x, sun.y + room};
        }
    }
    return at;
}

/// Draws north, the vertical and the suns as arrows in a circle.
void draw_directions(
    Canvas& canvas,
    const Scene& scene,
    const Camera& camera,
    const ScenePicture& picture,
    const Layout& layout) {
    const double s = layout.scale, radius = 46 * s;
    const PixelPoint middle{layout.view_width + 70 * s, layout.height - 78 * s};
    canvas.disk(middle, radius + s, {225, 225, 225});
    canvas.disk(middle, radius - s, {255, 255, 255});
    const auto point_towards = [&](const Vec3& direction, double part) {
        const Vec3 seen = camera.seen(direction);
        return PixelPoint{middle.x + part * radius * seen.x, middle.y - part * radius * seen.y};
    };
    constexpr std::size_t kMaxSuns = 40;
    std::vector<PixelPoint> suns;
    for (const Vec3& sun : picture.to_suns) {
        suns.push_back(point_towards(sun, 0.9));
    }
    suns.resize(suns.size() <= kMaxSuns ? suns.size() : 0);
    const auto arrow = [&](const Vec3& direction, const char* name, const Rgb& color) {
        draw_arrow(canvas, middle, point_towards(direction, 0.8), color, s);
        const PixelPoint at = beside_suns(point_towards(direction, 1.22), suns, 15 * s);
        const Vec3 seen = camera.seen(direction);
        if (std::hypot(seen.x, seen.y) > 0.2) {
            canvas.text(
                {at.x, at.y + 5 * s}, name,
                {.size = 13 * s, .anchor = TextAnchor::middle, .color = color});
        }
    };
    arrow({0, 0, 1}, "up", kFaint);
    arrow(scene.orientation().towards(0, 0), "N", kDark);
    for (const PixelPoint& sun : suns) {
        canvas.disk(sun, 5 * s, kSunMark);
    }
    if (!suns.empty()) {
        canvas.disk({middle.x - 22 * s, layout.height - 12 * s}, 5 * s, kSunMark);
        canvas.text(
            {middle.x - 12 * s, layout.height - 8 * s}, "sun", {.size = 12 * s, .color = kFaint});
    }
}

void draw_scale_bar(
    Canvas& canvas, const Scene& scene, const Camera& camera, const Layout& layout) {
    const double s = layout.scale;
    const double length = round_number_below(0.25 * layout.view_width / camera.scale());
    const double pixels = length * camera.scale();
    const PixelPoint left{kEdge * s, layout.height - 18 * s};
    canvas.rectangle({left.x - 1.5 * s, left.y - 4.5 * s}, pixels + 3 * s, 8 * s, {255, 255, 255});
    canvas.rectangle({left.x, left.y - 3 * s}, pixels, 5 * s, kDark);
    canvas.text(
        {left.x + 0.5 * pixels, left.y - 8 * s},
        fmt::format(
            "{} {}{}", tick_text(length, length), scene.length_unit(),
            camera.is_parallel() ? "" : " in the middle"),
        {.size = 13 * s, .anchor = TextAnchor::middle, .has_halo = true});
}

/// The horizon of a fisheye.
void draw_horizon(Canvas& canvas, const Layout& layout) {
    constexpr int kSteps = 360;
    const double radius = 0.5 * std::min(layout.view_width, layout.view_height) - layout.scale;
    const auto at = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / kSteps;
        return PixelPoint{
            0.5 * layout.view_width + radius * std::cos(angle),
            layout.view_top + 0.5 * layout.view_height + radius * std::sin(angle)};
    };
    for (int i = 0; i < kSteps; ++i) {
        canvas.line(at(i), at(i + 1), kFaint, layout.scale);
    }
}

/// The scene in colours, or in its light.
Image image_of(
    const Scene& scene,
    const Camera& camera,
    const ScenePicture& picture,
    const Layout& layout,
    const Rgb& background) {
    const auto width = static_cast<std::size_t>(layout.view_width);
    const auto height = static_cast<std::size_t>(layout.view_height);
    if (!picture.true_light) {
        RenderSpec spec = picture.render;
        spec.width = width;
        spec.height = height;
        spec.background = background;
        return render(scene, camera, spec);
    }
    TrueLightSpec spec = *picture.true_light;
    spec.width = width;
    spec.height = height;
    spec.background = background;
    spec.cuts = picture.render.cuts;
    spec.threads = picture.render.threads;
    return render_true_light(scene, camera, spec);
}

Image draw_on(const Rgb& background, const Scene& scene, const ScenePicture& picture) {
    const Layout layout(picture);
    const Camera camera(
        picture.view, scene.orientation(),
        picture.framed.empty() ? shown_bounds(scene, picture.render.cuts) : picture.framed,
        layout.view_width, layout.view_height);
    Canvas canvas(picture.width, picture.height, background);
    canvas.put({0, layout.view_top}, image_of(scene, camera, picture, layout, background));
    if (!picture.has_annotations) {
        return canvas.image();
    }
    const double s = layout.scale;
    layout.heading->draw(canvas, {kEdge * s, 4 * s}, s);
    draw_legend(
        canvas, picture.legend, {layout.view_width + 22 * s, layout.view_top + 30 * s},
        std::max(20.0, layout.view_height - 260 * s), s);
    if (camera.is_fisheye()) {
        draw_horizon(canvas, layout);
    } else {
        draw_scale_bar(canvas, scene, camera, layout);
    }
    draw_directions(canvas, scene, camera, picture, layout);
    return canvas.image();
}

}  // namespace

std::string draw_scene(const Scene& scene, const ScenePicture& picture) {
    if (shown_bounds(scene, picture.render.cuts).empty()) {
        throw InputError(
            {{"--clip", "nothing of the scene is left", "the scene is on the other side", ""}});
    }
    if (picture.view.fisheye && !is_in_reach(scene, *picture.view.fisheye)) {
        throw InputError({{"--camera", "the fisheye is too far from the scene", kReachRule, ""}});
    }
    constexpr Rgb kWhite{255, 255, 255}, kBlack{0, 0, 0};
    const Image on_white = draw_on(kWhite, scene, picture);
    return picture.is_transparent ? to_transparent_png(on_white, draw_on(kBlack, scene, picture))
                                  : to_png(on_white);
}

}  // namespace quasimc
