#include "run_fields.h"

#include <algorithm>
#include <string>
#include <utility>

#include "resultio/series_words.h"
#include "runfile/written.h"
#include "shown_fields.h"

namespace {

/// The light of each organ in each quantity and band that is written.
/// @param light  a Result or a SeriesSum
template <typename Light>
std::vector<ShownValues> values_of(const quasimc::RunFile& run, const Light& light) {
    const quasimc::WrittenColumns columns = quasimc::written_columns(run);
    std::vector<ShownValues> all;
    for (const quasimc::QuantityEntry& entry : columns.quantities) {
        for (const std::size_t b : columns.bands) {
            all.push_back(light_values(run, light, entry, b));
        }
    }
    return all;
}

}  // namespace

void RunFields::add_moment(const quasimc::Result& result) {
    if (run_->series) {
        return;
    }
    last_ = values_of(*run_, result);
    if (quasimc::written_columns(*run_).has_sunlit && !result.sunlit_fraction.empty()) {
        last_.push_back({result.sunlit_fraction, "sunlit fraction", "", "sunlit_fraction", ""});
    }
    for (std::size_t i = 0; i < result.ratios; ++i) {
        const std::string& name = run_->spec.ratios[i];
        ShownValues values{{}, name, "", name, ""};
        for (std::size_t organ = 0; organ < run_->scene.organs().size(); ++organ) {
            values.estimates.push_back(result.ratio(organ, i));
        }
        last_.push_back(std::move(values));
    }
}

quasimc::FieldScene RunFields::shown(const quasimc::SeriesSummary& summary) const {
    const quasimc::RunFile& run = *run_;
    std::vector<ShownValues> values = last_;
    if (run.series && !summary.total.values.empty()) {
        values = values_of(run, quasimc::in_summed_units(run, summary.total));
    }
    const auto colored = std::find_if(values.begin(), values.end(), [](const ShownValues& one) {
        return one.key.starts_with("absorbed_flux_density");
    });
    const ShownValues* first = values.empty() ? nullptr : &values.front();
    return field_scene(run.scene, values, colored == values.end() ? first : &*colored);
}
