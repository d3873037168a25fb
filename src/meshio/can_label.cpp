#include "meshio/can_label.h"

#include <algorithm>

#include <fmt/format.h>

#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr std::int64_t kElements = 1000, kLeaves = 1000, kPlants = 100000;

}  // namespace

std::int64_t CanLabel::number() const {
    return ((species * kPlants + plant) * kLeaves + leaf) * kElements + element;
}

std::string CanLabel::material() const {
    if (species == 0 && leaf == 0) {
        return "soil";
    }
    return fmt::format("{} {}", leaf == 0 ? "stem" : "leaf", species);
}

CanLabel can_label(std::int64_t number) {
    CanLabel label;
    label.element = number % kElements;
    number /= kElements;
    label.leaf = number % kLeaves;
    number /= kLeaves;
    label.plant = number % kPlants;
    label.species = number / kPlants;
    return label;
}

std::optional<std::int64_t> can_label_number(std::string_view word) {
    constexpr std::size_t kMaxDigits = 15;
    const bool is_label =
        word.size() <= kMaxDigits &&
        std::all_of(word.begin(), word.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
    return is_label ? parse_integer(word) : std::nullopt;
}

}  // namespace quasimc
