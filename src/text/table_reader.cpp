#include "text/table_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/text.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

std::string range_text(Range range) {
    if (range.low == TableReader::kFinite.low && range.high == TableReader::kFinite.high) {
        return "it must be a finite number";
    }
    if (range.low == std::numeric_limits<double>::min()) {
        return "it must be more than 0";
    }
    if (range.high == TableReader::kFinite.high) {
        return fmt::format("it must be a finite number of at least {}", range.low);
    }
    return fmt::format("it must be {} to {}", range.low, range.high);
}

std::optional<double> number_of(const Node& node) {
    if (const auto* integer = node.as<std::int64_t>()) {
        return static_cast<double>(*integer);
    }
    const auto* real = node.as<double>();
    return real ? std::optional(*real) : std::nullopt;
}

std::optional<std::string> text_of(const Node& node) {
    const auto* text = node.as<std::string>();
    return text ? std::optional(*text) : std::nullopt;
}

/// A time as a text or as a date-time of TOML.
std::optional<std::string> time_of(const Node& node) {
    const auto* other = node.as<Node::Other>();
    return other != nullptr && !other->text.empty() ? other->text : text_of(node);
}

}  // namespace

std::string Vocabulary::name_of(std::string_view key) const {
    const auto found = std::ranges::find(names_, key, &TableName::key);
    return found == names_.end() ? fmt::format("[{}]", key) : std::string(found->name);
}

std::string Reporter::where(std::uint32_t line) const {
    return line == 0 ? file : fmt::format("{}:{}", file, line);
}

void Reporter::fault(
    std::uint32_t line, std::string problem, std::string why, std::string suggestion) {
    faults.add({where(line), std::move(problem), std::move(why), std::move(suggestion)});
}

void Reporter::add(const Reporter& other) {
    faults.add(other.faults);
    warnings.insert(warnings.end(), other.warnings.begin(), other.warnings.end());
}

TableReader::TableReader(const Node& node, std::string what, Reporter& reporter)
    : node_(&node),
      what_(std::move(what)),
      reporter_(&reporter),
      faults_before_(reporter.faults.size()) {
    if (node.as<Node::Table>() == nullptr) {
        fault(fmt::format("is {}", node.type_name()), "it must be a table of keys");
    }
}

const Node* TableReader::any(std::string_view key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
        known_.push_back(key);
    }
    return node_->find(key);
}

template <typename T>
std::optional<T> TableReader::typed(std::string_view key, std::string_view expected) {
    const Node* node = any(key);
    const T* value = node != nullptr ? node->as<T>() : nullptr;
    if (node != nullptr && value == nullptr) {
        wrong_type(key, *node, expected);
    }
    return value != nullptr ? std::optional(*value) : std::nullopt;
}

std::optional<std::string> TableReader::text(std::string_view key) {
    return typed<std::string>(key, "a text");
}

std::optional<bool> TableReader::boolean(std::string_view key) {
    return typed<bool>(key, "true or false");
}

std::optional<std::string> TableReader::time_text(std::string_view key) {
    const Node* node = any(key);
    std::optional<std::string> text = node != nullptr ? time_of(*node) : std::nullopt;
    if (node != nullptr && !text) {
        wrong_type(key, *node, "a time as 2024-06-21T12:00:00+02:00");
    }
    return text;
}

