#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr std::string_view kKey = "at";
constexpr std::size_t kFewest = 3, kMost = 5;

/// [x, y, z], [x, y, z, heading_deg] or [x, y, z, heading_deg, scale]; the defaults are 0 and 1.
/// Empty after a fault.
std::optional<std::array<double, kMost>> read_numbers(TableReader& table, const Node& node) {
    const auto* list = node.as<Node::List>();
    if (list == nullptr || list->size() < kFewest || list->size() > kMost) {
        table.fault_at(
            node, "a copy in at is not a list of 3 to 5 numbers",
            "it must be [x, y, z], [x, y, z, heading_deg] or [x, y, z, heading_deg, scale]");
        return std::nullopt;
    }
    std::array<double, kMost> numbers{0, 0, 0, 0, 1};
    for (std::size_t i = 0; i < list->size(); ++i) {
        const auto number = table.real_at(kKey, (*list)[i], TableReader::kFinite);
        if (!number) {
            return std::nullopt;
        }
        numbers[i] = *number;
    }
    if (!(numbers[4] > 0)) {
        table.fault_at(
            node, fmt::format("the scale of a copy is {}", numbers[4]), "it must be more than 0");
        return std::nullopt;
    }
    return numbers;
}

/// The transform of a copy: scaling, clockwise rotation seen from above, and shift; the file's
/// axes.
Affine copy_at(const std::array<double, kMost>& numbers, const Orientation& orientation) {
    const auto& [x, y, z, heading_deg, scale] = numbers;
    const double angle = heading_deg * std::numbers::pi / 180;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    Affine affine;
    if (orientation.up() == UpAxis::z) {
        affine.rows = {Vec3{c, s, 0}, Vec3{-s, c, 0}, Vec3{0, 0, scale}};
    } else {
        // y up: z and x become x and y.
        affine.rows = {Vec3{c, 0, -s}, Vec3{0, scale, 0}, Vec3{s, 0, c}};
    }
    affine.shift = {x, y, z};
    return affine;
}

}  // namespace

std::optional<std::vector<Affine>> read_copies(TableReader& table, const Orientation& orientation) {
    const Node* node = table.any(kKey);
    if (node == nullptr) {
        return std::nullopt;
    }
    const auto* list = node->as<Node::List>();
    const auto is_list = [](const Node& item) { return item.as<Node::List>() != nullptr; };
    if (list == nullptr || std::none_of(list->begin(), list->end(), is_list)) {
        table.fault_at(*node, "at is not a list of copies", "it must be [[x, y, z], ...]");
        return std::nullopt;
    }
    std::vector<Affine> copies;
    copies.reserve(list->size());
    for (const Node& item : *list) {
        const auto numbers = read_numbers(table, item);
        if (table.reporter().is_full()) {
            return std::nullopt;
        }
        if (numbers) {
            copies.push_back(copy_at(*numbers, orientation));
        }
    }
    return table.failed() ? std::nullopt : std::optional(std::move(copies));
}

}  // namespace quasimc
