// Scattered light that leaves the scene, by the zenith angle of its direction.
//
// Method   Rings of equal width from the zenith (0 degrees) to the nadir (180 degrees).
// Theory   docs/theory/geometry.md

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "base/text.h"
#include "detectors/detector.h"

namespace quasimc {
namespace {

class EscapedByZenith final : public Detector {
  public:
    explicit EscapedByZenith(std::size_t rings) : rings_(rings) {}

    [[nodiscard]] DetectorAxis axis() const override {
        DetectorAxis axis{"zenith angle (deg)", {}};
        const auto bound = [&](std::size_t i) {
            return shortest(180 * static_cast<double>(i) / static_cast<double>(rings_));
        };
        for (std::size_t i = 0; i < rings_; ++i) {
            axis.bins.push_back(fmt::format("{} to {}", bound(i), bound(i + 1)));
        }
        return axis;
    }

    void on_escape(
        const Vec3& direction,
        std::span<const std::int64_t> amounts,
        std::size_t first,
        Tally& tally) const override {
        const std::size_t ring = first + ring_of(direction) * amounts.size();
        for (std::size_t i = 0; i < amounts.size(); ++i) {
            tally.add_signed(ring + i, amounts[i]);
        }
    }

  private:
    /// The ring of a direction, by atan2, which is also accurate near the zenith.
    [[nodiscard]] std::size_t ring_of(const Vec3& direction) const {
        const double angle = std::atan2(std::hypot(direction.x, direction.y), direction.z);
        const double ring = angle / std::numbers::pi * static_cast<double>(rings_);
        return std::min(static_cast<std::size_t>(ring), rings_ - 1);
    }

    std::size_t rings_;
};

}  // namespace

/// The type `escaped_by_zenith` of the catalogue.
std::unique_ptr<Detector> make_escaped_by_zenith(std::span<const double> values) {
    return std::make_unique<EscapedByZenith>(static_cast<std::size_t>(values[0]));
}

}  // namespace quasimc
