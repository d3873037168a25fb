#include "sums/sum_collector.h"

#include <algorithm>

namespace quasimc {
namespace {

/// Whether there are too many regions for their sums to fit into a cache. Workers then hardly ever
/// add to the same one, and tallies of their own save no time, but take as much memory as the sums.
/// Bands do not matter: they are added to in a row.
bool are_rarely_met(const SumLayout& layout) {
    constexpr std::size_t kManyRegions = 1 << 17;
    constexpr std::size_t kFewBins = 8;
    return layout.regions() >= kManyRegions && layout.stride() <= kFewBins;
}

}  // namespace

SumCollector::SumCollector(
    SumData& sums, unsigned workers, double most_private_bytes, std::size_t private_regions)
    : sums_(sums), mutexes_(sums.replicates.size()) {
    const SumLayout& layout = sums.layout;
    const double bytes = static_cast<double>(layout.bins()) * sizeof(std::int64_t) * workers;
    if (bytes > most_private_bytes || are_rarely_met(layout)) {
        shared_regions_ = layout.regions() - std::min(private_regions, layout.regions());
    }
    for (unsigned i = 0; i < workers; ++i) {
        workers_.push_back({Tally(layout, shared_regions_, sums.replicates[0].shared()), 0});
    }
}

void SumCollector::leave(Worker& worker) {
    const std::lock_guard lock(mutexes_[worker.replicate]);
    ExactBins& total = sums_.replicates[worker.replicate];
    const bool is_full = worker.tally.is_full();
    worker.tally.move_into(total);
    if (is_full && shared_regions_ > 0) {
        total.settle();
    }
}

Tally& SumCollector::tally_for(unsigned worker, std::uint32_t replicate) {
    Worker& mine = workers_[worker];
    if (mine.replicate != replicate || mine.tally.is_full()) {
        leave(mine);
        mine.replicate = replicate;
        mine.tally.share(sums_.replicates[replicate].shared());
    }
    return mine.tally;
}

void SumCollector::collect() {
    for (Worker& worker : workers_) {
        leave(worker);
    }
}

}  // namespace quasimc
