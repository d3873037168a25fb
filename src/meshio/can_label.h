#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace quasimc {

/// The label of a triangle in Caribu, 12 digits: one or more for the optical species, five for the
/// plant, three for the leaf, three for the element. Leaf 0 is an opaque stem, or soil for species
/// 0.
struct CanLabel {
    std::int64_t species = 0, plant = 0, leaf = 0, element = 0;

    [[nodiscard]] std::int64_t number() const;
    /// Name of the material: "leaf 1", "stem 1", "soil".
    [[nodiscard]] std::string material() const;
    friend bool operator==(const CanLabel&, const CanLabel&) = default;
};

/// The label with a number, which is not negative.
[[nodiscard]] CanLabel can_label(std::int64_t number);
/// The number of a label, up to 15 digits; empty if the word is no label.
[[nodiscard]] std::optional<std::int64_t> can_label_number(std::string_view word);

}  // namespace quasimc
