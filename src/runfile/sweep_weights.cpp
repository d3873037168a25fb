#include "runfile/sweep_weights.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"

namespace quasimc {
namespace {

constexpr Range kWeight{0, TableReader::kFinite.high};

/// Collects the weights of all points.
class WeightReader {
  public:
    WeightReader(const Node& sweep, const SweepPlan& plan, Reporter& reporter)
        : table_(sweep, "[sweep]", reporter),
          plan_(plan),
          reporter_(reporter),
          weights_(plan.points(), 1) {}

    std::vector<double> read(const Node& node) {
        if (node.as<Node::Table>() != nullptr) {
            read_by_key(node, "");
        } else if (const auto own = numbers(node, "weights", plan_.points(), "point")) {
            weights_ = *own;
        }
        const bool is_valid = reporter_.faults.empty();
        if (is_valid && std::accumulate(weights_.begin(), weights_.end(), 0.0) == 0) {
            fault(node, "all weights are 0", "a sum needs a weight above 0");
        }
        return is_valid ? weights_ : std::vector<double>();
    }

  private:
    void fault(
        const Node& node,
        const std::string& problem,
        const std::string& why,
        const std::string& suggestion = "") {
        reporter_.fault(node.line, "[sweep]: " + problem, why, suggestion);
    }

    /// @param prefix  of the keys: those of inner tables are parts of a path
    void read_by_key(const Node& table, const std::string& prefix) {
        for (const Member& member : *table.as<Node::Table>()) {
            const std::string path = prefix + member.key;
            if (member.node.as<Node::Table>() != nullptr) {
                read_by_key(member.node, path + ".");
                continue;
            }
            const std::vector<SweptKey>& keys = plan_.keys();
            const auto key = std::ranges::find(keys, path, &SweptKey::path);
            if (key == keys.end()) {
                refuse_key(member, path);
                continue;
            }
            const auto own =
                numbers(member.node, "weights of " + path, key->values.size(), "value");
            const auto index = static_cast<std::size_t>(key - keys.begin());
            for (std::size_t point = 0; own && point < weights_.size(); ++point) {
                weights_[point] *= (*own)[plan_.value_at(index, point)];
            }
        }
    }

    void refuse_key(const Member& member, const std::string& path) {
        std::vector<std::string_view> known;
        for (const SweptKey& key : plan_.keys()) {
            known.emplace_back(key.path);
        }
        fault(
            member.node, fmt::format("weights: '{}' is not swept", path), "",
            did_you_mean(path, known));
    }

    /// A list of `count` numbers; none after a fault. @param of  what they are weights of
    std::optional<std::vector<double>> numbers(
        const Node& node, const std::string& what, std::size_t count, std::string_view of) {
        const auto* list = node.as<Node::List>();
        if (list == nullptr) {
            fault(
                node, fmt::format("{} is {}", what, node.type_name()),
                fmt::format("it must be a list, a number for each {}", of));
            return std::nullopt;
        }
        if (list->size() != count) {
            fault(
                node,
                fmt::format(
                    "{} has {}, there are {}", what, counted(list->size(), "number"),
                    counted(count, of)),
                fmt::format("each {} needs one", of));
            return std::nullopt;
        }
        std::vector<double> numbers;
        for (const Node& item : *list) {
            numbers.push_back(table_.real_at(what, item, kWeight).value_or(0));
        }
        return numbers;
    }

    TableReader table_;
    const SweepPlan& plan_;
    Reporter& reporter_;
    std::vector<double> weights_;
};

}  // namespace

std::vector<double> read_weights(const Node& sweep, const SweepPlan& plan, Reporter& reporter) {
    const Node* weights = sweep.find("weights");
    return weights == nullptr ? std::vector<double>()
                              : WeightReader(sweep, plan, reporter).read(*weights);
}

}  // namespace quasimc
