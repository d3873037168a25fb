#include "stress/shrink.h"

#include <cmath>
#include <utility>
#include <vector>

#include "stress/checks.h"

namespace quasimc::stress {
namespace {

/// Makes changes of a document, and keeps those with which it still fails.
class Shrinker {
  public:
    Shrinker(Node document, const StillFails& still_fails, unsigned most_tries)
        : document_(std::move(document)), still_fails_(still_fails), tries_left_(most_tries) {}

    Node run() {
        bool has_changed = true;
        while (has_changed && tries_left_ > 0) {
            has_changed = drop_tables();
            has_changed = drop_bands() || has_changed;
            has_changed = drop_keys() || has_changed;
            has_changed = round_numbers() || has_changed;
        }
        return std::move(document_);
    }

  private:
    bool attempt(Node changed) {
        if (tries_left_ == 0) {
            return false;
        }
        --tries_left_;
        if (!still_fails_(changed)) {
            return false;
        }
        document_ = std::move(changed);
        return true;
    }

    /// Removes organs, sources and materials, one after the other.
    bool drop_tables() {
        bool has_changed = false;
        for (const char* key : {"organ", "source", "material"}) {
            for (std::size_t i = tables_at(document_, key).size(); i-- > 0;) {
                Node changed = document_;
                Node::List& list = items(*find(changed, key));
                list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
                if (list.empty()) {
                    std::erase_if(members(changed), [&](const Member& m) { return m.key == key; });
                }
                has_changed = attempt(std::move(changed)) || has_changed;
            }
        }
        return has_changed;
    }

    /// Removes band `b` from every list with a value per band.
    static void drop_band(Node& table, std::size_t bands, std::size_t b) {
        for (Member& member : members(table)) {
            const bool is_per_band = member.key == "reflectance" || member.key == "transmittance" ||
                                     member.key == "power" || member.key.starts_with("irradiance");
            if (member.node.as<Node::Table>() != nullptr) {
                drop_band(member.node, bands, b);
            } else if (is_per_band && member.node.as<Node::List>() != nullptr) {
                items(member.node)
                    .erase(items(member.node).begin() + static_cast<std::ptrdiff_t>(b));
            }
        }
    }

    bool drop_bands() {
        bool has_changed = false;
        for (std::size_t b = items(*find(document_, "bands")).size(); b-- > 0;) {
            Node changed = document_;
            Node::List& bands = items(*find(changed, "bands"));
            const std::size_t count = bands.size();
            if (count == 1) {
                break;
            }
            bands.erase(bands.begin() + static_cast<std::ptrdiff_t>(b));
            for (const char* key : {"source", "material"}) {
                for (Node& table : items(*find(changed, key))) {
                    drop_band(table, count, b);
                }
            }
            has_changed = attempt(std::move(changed)) || has_changed;
        }
        return has_changed;
    }

    /// Every table of the document by its path: key, and index in a list.
    using Path = std::vector<std::pair<std::string, std::size_t>>;
    static Node* at(Node& document, const Path& path) {
        Node* node = &document;
        for (const auto& [key, index] : path) {
            node = find(*node, key);
            if (node != nullptr && node->as<Node::List>() != nullptr) {
                node = index < items(*node).size() ? &items(*node)[index] : nullptr;
            }
            if (node == nullptr || node->as<Node::Table>() == nullptr) {
                return nullptr;
            }
        }
        return node;
    }
    std::size_t keys_at(const Path& path) {
        Node* table = at(document_, path);
        return table == nullptr ? 0 : members(*table).size();
    }
    static void collect(const Node& table, const Path& path, std::vector<Path>& paths) {
        paths.push_back(path);
        for (const Member& member : *table.as<Node::Table>()) {
            Path inner = path;
            if (member.node.as<Node::Table>() != nullptr) {
                inner.emplace_back(member.key, 0);
                collect(member.node, inner, paths);
            } else if (const auto* list = member.node.as<Node::List>()) {
                for (std::size_t i = 0; i < list->size(); ++i) {
                    if ((*list)[i].as<Node::Table>() != nullptr) {
                        inner = path;
                        inner.emplace_back(member.key, i);
                        collect((*list)[i], inner, paths);
                    }
                }
            }
        }
    }
    [[nodiscard]] std::vector<Path> all_tables() const {
        std::vector<Path> paths;
        collect(document_, {}, paths);
        return paths;
    }

