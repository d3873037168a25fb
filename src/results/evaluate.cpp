#include "results/evaluate.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/parallel.h"

namespace quasimc {
namespace {

constexpr std::size_t kOrgansPerBlock = 256;

/// BoundSource that one replicate saw fall on one organ, flux per band and side.
struct Incident {
    double direct_upper = 0, direct_lower = 0, scattered_upper = 0, scattered_lower = 0;
    double absorbed = 0;
};

/// Reads an organ's cells.
class OrganReader {
  public:
    OrganReader(const Evaluation& evaluation, const Organ& organ)
        : evaluation_(evaluation), organ_(organ) {}

    [[nodiscard]] Incident incident(std::uint32_t replicate, std::size_t band) const {
        Incident sum;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            const double unit =
                evaluation_.estimator.flux_per_unit(region, band, evaluation_.paths);
            const Incident part = element_incident(replicate, region, band, unit);
            const Material& material = evaluation_.prepared.material(region);
            sum.direct_upper += part.direct_upper;
            sum.direct_lower += part.direct_lower;
            sum.scattered_upper += part.scattered_upper;
            sum.scattered_lower += part.scattered_lower;
            sum.absorbed += (part.direct_upper + part.scattered_upper) *
                                material.side(true).absorptance()[band] +
                            (part.direct_lower + part.scattered_lower) *
                                material.side(false).absorptance()[band];
        }
        return sum;
    }

    [[nodiscard]] double sunlit_area(std::uint32_t replicate) const {
        const std::span<const std::int64_t> cells = evaluation_.replicates.cells(replicate);
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            sum += from_fixed(cells[evaluation_.replicates.layout().sunlit(region)]) *
                   evaluation_.estimator.sunlit_area_per_unit(region, evaluation_.paths);
        }
        return sum;
    }

  private:
    [[nodiscard]] Incident element_incident(
        std::uint32_t replicate, std::uint32_t region, std::size_t band, double unit) const {
        const TallyLayout& layout = evaluation_.replicates.layout();
        const std::span<const std::int64_t> cells = evaluation_.replicates.cells(replicate);
        Incident sum;
        const bool counted = evaluation_.direct_light == DirectLight::counted;
        for (std::size_t s = 0; counted && s < layout.spectra; ++s) {
            const double weight = evaluation_.prepared.spectra()[s][band] * unit;
            sum.direct_upper += from_fixed(cells[layout.direct(region, false, s)]) * weight;
            sum.direct_lower += from_fixed(cells[layout.direct(region, true, s)]) * weight;
        }
        sum.scattered_upper = from_fixed(cells[layout.scattered(region, false) + band]) * unit;
        sum.scattered_lower = from_fixed(cells[layout.scattered(region, true) + band]) * unit;
        return sum;
    }

    const Evaluation& evaluation_;
    const Organ& organ_;
};

/// The estimate of a number per replicate; if nothing was seen in any, the bound made of
/// `per_find`.
Estimate seen_or_bound(std::span<const double> values, double per_find) {
    const auto is_zero = [](double x) { return x == 0; };
    if (per_find > 0 && std::all_of(values.begin(), values.end(), is_zero)) {
        return estimate_unseen(static_cast<double>(values.size()), per_find);
    }
    return estimate_mean(values);
}

/// The largest share of light that a side of the organ absorbs.
double largest_absorptance(const Evaluation& evaluation, const Organ& organ, std::size_t band) {
    double largest = 0;
    for (std::uint32_t i = 0; i < organ.region_count; ++i) {
        const Material& material = evaluation.prepared.material(organ.first_region + i);
        largest = std::max(
            {largest, material.side(true).absorptance()[band],
             material.side(false).absorptance()[band]});
    }
    return largest;
}

/// Estimator::flux_per_find of an organ; nothing falls on one of no area.
double flux_per_find(const Evaluation& evaluation, const Organ& organ, std::size_t band) {
    return organ.area > 0
               ? evaluation.estimator.flux_per_find(organ.first_region, band, evaluation.paths)
               : 0;
}

