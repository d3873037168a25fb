#include "record.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "result.h"
#include "resultio/describe_series.h"

namespace quasimc::python {
namespace {

/// The rows of results in the order of a scene that has the same organs, by id.
class RowOrder {
  public:
    /// @throws InputError  if the scene has other organs
    RowOrder(const Scene& recorded, const Scene& scene) {
        std::unordered_map<std::int64_t, std::size_t> rows;
        for (const Organ& organ : recorded.organs()) {
            rows.emplace(organ.id, rows.size());
        }
        for (const Organ& organ : scene.organs()) {
            const auto found = rows.find(organ.id);
            if (found == rows.end() || rows.size() != scene.organs().size()) {
                throw InputError(
                    {{"scene", "it would be read with other ids of organs",
                      "files have changed, or both files and meshes have no ids",
                      "give add_file(first_id=...) and add_mesh(organ=...)"}});
            }
            from_.push_back(found->second);
        }
        to_.resize(from_.size());
        for (std::size_t i = 0; i < from_.size(); ++i) {
            to_[from_[i]] = static_cast<std::uint32_t>(i);
        }
    }

    void apply(Result& result) const {
        put(result.values, kQuantities * result.bands);
        put(result.sunlit_fraction, 1);
        put(result.ratio_values, result.ratios);
        put(result.sun_shade.values, result.sun_shade.values_per_row());
        apply(result.groups);
        for (OriginLight& origin : result.origins) {
            apply(origin.light);
        }
    }

    void apply(SeriesSum& sum) const {
        put(sum.values, kQuantities * sum.bands);
        put(sum.sunlit_hours, 1);
        put(sum.sun_shade.values, sum.sun_shade.values_per_row());
        apply(sum.groups);
        for (OriginSum& origin : sum.origins) {
            apply(origin.light);
        }
    }

  private:
    void apply(GroupResults& groups) const {
        for (OrganGroup& group : groups.groups) {
            for (std::uint32_t& organ : group.organs) {
                organ = to_[organ];
            }
            std::ranges::sort(group.organs);
        }
    }

    void put(std::vector<Estimate>& values, std::size_t row) const {
        const std::vector<Estimate> old = values;
        for (std::size_t i = 0; !old.empty() && i < from_.size(); ++i) {
            std::copy_n(old.begin() + from_[i] * row, row, values.begin() + i * row);
        }
    }

    std::vector<std::size_t> from_;
    std::vector<std::uint32_t> to_;
};

}  // namespace

void RunRecord::add(const TimeStepResult& step) {
    time_steps.push_back(step.time_step);
    computed.push_back(step.computed);
    results.push_back(reported_result(step.result));
    replicates.push_back(nullptr);
}

void RunRecord::add(std::size_t day, const SeriesSum& sum) {
    days.push_back(day);
    sums.push_back(reported_sum(in_summed_units(scene->bands(), sum)));
}

void RunRecord::end(const SeriesSummary& of_run) {
    summary = of_run;
    summary.total = reported_sum(in_summed_units(scene->bands(), std::move(summary.total)));
}

SeriesSummary replay(const RunRecord& record, const Scene& scene, OutputWriter& writer) {
    const RowOrder order(*record.scene, scene);
    const bool has_times = writer.wants(SeriesPart::time_steps);
    for (std::size_t i = 0; has_times && i < record.results.size(); ++i) {
        Result result = *record.results[i];
        order.apply(result);
        writer.on_time_step({record.time_steps[i], result, record.computed[i]});
    }
    for (std::size_t i = 0; i < record.sums.size(); ++i) {
        SeriesSum sum = record.sums[i];
        order.apply(sum);
        if (writer.wants(SeriesPart::days)) {
            writer.on_day(record.days[i], sum);
        }
    }
    SeriesSummary summary = record.summary;
    order.apply(summary.total);
    return summary;
}

void Recorder::finish(const SeriesSummary& summary) {
    runs_.back()->series = run_->series;  // with the outcomes of its controls
    runs_.back()->end(summary);
}

void Recorder::begin(const RunFile& run) {
    run_ = &run;
    runs_.push_back(std::make_shared<RunRecord>());
    RunRecord& record = *runs_.back();
    record.scene = std::make_shared<const Scene>(run.scene);
    record.spec = run.spec;
    record.series = run.series;
}

}  // namespace quasimc::python
