#include "resultio/sweep_sum.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "resultio/describe_series.h"
#include "resultio/table_columns.h"
#include "results/flows.h"
#include "results/fraction_table.h"
#include "results/groups.h"
#include "results/sensor_transmittance.h"
#include "results/summable_light.h"
#include "runfile/table_rows.h"
#include "runfile/written.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// The sunlit areas of rows in each replicate; empty without directional sources.
CombinedReplicates sunlit_areas(const SeriesSums& sums, std::span<const OrganWeights> rows) {
    if (!(sums.sums->units.sunlit_area > 0)) {
        return {};
    }
    const SummableLight areas = SummableLight::of_sunlit_area(sums.sums, sums.scene, sums.spec)
                                    .combined(rows, sums.spec.threads);
    CombinedReplicates all{{areas.deviations().begin(), areas.deviations().end()}, areas.sizes()};
    for (std::size_t i = 0; i < all.values.size(); ++i) {
        all.values[i] += areas.means()[i % areas.size()];
    }
    return all;
}

}  // namespace

std::string sweep_comments(const RunFile& run) {
    std::string weights;
    for (const SweepPoint& point : *run.sweep) {
        weights += (weights.empty() ? "" : ", ") + shortest(point.weight);
    }
    return fmt::format(
        "# {} of all points of the sweep; weights: {}\n{}",
        run.series ? "weighted sums" : "weighted means", weights,
        run.series ? "# column seconds: weighted sum of the durations of the time steps\n" : "");
}

bool is_complete(const RunFile& run, const SeriesSummary& series_summary) {
    return series_summary.completed == (run.series ? run.series->time_steps.size() : 1);
}

SweepSum::SweepSum(const RunFile& first, const TableSpec& table)
    : run_(&first), table_(table), bands_(first.scene.bands().size()) {
    choose_quantities();
    begin_point(first);
    rows_ = is_of(CsvRows::groups)    ? groups_.groups.size()
            : is_of(CsvRows::sensors) ? sensor_rows(first.scene)
                                      : first.scene.organs().size();
    const std::size_t replicates = first.spec.replicates;
    const ReplicateSum none(replicates, index_of(rows_, 0, 0));
    light_ = none;
    origins_.assign(written_columns(first).origins.size(), none);
    incident_ = ReplicateSum(replicates, bands_);
    canopy_ = ReplicateSum(replicates, bands_ * fraction_table().size());
    choose_parts();
    if (has_parts_) {
        sun_shade_ = SunShadeReplicateSum(replicates, rows_, bands_);
    }
    sunlit_ = ReplicateSum(replicates, has_sunlit_ ? rows_ : 0);
    areas_.assign(rows_, 1);
}

bool SweepSum::is_asked(std::string_view quantity) const {
    return is_selected(table_.quantities, quantity);
}

/// Chooses the quantities of which the values of the table are made.
void SweepSum::choose_quantities() {
    const bool has_shares =
        is_of(CsvRows::groups) && std::ranges::any_of(share_table(), [&](const ShareEntry& entry) {
            return is_asked(entry.name);
        });
    has_fractions_ = is_of(CsvRows::groups) &&
                     std::ranges::any_of(fraction_table(), [&](const FractionEntry& entry) {
                         return is_asked(entry.name);
                     });
    has_transmittance_ = is_of(CsvRows::sensors) && is_asked(kTransmittance) &&
                         SensorTransmittance(run_->scene).exists();
    for (const QuantityEntry& entry : quantity_table()) {
        const bool is_whole_of_share = has_shares && entry.quantity == Quantity::absorbed_flux;
        const bool is_on_sensors = is_of(CsvRows::sensors) &&
                                   (is_asked(kFluenceRate) || has_transmittance_) &&
                                   entry.quantity == Quantity::incident_upper;
        const bool has_rows = !is_of(CsvRows::sensors) || is_of_sensors(entry.quantity);
        if (has_rows && (is_asked(entry.name) || is_whole_of_share || is_on_sensors)) {
            quantities_.push_back(entry.quantity);
        }
    }
}

/// Chooses whether sunlit areas and the light of sunlit and shaded parts are summed.
void SweepSum::choose_parts() {
    const bool has_apart = run_->spec.sun_shade == SunShade::apart;
    has_parts_ = has_apart && !is_of(CsvRows::sensors) &&
                 std::ranges::any_of(sun_shade_table(), [&](const auto& entry) {
                     return is_asked(run_->series ? entry.of_sums : entry.name);
                 });
    has_sunlit_ = run_->series ? has_apart && (is_asked(kSunlitHours) || is_asked(kSunlitAreaHours))
                               : is_asked("sunlit_fraction") || is_asked("sunlit_area");
}

