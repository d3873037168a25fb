#include "sums/tally.h"

#include <algorithm>

#include "base/checks.h"
#include "base/parallel.h"

namespace quasimc {

Tally::Tally(const TallyLayout& layout, std::size_t shared_elements, std::span<std::int64_t> shared)
    : layout_(layout), shared_cells_(shared_elements * layout.stride()), shared_(shared) {
    resize_apart(own_, layout.cells() - shared_cells_);
    EXPECT(shared_elements == 0 || shared.size() == layout.cells());
    EXPECT(shared_elements <= layout.regions);
}

void Tally::merge_into(std::span<std::int64_t> total) {
    EXPECT(total.size() == layout_.cells());
    const std::span<std::int64_t> mine = total.subspan(shared_cells_);
    for (std::size_t i = 0; i < own_.size(); ++i) {
        mine[i] += own_[i];
    }
    std::fill(own_.begin(), own_.end(), 0);
}

}  // namespace quasimc
