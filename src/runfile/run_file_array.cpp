// Reads a regular array of copies: { start, along, across, counts, spread }.

#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/copies.h"

namespace quasimc {
namespace {

constexpr Range kCounts{1, 1e6};

/// A pseudorandom number in [-1, 1), a pure function of its arguments: FNV-1a over the texts, then
/// the finalizer of splitmix64 (Steele, Lea and Flood 2014).
double deviation(std::string_view name, std::string_view key, std::uint64_t copy) {
    std::uint64_t hash = 14695981039346656037U;
    const auto add = [&](unsigned char byte) { hash = (hash ^ byte) * 1099511628211U; };
    for (const std::string_view text : {name, key}) {
        for (const char c : text) {
            add(static_cast<unsigned char>(c));
        }
        add(0);
    }
    std::uint64_t x = hash + copy * 0x9E3779B97F4A7C15U;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    x ^= x >> 31U;
    return static_cast<double>(x >> 11U) * 0x1p-52 - 1;
}

/// Numbers of copies along `along` and `across`.
std::optional<std::array<std::int64_t, 2>> read_counts(TableReader& array) {
    const Node* node = array.any("counts");
    const auto* list = node != nullptr ? node->as<Node::List>() : nullptr;
    const bool has_across = array.any("across") != nullptr;
    if (list == nullptr) {
        const auto count = array.required("counts", array.integer("counts", kCounts));
        if (count && has_across) {
            array.fault_at(
                "counts", "counts is one number but there is across", "",
                fmt::format("give two numbers, counts = [{}, 2], or leave across out", *count));
            return std::nullopt;
        }
        return count ? std::optional(std::array<std::int64_t, 2>{*count, 1}) : std::nullopt;
    }
    std::array<std::int64_t, 2> counts{1, 1};
    const bool is_pair = list->size() == counts.size();
    for (std::size_t i = 0; is_pair && i < counts.size(); ++i) {
        const auto* count = (*list)[i].as<std::int64_t>();
        counts[i] = count == nullptr ? 0 : *count;
    }
    const auto is_good = [](std::int64_t n) { return n >= 1 && n <= std::int64_t{1000000}; };
    if (!is_pair || !is_good(counts[0]) || !is_good(counts[1])) {
        array.fault_at(
            "counts", "counts is not a number of copies",
            "it must be a whole number from 1 to 1e6, or two of them");
        return std::nullopt;
    }
    if (!has_across) {
        array.fault_at(
            "counts", "counts has 2 numbers but there is no across", "",
            "give across, or one number");
        return std::nullopt;
    }
    return counts;
}

/// The half widths of `spread` by key.
Node::Table read_spread(TableReader& array) {
    const Node* node = array.any("spread");
    const auto* members = node != nullptr ? node->as<Node::Table>() : nullptr;
    if (node == nullptr) {
        return {};
    }
    if (members == nullptr) {
        array.fault_at(
            *node, fmt::format("spread is {}", node->type_name()),
            "it must be a table of half widths: spread = { heading_deg = 180 }");
        return {};
    }
    TableReader keys(*node, array.what() + ": spread", array.reporter());
    Node::Table spread;
    CopyRow known;
    for (const Member& member : *members) {
        // The scale of a copy stays above 0.
        const Range range = member.key == "scale" ? Range{0, 0.99} : TableReader::kNotNegative;
        if (number_of_row(known, member.key) == nullptr) {
            continue;
        }
        if (const auto width = keys.real(member.key, range)) {
            spread.push_back({member.key, member.line, Node{*width, member.line}});
        }
    }
    for (const std::string_view key :
         {"x", "y", "z", "heading_deg", "tilt_deg", "roll_deg", "scale"}) {
        static_cast<void>(keys.any(key));
    }
    keys.finish();
    return spread;
}

}  // namespace

std::optional<CopyArray> read_array(TableReader& array, std::string_view name) {
    const auto start = array.required("start", array.vector("start"));
    const auto along = array.required("along", array.vector("along"));
    const auto across = array.vector("across");
    const auto counts = read_counts(array);
    const Node::Table spread = read_spread(array);
    if (!start || !along || !counts || array.failed()) {
        return std::nullopt;
    }
    const auto [n, m] = *counts;
    CopyArray result{.rows = {}, .along = n};
    if (n * m > static_cast<std::int64_t>(kCounts.high)) {
        array.fault_at("counts", fmt::format("{} copies", n * m), "at most 1e6 are possible");
        return std::nullopt;
    }
    for (std::int64_t k = 0; k < n * m; ++k) {
        CopyRow row{.line = array.line()};
        const std::int64_t i = k % n, j = k / n;
        row.position = *start + ((static_cast<double>(i) + 0.5) / static_cast<double>(n)) * *along;
        if (across) {
            row.position += ((static_cast<double>(j) + 0.5) / static_cast<double>(m)) * *across;
        }
        for (const Member& width : spread) {
            *number_of_row(row, width.key) +=
                *width.node.as<double>() *
                deviation(name, width.key, static_cast<std::uint64_t>(k) + 1);
        }
        result.rows.push_back(std::move(row));
    }
    return result;
}

}  // namespace quasimc
