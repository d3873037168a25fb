#include "results/quantities.h"

namespace quasimc {

const std::array<QuantityEntry, kQuantities>& quantity_table() {
    static constexpr std::array kTable = [] {
        std::array<QuantityEntry, kQuantities> entries{};
        for (std::size_t i = 0; i < kQuantities; ++i) {
            entries[i] = kQuantityRows[i].entry;
        }
        return entries;
    }();
    return kTable;
}

}  // namespace quasimc
