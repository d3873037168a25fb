#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/line_hits.h"

namespace quasimc {

/// The hits of the lines of several beams, cached for repeated exchanges.
class LineCache {
  public:
    /// The lines of a beam, as LineHits has them.
    class Beam {
      public:
        Beam(std::span<const LineHits::Hit> hits, std::span<const std::uint32_t> lengths)
            : hits_(hits), lengths_(lengths) {}

        /// Number of hits of all lines.
        [[nodiscard]] std::size_t size() const { return hits_.size(); }
        /// See LineHits::for_each_line().
        template <typename Visit>
        void for_each_line(const Visit& visit) const {
            std::size_t first = 0;
            for (const std::uint32_t length : lengths_) {
                visit(hits_.subspan(first, length));
                first += length;
            }
        }

      private:
        std::span<const LineHits::Hit> hits_;
        std::span<const std::uint32_t> lengths_;
    };

    void add(const LineHits& lines) {
        hits_.resize(size_);
        starts_.push_back({size_, lengths_.size()});
        lines.for_each_line([&](std::span<const LineHits::Hit> line) {
            hits_.insert(hits_.end(), line.begin(), line.end());
            lengths_.push_back(static_cast<std::uint32_t>(line.size()));
        });
        size_ = hits_.size();
        hits_.resize(size_ + LineHits::kReadAhead);
    }
    void clear() {
        hits_.clear();
        lengths_.clear();
        starts_.clear();
        size_ = 0;
    }

    /// Number of hits of all beams.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// The `i`-th beam. Valid until another one is added.
    [[nodiscard]] Beam beam(std::size_t i) const {
        const Start& start = starts_[i];
        const Start end = i + 1 < starts_.size() ? starts_[i + 1] : Start{size_, lengths_.size()};
        return {
            std::span(hits_).subspan(start.hit, end.hit - start.hit),
            std::span(lengths_).subspan(start.line, end.line - start.line)};
    }

  private:
    struct Start {
        std::size_t hit = 0, line = 0;
    };
    std::vector<LineHits::Hit> hits_;     // the first size_, and as many as may be read ahead
    std::vector<std::uint32_t> lengths_;  // by line
    std::vector<Start> starts_;           // by beam
    std::size_t size_ = 0;
};

}  // namespace quasimc
