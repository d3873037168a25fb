#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "raster/envelope.h"
#include "raster/projected_scene.h"

namespace quasimc {

/// Parallel scan lines across a beam, and which triangles each strip of them may meet.
///
/// Visible segments of the lines (LineStrip) are exact, so that length x area() summed over lines
/// estimates the lit area of a triangle across the beam. A uniform shift of the lines makes it
/// unbiased; its variance falls with about the third power of the number of lines. The rotation
/// prevents edges parallel to the lines.
class ScanLines {
  public:
    /// Lines of one beam.
    struct Spec {
        Vec3 direction;           ///< unit, in which the light travels
        double rotation = 0;      ///< of the lines about it, see ProjectionPlane
        double shift = 0;         ///< 0..1, of the pitch
        std::uint32_t lines = 1;  ///< across the scene
    };

    /// Lines of a strip.
    static constexpr std::uint32_t kStrip = 128;
    [[nodiscard]] static std::uint32_t strips(std::uint32_t lines) {
        return (lines + kStrip - 1) / kStrip;
    }

    /// @param scene  with at least one triangle; its mesh and roles must outlive the lines
    ScanLines(const ProjectedScene& scene, const Spec& spec);

    /// Area across the beam per unit length of a line, local units squared.
    [[nodiscard]] double area() const { return pitch_ * plane_.area; }

  private:
    friend class LineStrip;

    /// An image of a triangle on the plane of the beam, and the strips that it touches.
    struct Image {
        std::uint32_t triangle = 0;
        double offset_s = 0, offset_t = 0;
        std::uint32_t first_strip = 0, last_strip = 0;
    };

    [[nodiscard]] double line_at(double number) const;
    [[nodiscard]] bool may_be_cut(double from, double to) const;
    void find_images();
    void add_images_along(Image image);
    void add_image(Image image, double from, double to);
    void sort_into_strips();
    [[nodiscard]] ProjectedTriangle seen(const Image& image) const;

    ProjectedScene scene_;
    Spec spec_;
    ProjectionPlane plane_;
    double pitch_;
    std::vector<Image> images_;                // images that touch the lines
    std::vector<std::size_t> first_in_strip_;  // strip i: in_strip_[first[i]] to first[i + 1]
    std::vector<std::uint32_t> in_strip_;      // images
};

class LineScratch;

/// The triangles that a strip of scan lines may meet, and their visible segments. It refers to the
/// lines and to the scratch, which serves one strip at a time.
class LineStrip {
  public:
    /// A triangle; in a periodic scene, one of its images.
    struct Triangle {
        std::uint32_t triangle = 0;  ///< of the mesh
        double cosine = 0;           ///< dot(unit normal of the upper side, direction of the beam)
    };
    /// A line and its visible segments: those of opaque triangles in order along the line, then
    /// those of sensors. Their surfaces are indices of triangles().
    struct Line {
        std::uint32_t number = 0;  ///< of all lines of the beam
        double t = 0;              ///< on the plane of the beam
        std::span<const VisibleSegment> segments;
    };
    /// The visible segments of a triangle on all lines of the strip.
    struct Visible {
        std::uint32_t segments = 0;
        double length = 0;  ///< sum over the lines
    };

    /// @param strip  less than ScanLines::strips()
    LineStrip(const ScanLines& lines, std::uint32_t strip, LineScratch& scratch);

    [[nodiscard]] std::span<const Triangle> triangles() const;
    /// Calls visit(line) for each line of the strip, in order.
    /// @returns the visible segments of each triangle; valid as long as the strip
    template <typename Visit>
    std::span<const Visible> for_visible_segments(const Visit& visit) const {
        clear_cuts();
        for (std::uint32_t number = first_line_; number < end_line_; ++number) {
            visit(cut_line(number));
        }
        return visible();
    }
    /// The point on its triangle at a fraction f in [0, 1] of a segment.
    [[nodiscard]] Barycentric point(
        const Line& line, const VisibleSegment& segment, double f) const;

  private:
    void clear_cuts() const;
    [[nodiscard]] Line cut_line(std::uint32_t number) const;
    [[nodiscard]] std::span<const Visible> visible() const;
    void cut_again(double t, std::vector<VisibleSegment>& cuts) const;
    void add_new_cuts(double t) const;
    [[nodiscard]] VisibleSegment cut(double t, std::uint32_t triangle) const;

    const ScanLines& lines_;
    LineScratch& scratch_;
    std::uint32_t first_line_, end_line_;
};

/// Memory that a LineStrip uses.
class LineScratch {
    friend class LineStrip;

    /// A side of a triangle, followed from its lower end (in t) up, so that triangles sharing a
    /// side are cut at the same points.
    struct Edge {
        double s, t, z, s_by_t, z_by_t;
    };
    /// A triangle prepared for cutting: from its lowest corner to the highest directly, and via the
    /// middle one.
    struct Slice {
        Edge whole, lower, upper;
        double top;
        bool is_middle_right;
    };

    [[nodiscard]] static Slice slice_of(const ProjectedTriangle& seen);

    // By triangle of the strip.
    std::vector<LineStrip::Triangle> triangles_;
    std::vector<ProjectedTriangle> seen_;
    std::vector<Slice> slices_;
    std::vector<LineStrip::Visible> visible_;
    std::vector<std::pair<double, std::uint32_t>>
        order_;  // order in which lines meet triangles: t, triangle

    std::size_t next_in_order_ = 0;
    std::vector<VisibleSegment> opaque_, sensors_;  // all segments of a line, in order of `low`
    std::vector<VisibleSegment> new_opaque_, new_sensors_, merged_;
    std::vector<VisibleSegment> segments_, before_;
    Envelope envelope_;
};

}  // namespace quasimc
