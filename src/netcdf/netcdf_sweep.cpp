#include "netcdf/netcdf_sweep.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "runfile/sweep_keys.h"

namespace quasimc {
namespace {

/// Sections that determine the light over time.
constexpr std::array<std::string_view, 3> kLightSections{"source", "site", "time"};

}  // namespace

NetcdfSweep::NetcdfSweep(const RunFile& run) {
    if (!run.sweep) {
        return;
    }
    Reporter reporter{run.path, {}, {}};
    const SweepPlan plan(*run.document, reporter);
    reporter.faults.throw_if_any();
    add_keys(plan);
    if (!plan.is_product()) {
        axes_ = {{"point", plan.points()}};
    }
    changes_geometry_ = !plan.keeps_geometry();
    changes_daylight_ =
        std::any_of(plan.keys().begin(), plan.keys().end(), [](const SweptKey& key) {
            const std::string path = key.from_top();
            return is_among(first_part(path), kLightSections);
        });
}

void NetcdfSweep::add_keys(const SweepPlan& plan) {
    for (const SweptKey& key : plan.keys()) {
        Key added{key.path, plan.is_product() ? axes_.size() : 0, {}};
        for (const Node& value : key.values) {
            const auto* word = value.as<std::string>();
            added.values.push_back(word != nullptr ? *word : node_text(value));
        }
        if (plan.is_product()) {
            axes_.push_back({key.path, key.values.size()});
        }
        keys_.push_back(std::move(added));
    }
}

std::vector<std::size_t> NetcdfSweep::indices_of(std::size_t point) const {
    std::vector<std::size_t> indices(axes_.size());
    for (std::size_t i = axes_.size(); i-- > 0;) {
        indices[i] = point % axes_[i].size;
        point /= axes_[i].size;
    }
    return indices;
}

}  // namespace quasimc
