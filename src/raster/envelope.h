#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace quasimc {

/// A segment of a scan line on a surface, or a part of it: from `low` to `high` along the line, in
/// any unit; smaller depths are nearer.
struct VisibleSegment {
    double low = 0, high = 0;   ///< along the line
    double at_low = 0;          ///< depth at `low`
    double slope = 0;           ///< of the depth along the line
    std::uint32_t surface = 0;  ///< index assigned by the caller

    [[nodiscard]] double depth(double x) const { return at_low + (x - low) * slope; }
    [[nodiscard]] double length() const { return high - low; }
    [[nodiscard]] VisibleSegment part(double from, double to) const {
        return {from, to, depth(from), slope, surface};
    }
};

/// The lower envelope of segments, which may cross each other: their parts that are visible from
/// depth -infinity. Parts are ordered along the line and do not overlap. Where two segments have
/// equal depth either may be visible.
///
/// A sweep along the line that knows the segment in front, and those behind it that may become
/// visible: O(n k) for n segments with k of them over each other.
class Envelope {
  public:
    /// Sets `out` to the visible parts of segments in order of `low`; segments without length are
    /// ignored.
    /// @throws StopRequested  if a stop was requested through `stop`
    void find(
        std::span<const VisibleSegment> segments,
        std::vector<VisibleSegment>& out,
        const std::stop_token* stop = nullptr);

    /// Appends to `out` the parts of `segment` in front of ordered `pieces`; nothing if it has no
    /// length.
    static void seen_before(
        const VisibleSegment& segment,
        std::span<const VisibleSegment> pieces,
        std::vector<VisibleSegment>& out);

  private:
    void begin(const VisibleSegment& segment);
    void take_over(const VisibleSegment& segment, double x);
    void add_behind(const VisibleSegment& segment, double x);
    [[nodiscard]] bool note_crossing(const VisibleSegment& segment, double x);
    void update_front(double x);
    void advance();
    void put(double until);

    const VisibleSegment* front_ = nullptr;      // the nearest at the current position
    double from_ = 0, until_ = 0;                // the interval in which it stays so
    const VisibleSegment* crossing_ = nullptr;   // crosses the front at until_, if any
    std::vector<const VisibleSegment*> behind_;  // may become the front later
    std::vector<VisibleSegment>* out_ = nullptr;
};

}  // namespace quasimc