/// Turns the cells of one organ after the other into estimates.
class OrganEvaluator {
  public:
    explicit OrganEvaluator(const Evaluation& evaluation)
        : evaluation_(evaluation),
          values_(evaluation.replicates.count()),
          incident_(evaluation.prepared.bands(), values_) {
        samples_.fill(values_);
    }

    void evaluate(
        std::size_t index,
        const std::vector<std::pair<std::size_t, std::size_t>>& ratios,
        Result& result) {
        const Organ& organ = evaluation_.prepared.scene().organs()[index];
        if (!evaluation_.estimator.measures(organ)) {
            leave_out(index, ratios.size(), result);
            return;
        }
        for (std::size_t b = 0; b < result.bands; ++b) {
            evaluate_band(organ, index, b, result);
        }
        for (std::size_t i = 0; i < ratios.size(); ++i) {
            result.ratio_values[index * ratios.size() + i] =
                estimate_ratio(incident_[ratios[i].first], incident_[ratios[i].second]);
        }
        if (!result.sunlit_fraction.empty()) {
            result.sunlit_fraction[index] = sunlit_fraction(organ);
        }
    }

  private:
    /// An organ that nobody asked for.
    static void leave_out(std::size_t index, std::size_t ratios, Result& result) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        constexpr Estimate kUnknown{kNone, kNone, kNone, kNone};
        const std::size_t values = kQuantities * result.bands;
        std::fill_n(&result.values[index * values], values, kUnknown);
        std::fill_n(result.ratio_values.begin() + index * ratios, ratios, kUnknown);
        if (!result.sunlit_fraction.empty()) {
            result.sunlit_fraction[index] = kUnknown;
        }
    }

    void evaluate_band(const Organ& organ, std::size_t index, std::size_t band, Result& result) {
        const OrganReader reader(evaluation_, organ);
        // An organ of no area receives nothing.
        const double per_area = organ.area > 0 ? 1 / organ.area : 0;
        for (std::uint32_t r = 0; r < values_.size(); ++r) {
            sample(r, reader.incident(r, band), per_area);
            incident_[band][r] = sample_of(Quantity::incident_direct)[r] +
                                 sample_of(Quantity::incident_scattered)[r];
        }
        const double find = flux_per_find(evaluation_, organ, band);
        const double absorbed = largest_absorptance(evaluation_, organ, band);
        for (const QuantityEntry& entry : quantity_table()) {
            const bool is_absorbed = entry.quantity == Quantity::absorbed_flux ||
                                     entry.quantity == Quantity::absorbed_flux_density;
            const double bound =
                find * (entry.is_flux ? 1 : per_area) * (is_absorbed ? absorbed : 1);
            const auto q = static_cast<std::size_t>(entry.quantity);
            result.values[(index * kQuantities + q) * result.bands + band] =
                seen_or_bound(samples_[q], bound);
        }
    }

    std::vector<double>& sample_of(Quantity q) { return samples_[static_cast<std::size_t>(q)]; }

    void sample(std::uint32_t replicate, const Incident& in, double per_area) {
        const auto put = [&](Quantity q, double value) { sample_of(q)[replicate] = value; };
        put(Quantity::absorbed_flux, in.absorbed);
        put(Quantity::absorbed_flux_density, in.absorbed * per_area);
        put(Quantity::incident_upper, (in.direct_upper + in.scattered_upper) * per_area);
        put(Quantity::incident_lower, (in.direct_lower + in.scattered_lower) * per_area);
        put(Quantity::incident_direct, (in.direct_upper + in.direct_lower) * per_area);
        put(Quantity::incident_scattered, (in.scattered_upper + in.scattered_lower) * per_area);
    }

    [[nodiscard]] Estimate sunlit_fraction(const Organ& organ) {
        const OrganReader reader(evaluation_, organ);
        const double per_area = organ.area > 0 ? 1 / organ.area : 0;
        for (std::uint32_t r = 0; r < values_.size(); ++r) {
            values_[r] = reader.sunlit_area(r) * per_area;
        }
        const double find =
            evaluation_.estimator.sunlit_area_per_find(organ.first_region, evaluation_.paths);
        return seen_or_bound(values_, find * per_area);
    }

    const Evaluation& evaluation_;
    std::vector<double> values_;                            // per replicate
    std::array<std::vector<double>, kQuantities> samples_;  // per replicate
    std::vector<std::vector<double>> incident_;             // per band and replicate, per area
};