std::optional<std::vector<std::string>> TableReader::list_of(
    std::string_view key,
    std::optional<std::string> (*read)(const Node& node),
    std::string_view items) {
    const Node* node = any(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const auto* list = node->as<Node::List>();
    if (list == nullptr) {
        wrong_type(key, *node, fmt::format("a list of {}", items));
        return std::nullopt;
    }
    std::vector<std::string> result;
    for (const Node& item : *list) {
        std::optional<std::string> text = read(item);
        if (!text) {
            wrong_type(key, item, fmt::format("{} only", items));
            return std::nullopt;
        }
        result.push_back(std::move(*text));
    }
    return result;
}

std::optional<std::vector<std::string>> TableReader::texts(std::string_view key) {
    return list_of(key, text_of, "texts");
}

std::optional<std::vector<std::string>> TableReader::time_texts(std::string_view key) {
    return list_of(key, time_of, "times");
}

std::optional<std::int64_t> TableReader::integer(std::string_view key, Range range) {
    const Node* node = any(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const auto* given = node->as<std::int64_t>();
    const auto* real = node->as<double>();
    const std::optional<std::int64_t> integer = given  ? std::optional(*given)
                                                : real ? whole_number(*real)
                                                       : std::nullopt;
    if (!integer) {
        wrong_type(key, *node, "an integer");
        return std::nullopt;
    }
    const auto value = static_cast<double>(*integer);
    if (value < range.low || value > range.high) {
        fault_at(*node, fmt::format("{} is {}", key, *integer), range_text(range));
        return std::nullopt;
    }
    return *integer;
}

std::optional<double> TableReader::real(std::string_view key, Range range) {
    const Node* node = any(key);
    return node ? real_at(key, *node, range) : std::nullopt;
}

std::optional<Vec3> TableReader::vector(std::string_view key) {
    const Node* node = any(key);
    return node ? vector_of(key, *node) : std::nullopt;
}

std::optional<std::vector<Vec3>> TableReader::vectors(std::string_view key) {
    const Node* node = any(key);
    return node ? vectors_at(key, *node) : std::nullopt;
}

std::optional<std::vector<Vec3>> TableReader::vectors_at(std::string_view key, const Node& node) {
    const auto* list = node.as<Node::List>();
    if (list == nullptr) {
        wrong_type(key, node, "a list of points [x, y, z]");
        return std::nullopt;
    }
    std::vector<Vec3> points;
    points.reserve(list->size());
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::optional<Vec3> point = vector_of(fmt::format("{}[{}]", key, i), (*list)[i]);
        if (!point) {
            return std::nullopt;
        }
        points.push_back(*point);
    }
    return points;
}

std::optional<std::string> TableReader::choice(
    std::string_view key, std::span<const std::string_view> names) {
    std::optional<std::string> name = text(key);
    if (name && std::find(names.begin(), names.end(), *name) == names.end()) {
        fault_at(
            key, fmt::format("{}: '{}' is not one of {}", key, *name, joined(names, ", ")), "",
            near_word_text(*name, names));
        return std::nullopt;
    }
    return name;
}

std::vector<const Node*> TableReader::tables(std::string_view key) {
    std::vector<const Node*> result;
    const Node* node = any(key);
    if (node == nullptr) {
        return result;
    }
    const auto* list = node->as<Node::List>();
    if (list == nullptr) {
        fault_at(
            *node, fmt::format("{} is {}", key, node->type_name()), "it must be a list of tables",
            fmt::format("write [[{}]] above it", key));
        return result;
    }
    for (const Node& item : *list) {
        if (item.as<Node::Table>() != nullptr) {
            result.push_back(&item);
        } else {
            wrong_type(key, item, "tables only");
        }
    }
    return result;
}

void TableReader::missing(std::string_view key, const std::string& suggestion) {
    fault(fmt::format("{} is missing", key), "", suggestion);
}

void TableReader::fault(std::string problem, std::string why, std::string suggestion) {
    fault_at(*node_, std::move(problem), std::move(why), std::move(suggestion));
}

void TableReader::fault_at(
    std::string_view key, std::string problem, std::string why, std::string suggestion) {
    const Node* node = node_->find(key);
    fault_at(node ? *node : *node_, std::move(problem), std::move(why), std::move(suggestion));
}

void TableReader::fault_at(
    const Node& node, std::string problem, std::string why, std::string suggestion) {
    const std::string subject = what_.empty() ? "" : what_ + ": ";
    const std::uint32_t line = node.line > 0 ? node.line : node_->line;
    reporter_->fault(line, subject + std::move(problem), std::move(why), std::move(suggestion));
}

void TableReader::warn_at(const Node& node, std::string text) {
    const std::string subject = what_.empty() ? "" : what_ + ": ";
    reporter_->warnings.push_back({reporter_->where(node.line), subject + std::move(text)});
}

void TableReader::finish() {
    const auto* table = node_->as<Node::Table>();
    if (table == nullptr) {
        return;
    }
    for (const Member& member : *table) {
        if (std::find(known_.begin(), known_.end(), member.key) == known_.end()) {
            const std::string subject = what_.empty() ? "" : what_ + ": ";
            reporter_->fault(
                member.line, fmt::format("{}unknown key '{}'", subject, member.key), "",
                did_you_mean(member.key, known_));
        }
    }
}

std::optional<double> TableReader::real_at(std::string_view key, const Node& node, Range range) {
    const std::optional<double> value = number_of(node);
    if (!value) {
        wrong_type(key, node, "a number");
        return std::nullopt;
    }
    if (!std::isfinite(*value) || *value < range.low || *value > range.high) {
        fault_at(node, fmt::format("{} is {}", key, *value), range_text(range));
        return std::nullopt;
    }
    return value;
}

std::optional<Range> TableReader::interval_at(std::string_view key, const Node& node, Range range) {
    const auto* list = node.as<Node::List>();
    if (list == nullptr || list->size() != 2) {
        fault_at(node, fmt::format("{} is not a pair of numbers", key), "it must be [low, high]");
        return std::nullopt;
    }
    const auto low = real_at(key, (*list)[0], range);
    const auto high = real_at(key, (*list)[1], range);
    if (!low || !high) {
        return std::nullopt;
    }
    if (!(*low < *high)) {
        fault_at(
            node, fmt::format("{} is [{}, {}]", key, *low, *high),
            "the first must be less than the second");
        return std::nullopt;
    }
    return Range{*low, *high};
}

std::optional<Vec3> TableReader::vector_of(std::string_view key, const Node& node) {
    const auto* list = node.as<Node::List>();
    if (list == nullptr || list->size() != 3) {
        wrong_type(key, node, "three numbers [x, y, z]");
        return std::nullopt;
    }
    std::array<double, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> value = real_at(key, (*list)[i], kFinite);
        if (!value) {
            return std::nullopt;
        }
        v[i] = *value;
    }
    return Vec3{v[0], v[1], v[2]};
}

void TableReader::wrong_type(std::string_view key, const Node& node, std::string_view expected) {
    const auto* list = node.as<Node::List>();
    const std::string found =
        list ? fmt::format("a list of {}", list->size()) : std::string(node.type_name());
    fault_at(node, fmt::format("{} is {}", key, found), fmt::format("it must be {}", expected));
}

}  // namespace quasimc
