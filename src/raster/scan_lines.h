#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "raster/envelope.h"
#include "raster/projected_scene.h"

namespace quasimc {

/// Parallel scan lines across a beam, and what of the scene each of them sees: exact visible
/// segments, so that length x area() summed over lines is the area of the beam that a triangle
/// catches. With a uniform shift of the lines that is unbiased; its variance falls with about the
/// third power of the number of lines, the rotation taking care of edges along the lines.
///
///     lines.set(scene, spec);
///     for each strip:
///         lines.begin(strip);
///         while (lines.next()) { lines.pieces() ... }
///         lines.items() ...
///
/// Objects are used by one thread, and hold buffers for the next beam.
class ScanLines {
  public:
    /// Lines of one beam.
    struct Spec {
        Vec3 direction;           ///< unit, in which the light travels
        double rotation = 0;      ///< of the lines about it, see ProjectionPlane
        double shift = 0;         ///< 0..1, of the pitch
        std::uint32_t lines = 1;  ///< across the scene
    };

    /// A triangle that lines of the strip may cut; in a periodic scene, one of its images.
    struct Item {
        std::uint32_t triangle = 0;  ///< of the mesh
        std::uint32_t pieces = 0;    ///< lit so far, of all lines of the strip
        double cosine = 0;           ///< dot(unit normal of the upper side, direction of the beam)
        double length = 0;           ///< of these pieces together
    };

    /// Lines that are walked one after the other.
    static constexpr std::uint32_t kStrip = 128;
    [[nodiscard]] static std::uint32_t strips(std::uint32_t lines) {
        return (lines + kStrip - 1) / kStrip;
    }

    /// @param scene  with at least one triangle; its mesh and roles must outlive the lines
    void set(const ProjectedScene& scene, const Spec& spec);

    /// Area across the beam that a line stands for, local units squared per unit of its length.
    [[nodiscard]] double area() const { return area_; }

    /// Goes to the front of a strip.
    void begin(std::uint32_t strip);
    [[nodiscard]] std::span<const Item> items() const { return items_; }
    /// Goes to the next line of the strip. False at its end.
    [[nodiscard]] bool next();
    /// What is lit along the line, in order; then what sensors see. Segments are items().
    [[nodiscard]] std::span<const LinePiece> pieces() const { return pieces_; }
    /// The place on its triangle at a part f in [0, 1] of a piece of the line.
    [[nodiscard]] Barycentric place(const LinePiece& piece, double f) const;

  private:
    /// A triangle as images of it are seen, to be moved by so much.
    struct Image {
        std::uint32_t triangle = 0;
        double offset_s = 0, offset_t = 0;
        std::uint32_t first_strip = 0, last_strip = 0;
    };
    /// A side of a triangle, walked from its lower end (in t) up, so that triangles which share one
    /// are cut at the same places.
    struct Edge {
        double s, t, z, s_by_t, z_by_t;
    };
    /// A triangle ready to be cut: from its lowest corner to the highest, and by way of the middle.
    struct Slice {
        Edge whole, lower, upper;
        double top;
        bool is_middle_right;
    };

    [[nodiscard]] double line_at(double number) const;
    [[nodiscard]] bool may_be_cut(double from, double to) const;
    void find_images();
    void add_images_along(Image image);
    void add_image(Image image, double from, double to);
    void sort_into_strips();
    [[nodiscard]] ProjectedTriangle seen(const Image& image) const;
    [[nodiscard]] static Slice slice_of(const ProjectedTriangle& seen);
    [[nodiscard]] LinePiece cut(std::uint32_t item) const;
    void cut_again(std::vector<LinePiece>& cuts) const;
    void add_new_cuts();

    ProjectedScene scene_;
    Spec spec_;
    std::optional<ProjectionPlane> plane_;
    double pitch_ = 0, area_ = 0;
    std::vector<Image> images_;                // what touches the lines
    std::vector<std::size_t> first_in_strip_;  // of strip i: in_strip_[first[i]] to first[i + 1]
    std::vector<std::uint32_t> in_strip_;      // images

    // The strip at hand.
    std::vector<Item> items_;
    std::vector<ProjectedTriangle> seen_;
    std::vector<Slice> slices_;
    std::vector<std::pair<double, std::uint32_t>> order_;  // in which lines meet items: place, item
    std::size_t next_in_order_ = 0;
    std::uint32_t next_line_ = 0, end_line_ = 0;

    // The line at hand.
    double line_ = 0;
    std::vector<LinePiece> opaque_, sensors_;  // all that it cuts, in order of `low`
    std::vector<LinePiece> new_opaque_, new_sensors_, merged_;
    std::vector<LinePiece> pieces_, before_;
    Envelope envelope_;
};

}  // namespace quasimc
