#pragma once

#include <span>
#include <string>
#include <string_view>

#include "growth/turtle/drawing.h"
#include "growth/view/view.h"

namespace quasimc {

/// Writes the shapes of a plant as lines of text: "color 3", "cylinder r x y z x y z", "cone",
/// "sphere", "disc", "polygon", "triangle", "instance". Predefined surfaces are defined first, from
/// "surface l" to "end"; the plant is between "model" and "end".
class PlainGeometry : public Drawing {
  public:
    /// @param view  its surfaces are written
    explicit PlainGeometry(const View& view);

    void begin_module(const DrawnModule& /*module*/) override {}
    void segment(const DrawnSegment& segment, int color) override;
    void polygon(std::span<const Vec3> corners, int color) override;
    void triangles(std::span<const Triangle> triangles, int color) override;
    void sphere(const Vec3& center, double radius, int color) override;
    void disc(const TurtleFrame& frame, double radius, int color) override;
    void surface(const BezierSurface& surface, const Affine& transform, int color) override;

    /// All lines.
    [[nodiscard]] std::string text() const { return text_ + "end\n"; }

  private:
    void set_color(int color);
    /// Adds a line: a name, then numbers and points.
    template <typename... Values>
    void line(std::string_view name, const Values&... values);
    void add(double value);
    void add(const Vec3& point);

    std::string text_;
    int color_ = -1;
};

}  // namespace quasimc