/// Runs work(first, last) for all organs, some at a time, on all threads.
template <typename Work>
void for_each_block(const Evaluation& evaluation, const Work& work) {
    const std::size_t n = evaluation.prepared.scene().organs().size();
    parallel_blocks(
        (n + kOrgansPerBlock - 1) / kOrgansPerBlock, evaluation.threads,
        [&](std::uint64_t block, unsigned) {
            const std::size_t first = block * kOrgansPerBlock;
            work(first, std::min(n, first + kOrgansPerBlock));
        });
}

/// Whether the absorbed flux of an organ is known to the target in every band; what can't absorb
/// any light is.
bool is_at_target(const Evaluation& evaluation, std::size_t index, double target) {
    const Organ& organ = evaluation.prepared.scene().organs()[index];
    if (!evaluation.estimator.measures(organ)) {
        return true;
    }
    const OrganReader reader(evaluation, organ);
    std::vector<double> absorbed(evaluation.replicates.count());
    for (std::size_t b = 0; b < evaluation.prepared.bands(); ++b) {
        for (std::uint32_t r = 0; r < absorbed.size(); ++r) {
            absorbed[r] = reader.incident(r, b).absorbed;
        }
        const double find =
            flux_per_find(evaluation, organ, b) * largest_absorptance(evaluation, organ, b);
        const Estimate estimate = seen_or_bound(absorbed, find);
        if (!(estimate.standard_error <= target * estimate.mean)) {
            return false;
        }
    }
    return true;
}

}  // namespace

const std::array<QuantityEntry, kQuantities>& quantity_table() {
    static constexpr std::array<QuantityEntry, kQuantities> kTable{{
        {Quantity::absorbed_flux, "absorbed_flux", "light absorbed by the organ", true},
        {Quantity::absorbed_flux_density, "absorbed_flux_density",
         "light absorbed per one-sided area", false},
        {Quantity::incident_upper, "incident_upper", "light falling on the upper side per area",
         false},
        {Quantity::incident_lower, "incident_lower", "light falling on the lower side per area",
         false},
        {Quantity::incident_direct, "incident_direct",
         "light falling on both sides straight from the sources per area", false},
        {Quantity::incident_scattered, "incident_scattered",
         "light falling on both sides after other surfaces per area", false},
    }};
    return kTable;
}

void evaluate_organs(
    const Evaluation& evaluation,
    const std::vector<std::pair<std::size_t, std::size_t>>& ratios,
    Result& result) {
    const std::size_t organs = evaluation.prepared.scene().organs().size();
    result.bands = evaluation.prepared.bands();
    result.ratios = ratios.size();
    result.values.resize(organs * kQuantities * result.bands);
    result.ratio_values.resize(organs * ratios.size());
    result.sunlit_fraction.resize(evaluation.prepared.sun_area() > 0 ? organs : 0);
    for_each_block(evaluation, [&](std::size_t first, std::size_t last) {
        OrganEvaluator evaluator(evaluation);
        for (std::size_t i = first; i < last; ++i) {
            evaluator.evaluate(i, ratios, result);
        }
    });
}

double fraction_at_target(const Evaluation& evaluation, double target) {
    std::atomic<std::size_t> reached{0};
    for_each_block(evaluation, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            reached += is_at_target(evaluation, i, target) ? 1 : 0;
        }
    });
    return static_cast<double>(reached) /
           static_cast<double>(evaluation.prepared.scene().organs().size());
}

std::uint64_t count_rays(const Replicates& replicates) {
    std::uint64_t rays = 0;
    for (std::uint32_t r = 0; r < replicates.count(); ++r) {
        rays += static_cast<std::uint64_t>(replicates.cells(r)[replicates.layout().rays()]);
    }
    return rays;
}

}  // namespace quasimc
