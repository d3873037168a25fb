#include "window/window_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "quasimc/error.h"
#include "resultio/describe_result.h"
#include "resultio/json_parts.h"

namespace quasimc {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

Estimate difference_of(const Estimate& a, const Estimate& b) {
    constexpr double kNormal95 = 1.959964;  // of the normal distribution
    const double mean = a.mean - b.mean;
    const double error = std::hypot(a.standard_error, b.standard_error);
    return {mean, error, mean - kNormal95 * error, mean + kNormal95 * error};
}

/// Refuses columns of both results whose units differ.
void check_units(const std::vector<WindowColumn>& columns, const ReadResult& minus) {
    const Scene& scene = minus.run.scene;
    for (const WindowColumn& other :
         window_columns(scene.bands(), scene.length_unit(), minus.run.spec.ratios)) {
        const auto found = std::ranges::find(columns, other.path, &WindowColumn::path);
        if (found != columns.end() && found->unit != other.unit) {
            throw InputError({fault_of_units(
                minus.path, fmt::format("{}, {}", found->name, found->band), found->unit,
                other.unit)});
        }
    }
}

}  // namespace

RowsQuery window_query(const RunFile& run, const std::vector<WindowColumn>& columns) {
    RowsQuery query{.rest = RowsQuery::Rest::all};
    for (const WindowColumn& column : columns) {
        query.columns.push_back(column.path);
    }
    if (run.sweep) {
        query.point = run.point;
    }
    return query;
}

WindowDifference::WindowDifference(
    const WindowOrgans& organs, const std::vector<WindowColumn>& columns, const ReadResult& minus)
    : title_(title_of(minus.run)) {
    check_units(columns, minus);
    const WindowOrgans others(minus.run.scene);
    std::unordered_map<std::string, std::size_t> known;
    for (std::size_t i = 0; i < others.all().size(); ++i) {
        known.emplace(others.id_of(i), i);
    }
    only_other_ = known.size();
    for (std::size_t i = 0; i < organs.all().size(); ++i) {
        const auto found = known.find(organs.id_of(i));
        const bool is_in_both = found != known.end();
        index_.push_back(is_in_both ? found->second : kNone);
        only_other_ -= is_in_both ? 1 : 0;
        only_first_ += is_in_both ? 0 : 1;
    }
    if (only_first_ == index_.size()) {
        throw InputError(
            {{minus.path, "has no organ of the first result", "organs are matched by their ids",
              "choose a result of the same plants"}});
    }
    const auto take = [this](PlacedRows rows) {
        others_[{rows.position.part, rows.position.label}] = std::move(rows.columns);
    };
    const RowsQuery query = window_query(minus.run, columns);
    const Node rest = read_window_rows(minus.text, minus.path, query, others, take);
    head_ = only_point(rest, query.point, minus.path);
}

RowColumns WindowDifference::of(const RowsPosition& position, const RowColumns& first) const {
    RowColumns all(first.size());
    const auto found = others_.find({position.part, position.label});
    if (found == others_.end()) {
        return all;
    }
    for (std::size_t i = 0; i < first.size(); ++i) {
        const std::vector<Estimate>& other = found->second[i];
        if (first[i].empty() || other.empty()) {
            continue;
        }
        for (std::size_t organ = 0; organ < first[i].size(); ++organ) {
            const std::size_t index = index_[organ];
            all[i].push_back(
                index < other.size() ? difference_of(first[i][organ], other[index])
                                     : kUnknownEstimate);
        }
    }
    return all;
}

Json WindowDifference::json() const {
    return {
        {"title", title_},
        {"head", json_value(head_)},
        {"errors",
         "Errors are √(a² + b²): results hold no replicates, so the two are taken as independent."},
        {"only_first", only_first_},
        {"only_other", only_other_}};
}

}  // namespace quasimc