    bool drop_keys() {
        bool has_changed = false;
        for (const Path& path : all_tables()) {
            for (std::size_t i = keys_at(path); i-- > 0;) {
                if (i >= keys_at(path)) {
                    continue;  // the table was removed or shortened
                }
                Node changed = document_;
                Node::Table& table = members(*at(changed, path));
                if (table[i].key == "title" || table[i].key == "bands") {
                    continue;
                }
                table.erase(table.begin() + static_cast<std::ptrdiff_t>(i));
                has_changed = attempt(std::move(changed)) || has_changed;
                if (tries_left_ == 0) {
                    return has_changed;
                }
            }
        }
        return has_changed;
    }

    /// The numbers of a value, one after the other.
    static void collect_numbers(Node& node, std::vector<Node*>& numbers) {
        if (node.as<double>() != nullptr) {
            numbers.push_back(&node);
        } else if (auto* list = std::get_if<Node::List>(&node.value)) {
            for (Node& item : *list) {
                collect_numbers(item, numbers);
            }
        } else if (auto* table = std::get_if<Node::Table>(&node.value)) {
            for (Member& member : *table) {
                collect_numbers(member.node, numbers);
            }
        }
    }

    static double rounded_to(double x, int digits) {
        if (x == 0 || !std::isfinite(x)) {
            return x;
        }
        const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - digits + 1);
        return unit >= 1 ? std::round(x / unit) * unit
                         : std::round(x / unit) / std::round(1 / unit);
    }

    /// Rounds all numbers at once to few digits, then each separately.
    bool round_numbers() {
        bool has_changed = false;
        std::vector<Node*> numbers;
        Node copy = document_;
        collect_numbers(copy, numbers);
        const std::size_t count = numbers.size();
        for (const int digits : {1, 2, 3}) {
            has_changed = change_numbers(0, count, digits) || has_changed;
        }
        for (std::size_t i = 0; i < count && tries_left_ > 0; ++i) {
            for (const int digits : {0, 1, 2}) {
                if (change_numbers(i, i + 1, digits)) {
                    has_changed = true;
                    break;
                }
            }
        }
        return has_changed;
    }

    /// Rounds numbers to `digits` digits; to 0 if `digits` is 0.
    bool change_numbers(std::size_t first, std::size_t last, int digits) {
        Node changed = document_;
        std::vector<Node*> numbers;
        collect_numbers(changed, numbers);
        bool differs = false;
        for (std::size_t i = first; i < last && i < numbers.size(); ++i) {
            const double x = *numbers[i]->as<double>();
            const double simple = digits == 0 ? 0 : rounded_to(x, digits);
            differs = differs || simple != x;
            numbers[i]->value = simple;
        }
        return differs && attempt(std::move(changed));
    }

    Node document_;
    const StillFails& still_fails_;
    unsigned tries_left_;
};

bool differs_still(const Case& it, const Finding& finding, std::uint64_t number) {
    if (!is_offered(it, finding.a) || !is_offered(it, finding.b)) {
        return false;
    }
    Rules rules;
    rules.last_seeds = 8;
    rules.last.paths = 2048;
    std::vector<Disagreement> all;
    for (std::size_t i = 0; i < number_names(it.run.scene).size(); ++i) {
        all.push_back({i, finding.a, finding.b, 0, ""});
    }
    for (const Finding& found : compare_closely(it, all, number, rules, 1e-6)) {
        if (found.kind == finding.kind) {
            return true;
        }
    }
    return false;
}

}  // namespace

Node shrunk(Node document, const StillFails& still_fails, unsigned most_tries) {
    return Shrinker(std::move(document), still_fails, most_tries).run();
}

StillFails failure_like(const Finding& finding, std::uint64_t number) {
    return [finding, number](const Node& document) {
        try {
            const Case it = make_case(document);
            switch (finding.kind) {
                case Finding::Kind::impossible:
                    return !impossible_numbers(
                                compute(it, finding.a, Effort{}), number_names(it.run.scene))
                                .empty();
                case Finding::Kind::identity:
                    return !faults_of_identity(it, Effort{}).empty();
                case Finding::Kind::refused:
                    for (const Way way : ways_of(it)) {
                        static_cast<void>(compute(it, way, Effort{}));
                    }
                    return false;
                default:
                    return differs_still(it, finding, number);
            }
        } catch (const std::exception& error) {
            return finding.kind == Finding::Kind::refused && error.what() == finding.words;
        }
    };
}

}  // namespace quasimc::stress
