#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "raster/line_hits.h"
#include "solvers/ray_bundles/patch_sides.h"

namespace quasimc {

/// Exchanges along one line, in the columns of a pack of bands.
template <std::size_t kColumns>
class LineExchange {
  public:
    /// @param forwards, backwards  receive escaping light
    /// @param ends  receives the sides from which lines leave the scene, or null
    LineExchange(
        const PatchSides<0>& sides,
        double weight,
        std::span<double> forwards,
        std::span<double> backwards,
        std::uint32_t* ends)
        : sides_(sides),
          weight_(weight),
          forwards_(forwards.data()),
          backwards_(backwards.data()),
          next_end_(ends) {}

    /// @param line  without sensors
    void exchange(std::span<const LineHits::Hit> line) {
        fetch_ahead(line[0]);
        add(backwards_, sides_.exitance(line[0]));
        for (std::size_t i = 1; i < line.size(); ++i) {
            fetch_ahead(line[i]);
            const std::size_t left = line[i - 1] ^ 1U;
            const std::size_t right = line[i];
            add(sides_.incident(right), sides_.exitance(left));
            add(sides_.incident(left), sides_.exitance(right));
        }
        end(line.back() ^ 1U);
    }

    /// Light passes sensors, which score it.
    void exchange_through_sensors(std::span<const LineHits::Hit> line) {
        std::uint32_t last = 0;        // side that light leaves forwards
        const double* from = nullptr;  // its exitance
        double* to = backwards_;       // receives light that travels backwards
        std::size_t first = 0;         // sensor since then
        for (std::size_t i = 0; i < line.size(); ++i) {
            fetch_ahead(line[i]);
            if ((line[i] & LineHits::kSensor) != 0) {
                continue;
            }
            const std::size_t at = line[i];
            pass_sensors(line.subspan(first, i - first), from, sides_.exitance(at));
            add(to, sides_.exitance(at));
            if (from != nullptr) {
                add(sides_.incident(at), from);
            }
            last = line[i] ^ 1U;
            from = sides_.exitance(last);
            to = sides_.incident(last);
            first = i + 1;
        }
        pass_sensors(line.subspan(first), from, nullptr);
        if (from != nullptr) {
            end(last);
        }
    }

    /// The end of the sides from which lines left the scene.
    [[nodiscard]] const std::uint32_t* ends() const { return next_end_; }

  private:
    /// A line leaves the scene.
    void end(std::uint32_t side) {
        add(forwards_, sides_.exitance(side));
        if (next_end_ != nullptr) {
            *next_end_++ = side;
        }
    }
    /// Exitance and incident flux never overlap: several columns are added at once.
    void add(double* __restrict to, const double* __restrict from) {
        const double weight = weight_;
        for (std::size_t c = 0; c < sides_.columns(); ++c) {
            to[c] += weight * from[c];
        }
    }
    /// Prefetches the patch that is met some steps later.
    void fetch_ahead(const LineHits::Hit& passed) const {
        const LineHits::Hit later = *(&passed + LineHits::kReadAhead) & ~LineHits::kSensor;
        sides_.fetch(later / 2);
    }
    void pass_sensors(
        std::span<const LineHits::Hit> sensors, const double* forwards, const double* backwards) {
        for (const LineHits::Hit passed : sensors) {
            const std::size_t front = passed & ~LineHits::kSensor;
            if (forwards != nullptr) {
                add(sides_.incident(front), forwards);
            }
            if (backwards != nullptr) {
                add(sides_.incident(front ^ 1U), backwards);
            }
        }
    }

    PatchSides<kColumns> sides_;
    double weight_;
    double *forwards_, *backwards_;
    std::uint32_t* next_end_;
};

}  // namespace quasimc
