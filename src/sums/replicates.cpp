#include "sums/replicates.h"

#include <algorithm>

namespace quasimc {

Replicates::Replicates(
    const TallyLayout& layout,
    std::uint32_t count,
    unsigned workers,
    double most_private_bytes,
    std::size_t private_regions)
    : layout_(layout), cells_(count), mutexes_(count) {
    const double bytes = static_cast<double>(layout.cells()) * sizeof(std::int64_t) * workers;
    if (bytes > most_private_bytes) {
        shared_elements_ = layout.regions - std::min(private_regions, layout.regions);
    }
    for (auto& cells : cells_) {
        cells.resize(layout.cells());
    }
    for (unsigned i = 0; i < workers; ++i) {
        workers_.push_back({Tally(layout, shared_elements_, cells_[0]), 0});
    }
}

void Replicates::leave(Worker& worker) {
    const std::lock_guard lock(mutexes_[worker.replicate]);
    worker.tally.merge_into(cells_[worker.replicate]);
}

Tally& Replicates::tally_for(unsigned worker, std::uint32_t replicate) {
    Worker& mine = workers_[worker];
    if (mine.replicate != replicate) {
        leave(mine);
        mine.replicate = replicate;
        mine.tally.share(cells_[replicate]);
    }
    return mine.tally;
}

void Replicates::collect() {
    for (Worker& worker : workers_) {
        leave(worker);
    }
}

}  // namespace quasimc
