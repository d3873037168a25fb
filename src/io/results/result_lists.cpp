#include "io/results/result_lists.h"

#include <algorithm>
#include <limits>

namespace quasimc {
namespace {

using Kind = JsonScanner::Kind;

class ListWalk {
  public:
    ListWalk(
        std::string_view text,
        std::string_view path,
        std::string_view name,
        const std::optional<std::size_t>& point,
        const std::function<void(const ResultListPlace&, JsonScanner&)>& visit)
        : json_(text, path), name_(name), point_(point), visit_(visit) {}

    std::vector<TextRange> run() {
        if (json_.kind() == Kind::object) {
            read_result();
        } else {
            json_.skip();
        }
        json_.end();
        return std::move(passed_);
    }

  private:
    /// The whole, or a run.
    void read_result() {
        json_.object([this](std::string_view key) {
            if (key == "points") {
                read_points();
            } else {
                read_member(key, point_ ? Wanted::no : Wanted::yes);
            }
        });
    }

    enum class Wanted { no, yes };

    void read_points() {
        if (json_.kind() != Kind::list) {
            json_.skip();
            return;
        }
        json_.list([this](std::size_t point) {
            if (point != point_) {
                pass([this] { json_.skip(); });
            } else if (json_.kind() == Kind::object) {
                json_.object([this](std::string_view key) { read_member(key, Wanted::yes); });
            } else {
                json_.skip();
            }
        });
    }

    /// A member of the result of a run.
    void read_member(std::string_view key, Wanted wanted) {
        if (key == name_) {
            read_list({}, wanted);
        } else if (key == "total" && json_.kind() == Kind::object) {
            read_time({.part = "total"}, wanted);
        } else if ((key == "moments" || key == "days") && json_.kind() == Kind::list) {
            const std::string part(key);
            json_.list([&](std::size_t index) {
                if (json_.kind() == Kind::object) {
                    read_time({part, index, {}}, wanted);
                } else {
                    json_.skip();
                }
            });
        } else {
            json_.skip();
        }
    }

    void read_time(ResultListPlace place, Wanted wanted) {
        const std::string_view label = place.part == "days" ? "date" : "time";
        json_.object([&](std::string_view key) {
            if (key == name_) {
                read_list(place, wanted);
            } else if (key == label && json_.kind() == Kind::string) {
                place.label = json_.text();
            } else {
                json_.skip();
            }
        });
    }

    void read_list(const ResultListPlace& place, Wanted wanted) {
        if (json_.kind() != Kind::list) {
            json_.skip();
            return;
        }
        pass([&] {
            if (wanted == Wanted::yes) {
                visit_(place, json_);
            } else {
                json_.skip();
            }
        });
    }

    template <typename Read>
    void pass(const Read& read) {
        const std::size_t begin = json_.place();
        read();
        passed_.emplace_back(begin, json_.place());
    }

    JsonScanner json_;
    std::string_view name_;
    const std::optional<std::size_t>& point_;
    const std::function<void(const ResultListPlace&, JsonScanner&)>& visit_;
    std::vector<TextRange> passed_;
};

/// The number of a field that says one; NaN of others.
double field(JsonScanner& json) {
    if (json.kind() == Kind::number) {
        return json.number();
    }
    json.skip();
    return std::numeric_limits<double>::quiet_NaN();
}

Estimate read_estimate(JsonScanner& json) {
    Estimate estimate = kUnknownEstimate;
    json.object([&](std::string_view key) {
        if (key == "mean") {
            estimate.mean = field(json);
        } else if (key == "standard_error") {
            estimate.standard_error = field(json);
        } else if (key == "low") {
            estimate.low = field(json);
        } else if (key == "high") {
            estimate.high = field(json);
        } else {
            json.skip();
        }
    });
    return estimate;
}

}  // namespace

std::vector<TextRange> for_each_result_list(
    std::string_view text,
    std::string_view path,
    std::string_view name,
    const std::optional<std::size_t>& point,
    const std::function<void(const ResultListPlace&, JsonScanner&)>& visit) {
    return ListWalk(text, path, name, point, visit).run();
}

EstimateTree::EstimateTree(const std::vector<std::vector<std::string>>& columns) : nodes_(1) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
        std::size_t node = 0;
        for (const std::string& name : columns[column]) {
            const auto& below = nodes_[node].below;
            const auto known = std::find_if(
                below.begin(), below.end(), [&](const auto& next) { return next.first == name; });
            if (known != below.end()) {
                node = known->second;
                continue;
            }
            nodes_[node].below.emplace_back(name, nodes_.size());
            node = nodes_.size();
            nodes_.emplace_back();
        }
        nodes_[node].columns.push_back(column);
    }
}

std::size_t EstimateTree::read(JsonScanner& json, const Take& take) const {
    std::size_t count = 0;
    json.list([&](std::size_t index) {
        read_below(json, nodes_.front(), index, take);
        ++count;
    });
    return count;
}

void EstimateTree::read_below(
    JsonScanner& json, const Node& node, std::size_t index, const Take& take) const {
    if (json.kind() != Kind::object || (node.below.empty() && node.columns.empty())) {
        json.skip();
        return;
    }
    if (!node.columns.empty()) {
        const Estimate estimate = read_estimate(json);
        for (const std::size_t column : node.columns) {
            take(index, column, estimate);
        }
        return;
    }
    json.object([&](std::string_view key) {
        const auto found = std::find_if(
            node.below.begin(), node.below.end(),
            [&](const auto& next) { return next.first == key; });
        if (found == node.below.end()) {
            json.skip();
        } else {
            read_below(json, nodes_[found->second], index, take);
        }
    });
}

}  // namespace quasimc
