#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace quasimc {

/// A segment that a scan line cuts out of a surface, or a part of it: from `low` to `high` along
/// the line, in any unit; smaller depths are nearer.
struct VisibleSegment {
    double low = 0, high = 0;   ///< along the line
    double at_low = 0;          ///< depth there
    double slope = 0;           ///< of the depth along the line
    std::uint32_t surface = 0;  ///< its number, of the caller's

    [[nodiscard]] double depth(double x) const { return at_low + (x - low) * slope; }
    [[nodiscard]] double length() const { return high - low; }
    [[nodiscard]] VisibleSegment part(double from, double to) const {
        return {from, to, depth(from), slope, surface};
    }
};

/// The pieces of segments that are seen from depth -infinity: the lower envelope of segments, which
/// may cross each other. Pieces come in order along the line and do not overlap. Where two segments
/// are at the same depth either is seen.
///
/// A walk along the line that knows which segment is in front, and those behind it that may be seen
/// further on: O(n k), k of n segments lying over each other.
class Envelope {
  public:
    /// Sets `out` to what is seen of segments in order of `low`; those without length are passed
    /// over.
    /// @throws StopRequested  if `stop`, where there is one, says so
    void find(
        std::span<const VisibleSegment> segments,
        std::vector<VisibleSegment>& out,
        const std::stop_token* stop = nullptr);

    /// Appends to `out` what is seen of `segment` in front of pieces in order; nothing if it has no
    /// length.
    static void seen_before(
        const VisibleSegment& segment,
        std::span<const VisibleSegment> pieces,
        std::vector<VisibleSegment>& out);

  private:
    void begin(const VisibleSegment& segment);
    void take_over(const VisibleSegment& segment, double x);
    void watch(const VisibleSegment& segment, double x);
    [[nodiscard]] bool look_at(const VisibleSegment& segment, double x);
    void look_behind(double x);
    void go_on();
    void put(double until);

    const VisibleSegment* front_ = nullptr;      // the nearest at the current position
    double from_ = 0, until_ = 0;                // where it is known to be so
    const VisibleSegment* crossing_ = nullptr;   // what passes it at until_; none: it ends there
    std::vector<const VisibleSegment*> behind_;  // what may yet come to the front
    std::vector<VisibleSegment>* out_ = nullptr;
};

}  // namespace quasimc
