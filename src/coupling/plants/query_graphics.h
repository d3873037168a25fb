#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "coupling/protocol/messages.h"
#include "growth/turtle/drawing.h"

namespace quasimc {

/// Shapes of the module after a query. Surfaces and generalized cylinders are polygons; the other
/// shapes have keywords.
class QueryGraphics : public Drawing {
  public:
    void begin_module(const DrawnModule& /*module*/) final {}
    void segment(const DrawnSegment& segment, int color) final;
    void triangles(std::span<const Triangle> triangles, int color) final;
    void sphere(const Vec3& center, double radius, int color) final;
    void disc(const TurtleFrame& frame, double radius, int color) final;
    void surface(const BezierSurface& surface, const Affine& transform, int color) final;

  protected:
    /// A shape that is no polygon. @param numbers  its points, directions and radii
    virtual void other(std::string_view keyword, std::initializer_list<double> numbers) = 0;
};

/// Writes shapes as graphics of messages.
class GraphicsText final : public QueryGraphics {
  public:
    /// @param text  receives the lines; outlives the object
    explicit GraphicsText(std::string& text) : text_(text) {}
    void polygon(std::span<const Vec3> corners, int color) override;

  protected:
    void other(std::string_view keyword, std::initializer_list<double> numbers) override;

  private:
    std::string& text_;
};

/// Adds shapes to the last query of a pass, as reading their text does.
class PassGraphics final : public QueryGraphics {
  public:
    /// @param pass  outlives the object
    explicit PassGraphics(Pass& pass) : pass_(pass) {}
    void polygon(std::span<const Vec3> corners, int color) override;

  protected:
    void other(std::string_view keyword, std::initializer_list<double> numbers) override;

  private:
    Pass& pass_;
};

}  // namespace quasimc
