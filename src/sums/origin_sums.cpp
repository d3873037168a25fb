#include "sums/origin_sums.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// The blocks of sums whose origins are not kept apart.
SumBlocks joined_blocks(const SumBlocks& blocks) {
    SumBlocks joined = blocks;
    for (SumBlock& block : joined) {
        block.origins = 1;
    }
    return joined;
}

/// The origins that a column is the sum of: [first, end) of those of its block. Empty: it is 0.
struct OriginRange {
    std::uint32_t first = 0, end = 0;
};

/// Adds up origins, bin by bin.
class OriginAdder {
  public:
    /// @param origin  none: all
    OriginAdder(const SumData& from, std::optional<std::size_t> origin)
        : from_(from),
          origin_(origin),
          to_(from.layout.regions(), joined_blocks(from.layout.blocks())) {
        for (const SumBlock& block : from.layout.blocks()) {
            const BlockBins own = from.layout.find(block.name), joined = to_.find(block.name);
            for (std::size_t column = 0; column < block.columns.size(); ++column) {
                const OriginRange range = origins_of(block, column);
                for (std::uint32_t each = range.first; each < range.end; ++each) {
                    const Addition addition{own.of_origin(each) + column, joined.bin(0, column)};
                    (own.stride > 0 ? of_regions_ : of_run_).push_back(addition);
                }
            }
        }
    }

    [[nodiscard]] const SumLayout& layout() const { return to_; }

    [[nodiscard]] ExactBins add(const ExactBins& bins) const {
        ExactBins sums(to_.bins());
        for (std::size_t region = 0; region < to_.regions(); ++region) {
            const std::size_t from = region * from_.layout.stride(), to = region * to_.stride();
            for (const Addition& each : of_regions_) {
                sums.add(to + each.to, bins.quanta(from + each.from));
            }
        }
        for (const Addition& each : of_run_) {
            sums.add(each.to, bins.quanta(each.from));
        }
        return sums;
    }

  private:
    /// A bin of the first region, or of the run, and that which it is added to.
    struct Addition {
        std::size_t from, to;
    };

    [[nodiscard]] OriginRange origins_of(const SumBlock& block, std::size_t column) const {
        if (!origin_) {
            return {0, block.origins};
        }
        const SumColumn& of = block.columns[column];
        if (of.of == SumColumn::Of::spectrum) {
            const std::vector<std::size_t>& own = from_.origins[*origin_].spectra;
            return {0, std::ranges::find(own, of.index) != own.end() ? 1U : 0U};
        }
        const auto own = static_cast<std::uint32_t>(*origin_);
        return block.origins > 1 ? OriginRange{own, own + 1} : OriginRange{0, 1};
    }

    const SumData& from_;
    std::optional<std::size_t> origin_;
    SumLayout to_;
    std::vector<Addition> of_regions_, of_run_;
};

/// The meaning of sums whose origins were added up.
SumData meaning_of_added(const SumData& sums, const OriginAdder& adder) {
    SumData added = meaning_of(sums);
    added.layout = adder.layout();
    added.origins.clear();
    added.paths = sums.paths;
    added.samples = sums.samples;
    added.digest = sums.digest;
    for (const ExactBins& bins : sums.replicates) {
        added.replicates.push_back(adder.add(bins));
    }
    return added;
}

/// Whether a strategy samples light of an origin.
bool samples(const SamplingStrategy& strategy, const SumOrigin& origin) {
    const auto is_own = [&](std::size_t spectrum) {
        return std::ranges::find(origin.spectra, spectrum) != origin.spectra.end();
    };
    return strategy.spectra.empty() ? strategy.has_suns && origin.has_suns
                                    : std::ranges::any_of(strategy.spectra, is_own);
}

}  // namespace

Sums of_all_origins(const Sums& sums) {
    return Sums(meaning_of_added(*sums, OriginAdder(*sums, std::nullopt)));
}

Sums of_origin(const Sums& sums, std::size_t origin) {
    SumData own = meaning_of_added(*sums, OriginAdder(*sums, origin));
    const SumOrigin& light = sums->origins[origin];
    own.units.sunlit_area = 0;
    own.emitted_flux = light.emitted_flux;
    for (ContributionBound& bound : own.bounds) {
        for (std::size_t b = 0; b < bound.largest.size() && bound.quantity != "sunlit"; ++b) {
            bound.largest[b] *= light.emitted_flux[b] > 0 ? 1 : 0;
        }
    }
    for (SamplingStrategy& strategy : own.strategies) {
        if (!samples(strategy, light)) {
            std::ranges::fill(strategy.flux, 0);
        }
    }
    return Sums(std::move(own));
}

}  // namespace quasimc
