#include "io/results/read_estimates.h"

#include <algorithm>
#include <utility>

#include "io/results/result_lists.h"

namespace quasimc {

std::vector<std::vector<TimedEstimates>> read_estimate_columns(
    std::string_view text,
    const std::string& path,
    const EstimateQuery& query,
    const std::vector<EstimateNames>& columns) {
    const EstimateTree tree(columns);
    std::vector<std::vector<TimedEstimates>> times(columns.size());
    const auto visit = [&](const ResultListPlace& place, JsonScanner& json) {
        if (place.part != query.part || !place.label.starts_with(query.label)) {
            json.skip();
            return;
        }
        for (std::vector<TimedEstimates>& each : times) {
            each.push_back({place.label, {}});
        }
        tree.read(json, [&](std::size_t index, std::size_t column, const Estimate& estimate) {
            std::vector<Estimate>& values = times[column].back().values;
            values.resize(std::max(values.size(), index + 1), kUnknownEstimate);
            values[index] = estimate;
        });
    };
    for_each_result_list(text, path, query.list, query.point, visit);
    for (std::vector<TimedEstimates>& each : times) {
        std::erase_if(each, [](const TimedEstimates& time) { return time.values.empty(); });
    }
    return times;
}

std::vector<TimedEstimates> read_estimates(
    std::string_view text, const std::string& path, const EstimateQuery& query) {
    return read_estimate_columns(text, path, query, {query.names}).front();
}

}  // namespace quasimc
