#include "coupling/vlab/surface_file.h"

#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

TEST(SurfaceFile, GivesTheTrueSurface) {
    const auto triangles = read_surface_text(square_surface(), "leaf.s", 0);
    EXPECT_NEAR(area(triangles), 1, 1e-12);
    for (const Triangle& t : triangles) {
        EXPECT_GT(area_vector(t).z, 0);
    }
}

TEST(SurfaceFile, IsDividedByItsSizeAndTurned) {
    std::string text = square_surface();
    text.replace(text.find("SIZE: 1"), 7, "SIZE: 2");
    text.replace(text.find("HEADING X: 0 Y: 1"), 17, "HEADING X: 1 Y: 0");
    const auto triangles = read_surface_text(text, "leaf.s", 0);
    EXPECT_NEAR(area(triangles), 0.25, 1e-12);
    double along = 0;
    for (const Triangle& t : triangles) {
        for (const Vec3& p : t) {
            along = std::max(along, p.y);
        }
    }
    EXPECT_NEAR(along, 0.25, 1e-12);  // half of its width lies along the heading
}

TEST(SurfaceFile, ComesNearerWithEachSubdivision) {
    // Half a cylinder's profile: the inner control points of each row are lifted.
    std::string text = square_surface().substr(0, square_surface().find("BL:"));
    text += "BL: ~ B: ~ BR: ~\n";
    for (int i = 0; i < 4; ++i) {
        const std::string y = std::to_string(i / 3.0);
        text += "-0.5 " + y + " 0 -0.5 " + y + " 0.6 0.5 " + y + " 0.6 0.5 " + y + " 0\n";
    }
    // Length of the profile (-1/2, 0) (-1/2, 0.6) (1/2, 0.6) (1/2, 0): chords of 100000 pieces.
    constexpr double kLength = 1.507687;
    constexpr double kDigits = 1e-4;
    double before = 1;
    for (const int subdivisions : {0, 2, 4, 6}) {
        const double error = kLength - area(read_surface_text(text, "leaf.s", subdivisions));
        EXPECT_LT(error, before) << subdivisions;
        before = error;
    }
    EXPECT_LT(before, kDigits);
}

TEST(SurfaceFile, TellsWhereItBreaks) {
    const std::string whole = square_surface();
    for (const std::size_t size :
         {std::size_t{3}, whole.size() / 4, whole.size() / 2, whole.size() - 20}) {
        EXPECT_THROW(
            static_cast<void>(read_surface_text(whole.substr(0, size), "leaf.s", 0)), InputError);
    }
    std::string bad = whole;
    bad.replace(bad.rfind("0.5"), 3, "x.5");
    try {
        static_cast<void>(read_surface_text(bad, "leaf.s", 0));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("leaf.s:"), std::string::npos);
    }
}

}  // namespace
}  // namespace quasimc::test