SweepSum::Rows SweepSum::rows_of(const Scene& scene) const {
    Rows rows;
    if (is_of(CsvRows::groups)) {
        for (const OrganGroup& group : groups_.groups) {
            rows.organs.push_back({group.organs});
            rows.areas.push_back(group.area);
        }
        return rows;
    }
    const std::vector<Organ>& organs = scene.organs();
    rows.indices.resize(rows_);  // sensors are the last organs
    std::iota(
        rows.indices.begin(), rows.indices.end(),
        static_cast<std::uint32_t>(organs.size() - rows_));
    for (const std::uint32_t& index : rows.indices) {
        rows.organs.push_back({std::span(&index, 1)});
        rows.areas.push_back(organs[index].area);
    }
    return rows;
}

void SweepSum::add(const SeriesSums& sums) {
    const bool is_of_origin = sums.origin != kAllLight;
    const double factor = weight() * (run_->series ? sums.seconds : 1);
    if (has_transmittance_ && !sums.of_sensors && !is_of_origin) {
        add_horizontal(sums, factor);
    }
    if (sums.of_sensors != is_of(CsvRows::sensors) ||
        (is_of_origin && sums.origin >= origins_.size())) {
        return;
    }
    const Rows rows = rows_of(sums.scene);
    areas_ = rows.areas;
    ReplicateSum& light = is_of_origin ? origins_[sums.origin] : light_;
    light.add(
        combine_replicates(sums.sums, sums.scene, sums.spec, rows.organs, quantities_), factor);
    if (!is_of_origin && is_of(CsvRows::groups)) {
        add_canopy(sums, factor);
    }
    if (!is_of_origin) {
        add_parts(sums, rows, factor);
    }
}

/// Adds sunlit areas and the light of sunlit and shaded parts.
void SweepSum::add_parts(const SeriesSums& sums, const Rows& rows, double light) {
    const double time = weight() * (run_->series ? sums.duration : 1);
    if (has_parts_) {
        sun_shade_.add(
            {sums.sums, sums.scene, sums.spec}, {rows.organs, rows.areas, is_of(CsvRows::groups)},
            {light, time});
    }
    if (has_sunlit_) {
        const CombinedReplicates areas = sunlit_areas(sums, rows.organs);
        if (!areas.values.empty()) {
            sunlit_.add(areas, time);
        }
    }
}

void SweepSum::add_canopy(const SeriesSums& sums, double weight) {
    const BandFlows flows = read_flows(sums.sums, sums.scene);
    const std::vector<std::vector<double>> flux = horizontal_flux(flows, sums.scene, sums.spec);
    is_incident_known_ = is_incident_known_ && !flux.empty();
    if (!is_incident_known_) {
        return;
    }
    CombinedReplicates all{{}, std::vector<ContributionSize>(bands_)};
    for (std::size_t r = 0; r < incident_.replicates(); ++r) {
        for (const std::vector<double>& band : flux) {
            all.values.push_back(band[r]);
        }
    }
    incident_.add(all, weight);
    if (has_fractions_) {
        canopy_.add(canopy_replicates(flows, sums.sums, sums.scene, sums.spec), weight);
    }
}

void SweepSum::add_horizontal(const SeriesSums& sums, double weight) {
    const std::vector<double> light = mean_horizontal_flux(sums.sums, sums.scene, sums.spec);
    is_incident_known_ = is_incident_known_ && !light.empty();
    horizontal_.resize(bands_);
    for (std::size_t b = 0; is_incident_known_ && b < bands_; ++b) {
        horizontal_[b] += light[b] * weight;
    }
}

void SweepSum::end_point(bool is_complete) {
    light_.end_point();
    canopy_.end_point();
    sun_shade_.end_point();
    sunlit_.end_point();
    for (ReplicateSum& origin : origins_) {
        origin.end_point();
    }
    for (std::size_t i = 0; run_->series && i < run_->series->time_steps.size(); ++i) {
        seconds_ += weight() * run_->series->time_steps[i].seconds;
    }
    ++points_;
    is_complete_ = is_complete_ && is_complete;
}

void SweepSum::begin_point(const RunFile& run) {
    run_ = &run;
    if (is_of(CsvRows::groups)) {
        groups_.groups = make_groups(run.scene, group_spec(run.spec));
        groups_.bands = bands_;
    }
}

double SweepSum::all_weights() const {
    double all = 0;
    for (const SweepPoint& point : *run_->sweep) {
        all += point.weight;
    }
    return all;
}

double SweepSum::per_weight() const {
    return run_->series ? 1 : 1 / all_weights();
}

