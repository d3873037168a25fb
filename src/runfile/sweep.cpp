#include "runfile/sweep.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.h"
#include "options/options.h"
#include "runfile/sweep_keys.h"
#include "runfile/sweep_weights.h"

namespace quasimc {
namespace {

constexpr std::string_view kSweep = "sweep";
constexpr std::string_view kCombine = "combine";
constexpr std::string_view kWeights = "weights";

}  // namespace

std::string node_text(const Node& node) {
    if (const auto* text = node.as<std::string>()) {
        return option_toml(*text);
    }
    if (const auto* integer = node.as<std::int64_t>()) {
        return option_toml(*integer);
    }
    if (const auto* real = node.as<double>()) {
        return shortest(*real);
    }
    if (const auto* boolean = node.as<bool>()) {
        return *boolean ? "true" : "false";
    }
    if (const auto* other = node.as<Node::Other>()) {
        return other->text;
    }
    const auto* list = node.as<Node::List>();
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (list != nullptr) {
        for (const Node& item : *list) {
            add(node_text(item));
        }
        return "[" + text + "]";
    }
    for (const Member& member : *node.as<Node::Table>()) {
        add(member.key + " = " + node_text(member.node));
    }
    return "{" + text + "}";
}

std::string SweptKey::from_top() const {
    return path.find('.') == std::string::npos ? "run." + path : path;
}

SweepPlan::SweepPlan(const Node& document, Reporter& reporter) {
    const Node* table = document.find(kSweep);
    if (table == nullptr) {
        return;
    }
    if (table->as<Node::Table>() == nullptr) {
        reporter.fault(
            table->line, fmt::format("sweep is {}", table->type_name()),
            "it must be a table of keys and their values");
        return;
    }
    read_keys(*table, "", reporter);
    const std::size_t given = keys_.size();
    std::erase_if(keys_, [&](const SweptKey& key) { return is_refused(document, key, reporter); });
    check_keys(reporter);
    if (given > 0 || reporter.faults.empty()) {
        count_points(*table, given, reporter);
    }
    if (reporter.faults.empty()) {
        weights_ = read_weights(*table, *this, reporter);
    }
}

void SweepPlan::read_keys(const Node& table, const std::string& prefix, Reporter& reporter) {
    for (const Member& member : *table.as<Node::Table>()) {
        const std::string path = prefix + member.key;
        const auto* list = member.node.as<Node::List>();
        if (path == kCombine) {
            read_combination(member, reporter);
        } else if (path == kWeights) {
            continue;  // they are read once the points are known
        } else if (member.node.as<Node::Table>() != nullptr) {
            read_keys(member.node, path + ".", reporter);
        } else if (list == nullptr || list->empty()) {
            reporter.fault(
                member.line,
                fmt::format(
                    "[sweep]: {} is {}", path,
                    list ? "an empty list" : std::string(member.node.type_name())),
                "it must be a list of values");
        } else {
            keys_.push_back({path, member.line, *list});
        }
    }
}

void SweepPlan::read_combination(const Member& member, Reporter& reporter) {
    constexpr std::array<std::string_view, 2> kCombinations{"product", "zip"};
    const auto* word = member.node.as<std::string>();
    is_zip_ = word != nullptr && *word == "zip";
    if (word == nullptr || !is_among(*word, kCombinations)) {
        reporter.fault(
            member.line, fmt::format("[sweep]: combine is {}", node_text(member.node)),
            "it must be \"product\" or \"zip\"",
            word == nullptr ? "" : did_you_mean(*word, kCombinations));
    }
}

/// Refuses keys that set the same value.
void SweepPlan::check_keys(Reporter& reporter) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const std::string a = keys_[i].from_top();
            const std::string b = keys_[j].from_top();
            if (a == b || rest_after(a, b) || rest_after(b, a)) {
                reporter.fault(
                    keys_[i].line,
                    fmt::format(
                        "[sweep]: {} and {} set the same value", keys_[j].path, keys_[i].path),
                    "one of them would be ignored", "remove one");
            }
        }
    }
}

void SweepPlan::count_points(const Node& table, std::size_t given, Reporter& reporter) {
    if (given == 0) {
        reporter.fault(table.line, "[sweep]: it has no keys", "nothing varies", "remove it");
    }
    if (keys_.empty()) {
        return;
    }
    points_ = keys_.front().values.size();
    for (std::size_t i = 1; i < keys_.size(); ++i) {
        const std::size_t count = keys_[i].values.size();
        if (is_zip_ && count != keys_.front().values.size()) {
            reporter.fault(
                keys_[i].line,
                fmt::format(
                    "[sweep]: {} has {} values, {} has {}", keys_[i].path, count,
                    keys_.front().path, keys_.front().values.size()),
                "with combine = \"zip\" the first of each are one point, and so on",
                "give equally many");
        }
        points_ =
            is_zip_ ? std::min(points_, count) : std::min(points_ * count, kMaxSweepPoints + 1);
    }
    if (points_ > kMaxSweepPoints) {
        reporter.fault(
            table.line, fmt::format("[sweep]: there are more than {} points", kMaxSweepPoints),
            "every value is combined with every other value",
            "give fewer values, or combine = \"zip\"");
        points_ = 1;
    }
}

std::size_t SweepPlan::value_at(std::size_t key, std::size_t point) const {
    if (is_zip_) {
        return point;
    }
    std::size_t before = 1;
    for (std::size_t i = key + 1; i < keys_.size(); ++i) {
        before *= keys_[i].values.size();
    }
    return point / before % keys_[key].values.size();
}

std::vector<SweptValue> SweepPlan::values_at(std::size_t point) const {
    std::vector<SweptValue> values;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
        const Node& value = keys_[k].values[value_at(k, point)];
        const auto* word = value.as<std::string>();
        values.push_back(
            {keys_[k].path, word ? *word : node_text(value), std::make_shared<const Node>(value)});
    }
    return values;
}

bool SweepPlan::keeps_geometry() const {
    return std::none_of(keys_.begin(), keys_.end(), [](const SweptKey& key) {
        return is_among(first_part(key.from_top()), kSweptGeometry);
    });
}

Node SweepPlan::document_at(const Node& document, std::size_t point, Reporter& reporter) const {
    Node result = document;
    auto* members = std::get_if<Node::Table>(&result.value);
    if (members == nullptr) {
        return result;
    }
    std::erase_if(*members, [](const Member& member) { return member.key == kSweep; });
    for (std::size_t k = 0; k < keys_.size(); ++k) {
        const std::string path = keys_[k].from_top();
        if (first_part(path) == "run" && result.find("run") == nullptr) {
            members->push_back({"run", keys_[k].line, {Node::Table{}, keys_[k].line}});
        }
        Node value = keys_[k].values[value_at(k, point)];
        value.line = value.line == 0 ? keys_[k].line : value.line;
        set_swept_value(result, keys_[k], value, reporter);
    }
    return result;
}

}  // namespace quasimc
