#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "quasimc/base/vec3.h"
#include "quasimc/geometry/beam_plane.h"
#include "quasimc/geometry/envelope.h"

namespace quasimc {

/// A stretch of a triangle that a beam lights along a scan line.
struct LitSegment {
    std::uint32_t triangle = 0;  ///< of the mesh
    double length = 0;           ///< along the line, see ScanLines::area()
    double u[2] = {0, 0};        ///< barycentric coordinates of both ends
    double v[2] = {0, 0};
    double cosine = 0;  ///< dot(unit normal of the upper side, direction of the beam)
};

/// Parallel scan lines across a beam, and what of the scene each of them sees: exact visible
/// segments, so that length x area() summed over lines is the area of the beam that a triangle
/// catches. With a uniform shift of the lines that is unbiased; its variance falls with about the
/// third power of the number of lines, the rotation taking care of edges along the lines.
///
/// Objects are used by one thread, and hold buffers for the next beam.
class ScanLines {
  public:
    /// Lines of one beam.
    struct Spec {
        Vec3 direction;           ///< unit, in which the light travels
        double rotation = 0;      ///< of the lines about it, see BeamPlane
        double shift = 0;         ///< 0..1, of the pitch
        std::uint32_t lines = 1;  ///< across the scene
    };

    /// Lines that are handed out together.
    static constexpr std::uint32_t kBin = 8;
    [[nodiscard]] static std::uint32_t bins(std::uint32_t lines) {
        return (lines + kBin - 1) / kBin;
    }

    /// @param scene  with at least one triangle; its mesh and roles must outlive the lines
    void set(const BeamScene& scene, const Spec& spec);

    /// Area across the beam that a line stands for, local units squared per unit of its length.
    [[nodiscard]] double area() const { return area_; }
    /// Calls `visit` for what is lit along the lines of a bin: line after line, in order along
    /// each; then what sensors of the line see.
    void visit(std::uint32_t bin, const std::function<void(const LitSegment&)>& visit);

  private:
    /// A triangle of the bin at hand: place along the lines, across them, and depth of each corner.
    struct Corners {
        double s[3], t[3], z[3];
        double cosine;
        std::uint32_t triangle;
        bool transparent;
    };
    /// A triangle in a bin, to be moved by `offset` across the lines.
    struct Entry {
        std::uint32_t triangle = 0;
        double offset = 0;
    };
    struct BinRange {
        std::uint32_t first = 0, last = 0;
    };
    /// A triangle's cut with a line.
    struct Cut {
        const Corners* corners;
        double u[2], v[2], low, high;
    };

    void find_images();
    void fill_bins();
    [[nodiscard]] Corners corners_of(const Entry& entry) const;
    void cut_all(double line);
    void add_cut(const Corners& corners, double line);
    /// Adds what a line passes of a cut.
    void add_piece(const Cut& cut, const LinePiece& part);
    void add_periods(const Cut& cut, double z_low, double z_high);
    [[nodiscard]] LitSegment segment_of(const LinePiece& piece) const;

    BeamScene scene_;
    Spec spec_;
    std::optional<BeamPlane> plane_;
    double pitch_ = 0, area_ = 0;
    std::vector<Entry> images_;                // scratch: what touches the lines
    std::vector<BinRange> range_;              // scratch: the bins of each
    std::vector<std::uint32_t> first_in_bin_;  // of bin i: entries_[first[i]] to first[i + 1]
    std::vector<Entry> entries_;
    std::vector<Corners> corners_;
    std::vector<Cut> cuts_;
    std::vector<LinePiece> opaque_, sensors_, seen_;
    Envelope envelope_;
};

}  // namespace quasimc