std::vector<Estimate> SweepSum::values_of(const ReplicateSum& light) const {
    const double factor = per_weight();
    std::vector<Estimate> values(rows_ * kQuantities * bands_, kUnknownEstimate);
    for (std::size_t row = 0; row < rows_; ++row) {
        const double per_area = areas_[row] > 0 ? factor / areas_[row] : 0;
        for (std::size_t q = 0; q < quantities_.size(); ++q) {
            const auto column = static_cast<std::size_t>(quantities_[q]);
            const double unit = quantity_table()[column].is_flux ? factor : per_area;
            for (std::size_t b = 0; b < bands_; ++b) {
                values[(row * kQuantities + column) * bands_ + b] =
                    light.estimate(index_of(row, q, b), unit);
            }
        }
    }
    return values;
}

/// Quotients of sums.
std::vector<Estimate> SweepSum::shares() const {
    std::vector<Estimate> shares(rows_ * kGroupShares * bands_, kUnknownEstimate);
    const auto absorbed = std::ranges::find(quantities_, Quantity::absorbed_flux);
    if (absorbed == quantities_.end()) {
        return shares;
    }
    const auto q = static_cast<std::size_t>(absorbed - quantities_.begin());
    for (std::size_t row = 0; row < rows_; ++row) {
        for (std::size_t b = 0; b < bands_; ++b) {
            const std::size_t own = index_of(row, q, b);
            const std::vector<double> flux = light_.values(own);
            const auto put = [&](GroupShare share, const Estimate& estimate) {
                const auto index = static_cast<std::size_t>(share);
                shares[(row * kGroupShares + index) * bands_ + b] = estimate;
            };
            if (is_incident_known_) {
                put(GroupShare::incident,
                    estimate_share(flux, incident_.values(b), light_.size(own)));
            }
            put(GroupShare::absorbed,
                share_of_all(flux, light_.values(index_of(0, q, b)), light_.size(own)));
        }
    }
    return shares;
}

std::vector<CanopyFractions> SweepSum::canopy() const {
    std::vector<CanopyFractions> all(has_fractions_ && is_incident_known_ ? bands_ : 0);
    for (std::size_t b = 0; b < all.size(); ++b) {
        all[b].incident = incident_.estimate(b, per_weight()).mean;
        for (std::size_t i = 0; i < fraction_table().size(); ++i) {
            const std::size_t own = b * fraction_table().size() + i;
            all[b].*fraction_table()[i].part =
                estimate_share(canopy_.values(own), incident_.values(b), canopy_.size(own));
        }
    }
    return all;
}

SeriesSum SweepSum::sum_of(const ReplicateSum& light) const {
    SeriesSum sum;
    sum.bands = bands_;
    sum.seconds = seconds_;
    if (is_of(CsvRows::groups)) {
        sum.groups = groups_;
        sum.groups.values = values_of(light);
    } else {
        sum.values = values_of(light);
    }
    return sum;
}

/// The sum that has the light on sensors as a part.
SeriesSum SweepSum::sum_of_sensors(SeriesSum light) const {
    SeriesSum sum;
    sum.bands = bands_;
    sum.seconds = seconds_;
    sum.sensors = std::make_shared<const SeriesSum>(std::move(light));
    for (std::size_t b = 0; is_incident_known_ && b < horizontal_.size(); ++b) {
        sum.canopy.emplace_back().incident = horizontal_[b] * per_weight();
    }
    return sum;
}

/// Puts sunlit fractions x hours, or their means, and the light of sunlit and shaded parts.
void SweepSum::put_parts(SeriesSum& sum) const {
    constexpr double kSecondsPerHour = 3600;
    const bool is_of_groups = is_of(CsvRows::groups);
    const double whole = run_->series ? seconds_ : all_weights();
    const double of_time = run_->series ? 1 / kSecondsPerHour : per_weight();
    if (has_parts_) {
        (is_of_groups ? sum.groups.sun_shade : sum.sun_shade) =
            sun_shade_.estimates(areas_, {per_weight(), of_time, whole});
    }
    std::vector<Estimate>& fractions = is_of_groups ? sum.groups.sunlit_fraction : sum.sunlit_hours;
    for (std::size_t row = 0; has_sunlit_ && row < rows_; ++row) {
        const double per_area = areas_[row] > 0 ? of_time / areas_[row] : 0;
        fractions.push_back(not_above(sunlit_.estimate(row, per_area), of_time * whole));
        sum.groups.sunlit_area.push_back(scaled(fractions.back(), areas_[row]));
    }
}

SeriesSum SweepSum::sum() const {
    SeriesSum sum = sum_of(light_);
    const std::vector<std::string> names = written_columns(*run_).origins;
    for (std::size_t i = 0; i < origins_.size(); ++i) {
        sum.origins.push_back({names[i], sum_of(origins_[i])});
    }
    put_parts(sum);
    if (is_of(CsvRows::groups)) {
        sum.groups.shares = shares();
        sum.canopy = canopy();
    }
    if (is_of(CsvRows::sensors)) {
        sum = sum_of_sensors(std::move(sum));
    }
    return run_->series ? in_summed_units(*run_, std::move(sum)) : sum;
}

}  // namespace quasimc
