// The pictures of the manual, drawn anew.
//
// Rationale: what people see in the manual must be what the program draws, whatever becomes of
// fonts, compression and the last bit of a number. Expected behaviour: at a glance, where letters
// and edges run together, every colour is the same to the eye; another quantity, another colour map
// or a scene from elsewhere is not.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <png.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "picture/image.h"
#include "program.h"

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;

using Lab = std::array<double, 3>;

double linear(double byte) {
    const double x = byte / 255;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// CIELAB of linear sRGB (IEC 61966-2-1, white D65).
Lab lab_of(const std::array<double, 3>& rgb) {
    const auto [r, g, b] = rgb;
    const auto f = [](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
    const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
    const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// What the eye sees of a picture from afar: the light of squares of eight pixels.
std::vector<Lab> glance(const std::string& png) {
    constexpr std::size_t kSide = 8;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
    image.format = PNG_FORMAT_RGB;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    const std::size_t columns = image.width / kSide, rows = image.height / kSide;
    std::vector<std::array<double, 3>> light(columns * rows);
    for (std::size_t y = 0; y < kSide * rows; ++y) {
        for (std::size_t x = 0; x < kSide * columns; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                light[y / kSide * columns + x / kSide][c] +=
                    linear(pixels[3 * (y * image.width + x) + c]) / (kSide * kSide);
            }
        }
    }
    std::vector<Lab> colors(light.size());
    std::transform(light.begin(), light.end(), colors.begin(), lab_of);
    return colors;
}

/// The largest difference of two colours (CIE 1976), of which some two can just be seen; 1000 for
/// pictures of different sizes.
double difference(const std::vector<Lab>& a, const std::vector<Lab>& b) {
    double most = a.size() == b.size() && !a.empty() ? 0 : 1000;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        most = std::max(most, std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1], a[i][2] - b[i][2]));
    }
    return most;
}

std::string read_binary(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

constexpr double kJustSeen = 2.3;  // Mahy, Van Eycken and Oosterlinck (1994)

class ManualPictures : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        if (!has_png()) {
            GTEST_SKIP() << "built without pictures";
        }
        for (const fs::path& file : fs::directory_iterator(root_ / "examples/01-leaves")) {
            if (file.extension() == ".toml" || file.extension() == ".tri") {
                folder_.write(file.filename().string(), read_binary(file));
            }
        }
    }
    /// At a glance what these words draw to new.png.
    [[nodiscard]] std::vector<Lab> drawn(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return glance(folder_.read("new.png"));
    }
    void expect_of_manual(
        const std::string& name, const std::vector<std::string>& arguments) const {
        EXPECT_LT(
            difference(drawn(arguments), glance(read_binary(root_ / "docs" / name))), kJustSeen)
            << name;
    }

    fs::path root_ = QUASIMC_SOURCE_DIR;
};

TEST_F(ManualPictures, ShowTheLeaves) {
    ASSERT_EQ(run({"run", "leaves.toml"}).status, 0);
    const std::vector<std::string> first{"show",   "leaves.json", "-o",    "new.png",
                                         "--size", "800x640",     "--fov", "20"};
    expect_of_manual("images/leaves.png", first);
    expect_of_manual(
        "images/leaves_scattered_error.png",
        {"show", "leaves.json", "-o", "new.png", "--quantity", "incident_scattered", "--error",
         "--camera", "top", "--clip", "z>5", "--size", "600x450"});
    // Colours that must be distinguishable at a glance.
    const std::vector<Lab> seen = drawn(first);
    for (const auto& [flag, value] : std::vector<std::pair<std::string, std::string>>{
             {"--quantity", "incident_upper"}, {"--colormap", "cividis"}, {"--camera", "203,20"}}) {
        std::vector<std::string> other = first;
        other.insert(other.end(), {flag, value});
        EXPECT_GT(difference(seen, drawn(other)), 10 * kJustSeen) << flag;
    }
}

TEST_F(ManualPictures, ShowAnAfternoon) {
    ASSERT_EQ(run({"run", "afternoon.toml"}).status, 0);
    expect_of_manual(
        "images/leaves_as_seen.png", {"show", "afternoon.json", "-o", "new.png", "--size",
                                      "800x640", "--fov", "20", "--realistic"});
}

TEST_F(ManualPictures, ShowThePaper) {
    const std::string run_file = (root_ / "examples/02-paper/paper.toml").string();
    ASSERT_EQ(run({"run", run_file, "--json", "paper.json", "--csv", "paper.csv"}).status, 0);
    expect_of_manual(
        "images/paper_canopy.png",
        {"show", "paper.json", "-o", "new.png", "--fov", "20", "--size", "900x640"});
}

TEST_F(ManualPictures, ShowTheSkies) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> skies{
        {"uniform", {"uniform"}},
        {"cie_overcast", {"cie_overcast"}},
        {"cie_clear", {"cie_clear"}},
        {"cie_general-7", {"cie_general", "--cie-type", "7"}},
        {"cie_general-15", {"cie_general", "--cie-type", "15"}},
        {"perez", {"perez", "--direct-normal", "600", "--diffuse-horizontal", "180"}},
        {"preetham", {"preetham", "--turbidity", "3"}}};
    for (const auto& [name, words] : skies) {
        std::vector<std::string> arguments{
            "sky",   "--site",  "50.1,8.7", "--time", "2024-06-21T10:00+02:00",
            "--png", "new.png", "--size",   "256",    "--sky"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        expect_of_manual("theory/images/sky-" + name + ".png", arguments);
    }
}

}  // namespace
}  // namespace quasimc::test
