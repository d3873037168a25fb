#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "quasimc/base/vec3.h"
#include "quasimc/geometry/envelope.h"
#include "quasimc/geometry/local_mesh.h"

namespace quasimc {

/// A stretch of a triangle that a beam lights along a scan line.
struct LitSegment {
    std::uint32_t triangle = 0;  ///< of the mesh
    double length = 0;           ///< across the beam, local units
    double u[2] = {0, 0};        ///< barycentric coordinates of both ends
    double v[2] = {0, 0};
    double cosine = 0;  ///< dot(unit normal of the upper side, direction of the beam)
};

/// Parallel scan lines across a beam, and what of the scene each of them sees: exact visible
/// segments, so that length x pitch summed over lines is the area of the beam that a triangle
/// catches. With a uniform shift of the lines that is unbiased; its variance falls with about the
/// third power of the number of lines, the rotation taking care of edges along the lines.
///
/// Objects are used by one thread, and hold buffers for the next beam.
class ScanLines {
  public:
    /// Lines of one beam.
    struct Spec {
        Vec3 direction;           ///< unit, in which the light travels
        double rotation = 0;      ///< of the lines about it, 0..1 for half a turn
        double shift = 0;         ///< 0..1, of the pitch
        std::uint32_t lines = 1;  ///< across the scene
    };

    /// Lines that are handed out together.
    static constexpr std::uint32_t kBin = 8;
    [[nodiscard]] static std::uint32_t bins(std::uint32_t lines) {
        return (lines + kBin - 1) / kBin;
    }

    /// @param transparent  by triangle of the mesh: whether light passes (a sensor); or empty
    void set(const LocalMesh& mesh, std::span<const std::uint8_t> transparent, const Spec& spec);

    /// Distance between lines, local units.
    [[nodiscard]] double pitch() const { return pitch_; }
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
    struct BinRange {
        std::uint32_t first = 0, last = 0;
    };
    /// A triangle's cut with a line.
    struct Cut {
        const Corners* corners;
        double u[2], v[2], low, high;
    };

    void fill_bins(const LocalMesh& mesh);
    [[nodiscard]] Corners corners_of(std::uint32_t triangle) const;
    void cut_all(double line);
    void add_cut(const Corners& corners, double line);
    [[nodiscard]] LitSegment segment_of(const LinePiece& piece) const;

    const LocalMesh* mesh_ = nullptr;
    std::span<const std::uint8_t> transparent_;
    Spec spec_;
    Vec3 along_, across_;  // unit vectors of the plane across the beam
    double low_ = 0, pitch_ = 0;
    std::vector<std::uint32_t> first_in_bin_, triangles_;  // of bin i: [first[i], first[i + 1])
    std::vector<BinRange> range_;                          // scratch: by triangle
    std::vector<Corners> corners_;
    std::vector<Cut> cuts_;
    std::vector<LinePiece> opaque_, sensors_, seen_;
    Envelope envelope_;
};

}  // namespace quasimc
