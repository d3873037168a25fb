#pragma once

#include <cstdint>
#include <vector>

namespace quasimc {

/// A stretch of a scan line on which one segment is seen, or a whole segment: from place `low` to
/// `high` along the line, at depths `near` and `far` of its ends (any unit, smaller is nearer).
struct LinePiece {
    double low = 0, high = 0;              ///< along the line, low < high
    double depth_low = 0, depth_high = 0;  ///< there
    std::uint32_t segment = 0;             ///< which it is a part of

    /// Depth at `x`, exact at both ends.
    [[nodiscard]] double depth(double x) const {
        const double f = (x - low) / (high - low);
        return (1 - f) * depth_low + f * depth_high;
    }
};

/// The pieces of segments that are seen from depth -infinity: the lower envelope of segments, which
/// may cross each other. Pieces come in order along the line and do not overlap. Where two segments
/// are at the same depth either is seen.
///
/// Where few segments lie over each other, as in most canopies, by a walk along the line that looks
/// at those that do; else by halves: the envelopes of neighbours along the line are merged, O(n log
/// n) for n segments.
class Envelope {
  public:
    /// @param segments  of positive length, in any order; taken as scratch
    /// @return valid until the next call
    [[nodiscard]] const std::vector<LinePiece>& of(std::vector<LinePiece>& segments);

    /// Appends to `out` what is seen of `segment` in front of pieces in order.
    static void seen_before(
        const LinePiece& segment,
        const std::vector<LinePiece>& pieces,
        std::vector<LinePiece>& out);

  private:
    /// A segment that reaches over the place at hand.
    struct Here {
        explicit Here(const LinePiece& s)
            : segment(&s), slope((s.depth_high - s.depth_low) / (s.high - s.low)) {}
        [[nodiscard]] double depth(double x) const {
            return segment->depth_low + (x - segment->low) * slope;
        }
        [[nodiscard]] LinePiece part(double from, double to) const {
            return {from, to, depth(from), depth(to), segment->segment};
        }

        const LinePiece* segment;
        double slope;
    };

    void sweep();
    void append_nearest(double x, double until);
    void merge_by_halves();

    std::vector<LinePiece> from_, to_;
    std::vector<Here> here_;
    std::vector<std::size_t> ends_, next_ends_;
};

}  // namespace quasimc
