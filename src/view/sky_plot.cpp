#include "view/sky_plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/checks.h"

namespace quasimc {
namespace {

using std::numbers::pi;

// The palette: shades of the sky, then the rest.
constexpr std::size_t kShades = 250;
constexpr std::uint8_t kPaper = 250;
constexpr std::uint8_t kInk = 251;
constexpr std::uint8_t kSun = 252;

/// Dark blue, blue, light blue, pale yellow, white.
std::vector<Color> make_palette() {
    constexpr std::array<std::array<double, 3>, 5> kStops{
        {{8, 10, 40}, {20, 60, 140}, {80, 160, 220}, {240, 225, 160}, {255, 255, 255}}};
    std::vector<Color> palette;
    for (std::size_t i = 0; i < kShades; ++i) {
        const double place = static_cast<double>(i) / (kShades - 1) * (kStops.size() - 1);
        const auto stop = std::min(kStops.size() - 2, static_cast<std::size_t>(place));
        const double part = place - static_cast<double>(stop);
        Color color{};
        for (std::size_t c = 0; c < color.size(); ++c) {
            color[c] = static_cast<std::uint8_t>(
                std::lround(kStops[stop][c] + part * (kStops[stop + 1][c] - kStops[stop][c])));
        }
        palette.push_back(color);
    }
    palette.push_back({255, 255, 255});
    palette.push_back({40, 40, 40});
    palette.push_back({220, 30, 20});
    return palette;
}

/// Five columns of seven dots, rows from the top; "#" is ink.
struct Letter {
    double azimuth;  // where it stands, from north over east
    std::array<std::string_view, 7> dots;
};
constexpr std::array<Letter, 4> kLetters{
    {{0, {"#...#", "##..#", "#.#.#", "#..##", "#...#", "#...#", "#...#"}},
     {pi / 2, {"#####", "#....", "#....", "####.", "#....", "#....", "#####"}},
     {pi, {".####", "#....", "#....", ".###.", "....#", "....#", "####."}},
     {3 * pi / 2, {"#...#", "#...#", "#...#", "#.#.#", "#.#.#", "##.##", "#...#"}}}};

/// The plot in the making.
class SkyPlot {
  public:
    SkyPlot(const Vec3& north, std::size_t size)
        : north_(normalized(north)),
          east_{north_.y, -north_.x, 0},
          middle_(0.5 * static_cast<double>(size)) {
        picture_.width = picture_.height = size;
        picture_.pixels.assign(size * size, kPaper);
        picture_.palette = make_palette();
        radius_ = middle_ - 1.5 * kMargin * dot_size();
    }

    void paint(const Source& sky) {
        std::vector<double> radiances;
        double brightest = 0;
        for_each_direction([&](std::size_t, std::size_t, const Vec3& d) {
            radiances.push_back(sky.radiance(d));
            brightest = std::max(brightest, radiances.back());
        });
        std::size_t i = 0;
        for_each_direction([&](std::size_t x, std::size_t y, const Vec3&) {
            const double shade = std::sqrt(radiances[i++] / brightest) * (kShades - 1);
            picture_.at(x, y) = static_cast<std::uint8_t>(std::lround(shade));
        });
    }

    void draw_rings() {
        for (const double elevation_deg : {0.0, 30.0, 60.0}) {
            draw_circle(middle_, middle_, radius_ * (1 - elevation_deg / 90), kInk);
        }
    }

    void draw_letters() {
        const double out = radius_ + 0.75 * kMargin * dot_size();
        for (const Letter& letter : kLetters) {
            draw_letter(
                letter, middle_ - out * std::sin(letter.azimuth),
                middle_ - out * std::cos(letter.azimuth));
        }
    }

    void draw_sun(const Vec3& to_sun) {
        const double off = radius_ * std::acos(std::clamp(to_sun.z, -1.0, 1.0)) / (pi / 2);
        const double azimuth = std::atan2(dot(to_sun, east_), dot(to_sun, north_));
        const double x = middle_ - off * std::sin(azimuth);
        const double y = middle_ - off * std::cos(azimuth);
        for (const double radius : {0.4, 0.8, 4.0, 4.5}) {
            draw_circle(x, y, radius * dot_size(), kSun);
        }
    }

    [[nodiscard]] Picture take() && { return std::move(picture_); }

  private:
    static constexpr double kMargin = 10;  // around the sky, dots of a letter

    [[nodiscard]] double dot_size() const { return std::max(1.0, std::floor(middle_ / 128)); }

    /// Calls f(x, y, direction) for the pixels of the sky.
    template <typename Function>
    void for_each_direction(const Function& f) const {
        for (std::size_t y = 0; y < picture_.height; ++y) {
            for (std::size_t x = 0; x < picture_.width; ++x) {
                const double left = middle_ - (static_cast<double>(x) + 0.5);
                const double up = middle_ - (static_cast<double>(y) + 0.5);
                const double off = std::hypot(left, up) / radius_;
                if (off < 1) {
                    const double zenith = off * pi / 2;
                    const double azimuth = std::atan2(left, up);
                    const Vec3 flat = std::cos(azimuth) * north_ + std::sin(azimuth) * east_;
                    f(x, y, std::sin(zenith) * flat + Vec3{0, 0, std::cos(zenith)});
                }
            }
        }
    }

    void put(double x, double y, std::uint8_t color) {
        if (x >= 0 && y >= 0 && x < static_cast<double>(picture_.width) &&
            y < static_cast<double>(picture_.height)) {
            picture_.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) = color;
        }
    }
    /// About a middle.
    void draw_letter(const Letter& letter, double x, double y) {
        const double dot = dot_size();
        for (std::size_t row = 0; row < letter.dots.size(); ++row) {
            for (std::size_t column = 0; column < letter.dots[row].size(); ++column) {
                if (letter.dots[row][column] == '#') {
                    fill(
                        x + dot * (static_cast<double>(column) - 2.5),
                        y + dot * (static_cast<double>(row) - 3.5), static_cast<int>(dot));
                }
            }
        }
    }
    void fill(double left, double top, int size) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                put(left + x, top + y, kInk);
            }
        }
    }
    void draw_circle(double x, double y, double radius, std::uint8_t color) {
        const int steps = static_cast<int>(8 * radius) + 8;
        for (int i = 0; i < steps; ++i) {
            const double angle = 2 * pi * i / steps;
            put(x + radius * std::cos(angle), y + radius * std::sin(angle), color);
        }
    }

    Vec3 north_, east_;
    double middle_, radius_ = 0;
    Picture picture_;
};

}  // namespace

Picture plot_sky(
    const Source& sky, const Vec3& north, const std::optional<Vec3>& to_sun, std::size_t size) {
    EXPECT(size >= 64 && size <= 4096);
    SkyPlot plot(north, size);
    plot.paint(sky);
    plot.draw_rings();
    plot.draw_letters();
    if (to_sun && to_sun->z > 0) {
        plot.draw_sun(*to_sun);
    }
    return std::move(plot).take();
}

}  // namespace quasimc
