#include "io/results/read_columns.h"

#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/results/result_lists.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The text with "null" in place of its parts.
std::string without(const std::string& text, const std::vector<TextRange>& parts) {
    std::string rest;
    std::size_t from = 0;
    for (const auto& [begin, end] : parts) {
        rest.append(text, from, begin - from).append("null");
        from = end;
    }
    return rest.append(text, from);
}

OrderedJson parse_rest(const std::string& text, const std::string& path) {
    try {
        return OrderedJson::parse(text);
    } catch (const OrderedJson::exception&) {
        throw InputError({{path, "is no result", "a text or a number in it can't be read", ""}});
    }
}

/// @param organs  the length of the column
void set(OrganColumn& column, std::size_t index, std::size_t organs, const Estimate& estimate) {
    const auto put = [&](std::vector<float>& numbers, double number) {
        numbers.resize(organs, std::numeric_limits<float>::quiet_NaN());
        numbers[index] = static_cast<float>(number);
    };
    put(column.mean, estimate.mean);
    put(column.standard_error, estimate.standard_error);
    put(column.low, estimate.low);
    put(column.high, estimate.high);
}

/// The result of a point, as if it were one of a run without [sweep].
OrderedJson only_point(OrderedJson document, std::size_t number, const std::string& path) {
    const auto points = document.find("points");
    if (points == document.end() || !points->is_array() || number >= points->size()) {
        throw InputError({{path, "the point of the sweep is not there", "", ""}});
    }
    const OrderedJson point = std::move((*points)[number]);
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
    const std::vector<std::vector<std::string>>& columns,
    std::size_t organs,
    std::optional<std::size_t> point) {
    const EstimateTree tree(columns);
    ResultColumns result;
    const auto visit = [&](const ResultListPlace& place, JsonScanner& json) {
        ResultTime time{place.part, place.index, place.label, {}};
        time.columns.resize(columns.size());
        const std::size_t count =
            tree.read(json, [&](std::size_t index, std::size_t column, const Estimate& estimate) {
                if (index < organs) {
                    set(time.columns[column], index, organs, estimate);
                }
            });
        if (count > 0) {
            result.times.push_back(std::move(time));
        }
    };
    const std::vector<TextRange> lists = for_each_result_list(text, path, "organs", point, visit);
    OrderedJson document = parse_rest(without(text, lists), path);
    if (!document.is_object()) {
        throw InputError({{path, "is no result", "", ""}});
    }
    if (point) {
        document = only_point(std::move(document), *point, path);
    }
    finish(document, result.times);
    result.head = document.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    return result;
}

}  // namespace quasimc
