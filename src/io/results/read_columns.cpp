#include "io/results/read_columns.h"

#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "quasimc/error.h"

namespace quasimc {
namespace {

using OrderedJson = nlohmann::ordered_json;
using ColumnNames = std::vector<std::vector<std::string>>;

/// Follows the parser, and takes organs out of its hands one by one, so that they never stand in
/// memory as JSON all together.
class ColumnReader {
  public:
    ColumnReader(
        const ColumnNames& names, std::size_t organs, const std::optional<std::size_t>& point)
        : names_(names), organs_(organs), point_(point) {}

    /// @returns whether the parser keeps what it read
    bool on_event(OrderedJson::parse_event_t event, const OrderedJson& value) {
        using Event = OrderedJson::parse_event_t;
        switch (event) {
            case Event::object_start:
            case Event::array_start:
                levels_.push_back({.is_list = event == Event::array_start});
                return true;
            case Event::key:
                levels_.back().key = value.get<std::string>();
                return true;
            case Event::object_end:
            case Event::array_end:
                levels_.pop_back();
                return on_value(value);
            case Event::value:
                return on_value(value);
        }
        return true;
    }

    std::vector<ResultTime> take() { return std::move(times_); }

  private:
    struct Level {
        std::string key = {};
        std::size_t index = 0;
        bool is_list = false;
    };

    /// The list whose element has just ended: its name, and the level of the object that has it.
    bool on_value(const OrderedJson& value) {
        if (levels_.empty() || !levels_.back().is_list) {
            return true;
        }
        const std::size_t index = levels_.back().index++;
        if (levels_.size() < 2 || levels_[levels_.size() - 2].is_list) {
            return true;
        }
        const std::string& name = levels_[levels_.size() - 2].key;
        if (name == "points" && levels_.size() == 2) {
            return point_ && index == *point_;
        }
        if (name != "organs" || !value.is_object() || !is_of_result()) {
            return true;
        }
        if (is_asked_for()) {
            take_organ(value, index, time_of_list());
        }
        return false;
    }

    /// Levels above the object of the run: of a sweep it is an element of a list.
    [[nodiscard]] std::size_t first_level() const {
        return levels_.front().key == "points" && levels_.size() > 2 && levels_[1].is_list ? 2 : 0;
    }

    /// Levels from the object of the run to the one that has the list.
    [[nodiscard]] std::size_t depth() const { return levels_.size() - 2 - first_level(); }

    /// Whether the list being read is that of a result, of a time, a day or the sum.
    [[nodiscard]] bool is_of_result() const {
        const std::string& key = levels_[first_level()].key;
        switch (depth()) {
            case 0:
                return true;
            case 1:
                return key == "total";
            case 2:
                return (key == "moments" || key == "days") && levels_[first_level() + 1].is_list;
            default:
                return false;
        }
    }

    [[nodiscard]] bool is_asked_for() const {
        return first_level() == 0 ? !point_ : point_ && levels_[1].index == *point_;
    }

    /// The time whose organs are being read.
    ResultTime& time_of_list() {
        ResultTime at;
        if (depth() > 0) {
            at.part = levels_[first_level()].key;
            at.index = depth() == 2 ? levels_[first_level() + 1].index : 0;
        }
        if (times_.empty() || times_.back().part != at.part || times_.back().index != at.index) {
            at.columns.resize(names_.size());
            times_.push_back(std::move(at));
        }
        return times_.back();
    }

    void take_organ(const OrderedJson& organ, std::size_t index, ResultTime& time) const {
        if (index >= organs_) {
            return;
        }
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const OrderedJson* estimate = &organ;
            for (const std::string& name : names_[i]) {
                const auto found =
                    estimate->is_object() ? estimate->find(name) : OrderedJson::const_iterator();
                estimate = estimate->is_object() && found != estimate->end() ? &*found : nullptr;
                if (estimate == nullptr) {
                    break;
                }
            }
            if (estimate != nullptr && estimate->is_object()) {
                set(*estimate, index, time.columns[i]);
            }
        }
    }

    void set(const OrderedJson& estimate, std::size_t index, OrganColumn& column) const {
        const auto put = [&](const char* name, std::vector<float>& numbers) {
            numbers.resize(organs_, std::numeric_limits<float>::quiet_NaN());
            const auto found = estimate.find(name);
            if (found != estimate.end() && found->is_number()) {
                numbers[index] = static_cast<float>(found->get<double>());
            }
        };
        put("mean", column.mean);
        put("standard_error", column.standard_error);
        put("low", column.low);
        put("high", column.high);
    }

    const ColumnNames& names_;
    std::size_t organs_;
    std::optional<std::size_t> point_;
    std::vector<Level> levels_;
    std::vector<ResultTime> times_;
};

/// The result of a point, as if it were one of a run without [sweep].
OrderedJson only_point(OrderedJson document, const std::string& path) {
    const auto points = document.find("points");
    if (points == document.end() || !points->is_array() || points->size() != 1) {
        throw InputError({{path, "the point of the sweep is not there", "", ""}});
    }
    const OrderedJson point = std::move(points->front());
    document.erase("points");
    for (const auto& item : point.items()) {
        document[item.key()] = item.value();
    }
    return document;
}

/// Leaves the lists of organs out, which are empty by now, and tells what times are called.
void finish(OrderedJson& document, std::vector<ResultTime>& times) {
    document.erase("organs");
    for (const char* part : {"moments", "days", "total"}) {
        const auto found = document.find(part);
        if (found == document.end()) {
            continue;
        }
        for (OrderedJson& each : *found) {
            if (each.is_object()) {
                each.erase("organs");
            }
        }
        if (found->is_object()) {
            found->erase("organs");
        }
    }
    for (ResultTime& time : times) {
        const char* key = time.part == "moments" ? "time" : time.part == "days" ? "date" : nullptr;
        if (key != nullptr) {
            const OrderedJson& each = document[time.part][time.index];
            time.label = each.is_object() ? each.value(key, "") : "";
        }
    }
}

}  // namespace

ResultColumns read_columns(
    const std::string& text,
    const std::string& path,
    const ColumnNames& columns,
    std::size_t organs,
    std::optional<std::size_t> point) {
    ColumnReader reader(columns, organs, point);
    OrderedJson document;
    try {
        document =
            OrderedJson::parse(text, [&reader](int, OrderedJson::parse_event_t event, auto& value) {
                return reader.on_event(event, value);
            });
    } catch (const OrderedJson::parse_error& error) {
        throw InputError(
            {{path, fmt::format("byte {}: not JSON", error.byte),
              "a result that `quasimc run --json` wrote is needed", ""}});
    }
    if (!document.is_object()) {
        throw InputError({{path, "is no result", "", ""}});
    }
    if (point) {
        document = only_point(std::move(document), path);
    }
    ResultColumns result;
    result.times = reader.take();
    finish(document, result.times);
    result.head = document.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    return result;
}

}  // namespace quasimc
