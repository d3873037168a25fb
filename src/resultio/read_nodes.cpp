#include "resultio/read_nodes.h"

#include <cstdint>
#include <limits>

namespace quasimc {

double number_in(const Node& table, std::string_view key) {
    const Node* node = table.find(key);
    const auto* real = node != nullptr ? node->as<double>() : nullptr;
    const auto* whole = node != nullptr ? node->as<std::int64_t>() : nullptr;
    return real != nullptr    ? *real
           : whole != nullptr ? static_cast<double>(*whole)
                              : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t count_in(const Node& table, std::string_view key) {
    const Node* node = table.find(key);
    const auto* whole = node != nullptr ? node->as<std::int64_t>() : nullptr;
    return whole != nullptr && *whole > 0 ? static_cast<std::uint64_t>(*whole) : 0;
}

bool flag_in(const Node& table, std::string_view key) {
    const Node* found = table.find(key);
    const auto* flag = found != nullptr ? found->as<bool>() : nullptr;
    return flag != nullptr && *flag;
}

Estimate estimate_in(const Node* table, std::string_view key) {
    const Node* found = table != nullptr ? table->find(key) : nullptr;
    return found == nullptr ? kUnknownEstimate
                            : Estimate{
                                  number_in(*found, "mean"), number_in(*found, "standard_error"),
                                  number_in(*found, "ci95_low"), number_in(*found, "ci95_high")};
}

const Node* item_at(const Node* list, std::size_t index) {
    const auto* items = list != nullptr ? list->as<Node::List>() : nullptr;
    return items != nullptr && index < items->size() ? &(*items)[index] : nullptr;
}

}  // namespace quasimc
