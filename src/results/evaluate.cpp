#include "results/evaluate.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/checks.h"
#include "results/bounds/organ_contributions.h"
#include "results/bounds/organ_reader.h"
#include "results/bounds/physical_bounds.h"
#include "results/cut_intervals.h"
#include "results/flows.h"
#include "results/groups.h"
#include "results/sun_shade.h"
#include "results/totals.h"
#include "sums/origin_sums.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

/// The input of evaluate().
struct Given {
    const Sums& sums;
    const Scene& scene;
    const EvaluationSpec& spec;
};

/// Turns the sums of organs into estimates, one organ at a time.
class OrganEvaluator {
  public:
    explicit OrganEvaluator(const Given& given)
        : sums_(given.sums),
          reader_(given.sums),
          scene_(given.scene),
          spec_(given.spec),
          sun_shade_(given.sums, given.scene, given.spec),
          values_(given.sums->replicates.size()),
          incident_(given.sums->bands(), values_),
          contributions_(given.sums->bands()) {
        samples_.fill(values_);
    }

    /// Fills in all values of an organ.
    /// @param totals  by band: get its contributions
    void evaluate(std::size_t index, Result& result, std::vector<TotalContributions>& totals) {
        const Organ& organ = scene_.organs()[index];
        const OrganReader reader(reader_, scene_, spec_, organ);
        const auto& ratios = spec_.ratios;
        if (!is_measured(sums_, organ)) {
            leave_out(index, ratios.size(), result);
            return;
        }
        read(reader, result.bands);
        for (std::size_t b = 0; b < result.bands; ++b) {
            evaluate_band(reader, organ, index, b, result);
            totals[b].include(contributions_[b], scene_, organ);
        }
        for (std::size_t i = 0; i < ratios.size(); ++i) {
            const auto [above, below] = ratios[i];
            result.ratio_values[index * ratios.size() + i] = OrganContributions::estimate_ratio(
                contributions_[above], contributions_[below], incident_[above], incident_[below]);
        }
        if (!result.sunlit_fraction.empty()) {
            result.sunlit_fraction[index] = sunlit_fraction(reader, organ);
        }
        if (!result.sun_shade.empty()) {
            sun_shade_.evaluate(organ, sun_shade_of(index, result));
        }
    }

  private:
    static std::span<Estimate> sun_shade_of(std::size_t index, Result& result) {
        const std::size_t size = result.sun_shade.values_per_row();
        return std::span(result.sun_shade.values).subspan(index * size, size);
    }

    /// Fills in an organ that is not measured.
    static void leave_out(std::size_t index, std::size_t ratios, Result& result) {
        const std::size_t values = kQuantities * result.bands;
        std::fill_n(&result.values[index * values], values, kUnknownEstimate);
        std::fill_n(result.ratio_values.begin() + index * ratios, ratios, kUnknownEstimate);
        if (!result.sunlit_fraction.empty()) {
            result.sunlit_fraction[index] = kUnknownEstimate;
        }
        if (!result.sun_shade.empty()) {
            std::ranges::fill(sun_shade_of(index, result), kUnknownEstimate);
        }
    }

    /// Reads the light of an organ in the order of its bins.
    void read(const OrganReader& reader, std::size_t bands) {
        light_.resize(bands * values_.size());
        for (std::uint32_t r = 0; r < values_.size(); ++r) {
            for (std::size_t b = 0; b < bands; ++b) {
                light_[b * values_.size() + r] = reader.incident(r, b);
            }
        }
    }

    void evaluate_band(
        const OrganReader& reader,
        const Organ& organ,
        std::size_t index,
        std::size_t band,
        Result& result) {
        // An organ of no area receives nothing.
        const double per_area = organ.area > 0 ? 1 / organ.area : 0;
        Incident all;
        for (std::uint32_t r = 0; r < values_.size(); ++r) {
            const Incident& light = light_[band * values_.size() + r];
            all += light;
            put_sample(r, light, per_area, samples_);
            incident_[band][r] = (sample_of(Quantity::incident_direct)[r] +
                                  sample_of(Quantity::incident_scattered)[r]) *
                                 organ.area;
        }
        contributions_[band] = OrganContributions(reader, band, all);
        for (const QuantityEntry& entry : quantity_table()) {
            const auto q = static_cast<std::size_t>(entry.quantity);
            result.values[(index * kQuantities + q) * result.bands + band] =
                contributions_[band].estimate(entry, per_area, samples_[q]);
        }
    }

    std::vector<double>& sample_of(Quantity q) { return samples_[static_cast<std::size_t>(q)]; }

    [[nodiscard]] Estimate sunlit_fraction(const OrganReader& reader, const Organ& organ) {
        const double per_area = organ.area > 0 ? 1 / organ.area : 0;
        for (std::uint32_t r = 0; r < values_.size(); ++r) {
            values_[r] = reader.sunlit_area(r) * per_area;
        }
        return OrganContributions::sunlit(reader).estimate_sunlit(organ.area, values_);
    }

    const Sums& sums_;
    SumReader reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    SunShadeEvaluator sun_shade_;
    std::vector<double> values_;   // per replicate
    std::vector<Incident> light_;  // of the organ, [band * replicates + replicate]
    QuantitySamples samples_;
    std::vector<std::vector<double>> incident_;      // [band][replicate], flux on both sides
    std::vector<OrganContributions> contributions_;  // [band]
};

/// Fills in all organs.
/// @param is_done  called with (first, last) when the sums of these organs are not needed any more
/// @returns the contributions to the totals, by band
template <typename IsDone>
std::vector<TotalContributions> evaluate_organs(
    const Given& given, const IsDone& is_done, Result& result) {
    constexpr std::size_t kMaxPerStep = 1 << 15, kMinPerStep = 1 << 12;
    const std::size_t step = std::max(kMaxPerStep / result.bands, kMinPerStep);
    const std::size_t organs = given.scene.organs().size();
    const std::size_t values = kQuantities * result.bands;
    const bool has_sun = given.sums->units.sunlit_area > 0;
    const bool has_parts = given.spec.sun_shade == SunShade::apart;
    result.sun_shade.bands = result.bands;
    result.values.reserve(organs * values);
    result.ratio_values.reserve(organs * result.ratios);
    result.sunlit_fraction.reserve(has_sun ? organs : 0);
    std::vector<TotalContributions> totals(result.bands);
    for (std::size_t begin = 0; begin < organs; begin += step) {
        const std::size_t end = std::min(organs, begin + step);
        result.values.resize(end * values);
        result.ratio_values.resize(end * result.ratios);
        result.sunlit_fraction.resize(has_sun ? end : 0);
        result.sun_shade.values.resize(has_parts ? end * result.sun_shade.values_per_row() : 0);
        gather_contributions(
            begin, end, given.spec.threads,
            [&](std::size_t first, std::size_t last, std::vector<TotalContributions>& own) {
                OrganEvaluator evaluator(given);
                for (std::size_t i = first; i < last; ++i) {
                    evaluator.evaluate(i, result, own);
                }
            },
            totals);
        is_done(begin, end);
    }
    return totals;
}

/// Evaluates sums, and reports which sums are not needed any more.
template <typename IsDone>
Result evaluate_sums(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, const IsDone& is_done) {
    EXPECT(sums->samples > 0 && sums->layout.regions() == scene.regions().size());
    Result result;
    result.bands = sums->bands();
    result.names = scene.names();
    result.ratios = spec.ratios.size();
    // Values that need the sums of many organs come before the sums are released.
    const BandFlows flows = read_flows(sums, scene);
    result.groups = evaluate_groups(sums, scene, spec, horizontal_flux(flows, scene, spec));
    if (spec.sun_shade == SunShade::apart) {
        result.groups.sun_shade = evaluate_sun_shade(sums, scene, spec, result.groups.groups);
    }
    result.detectors = evaluate_detectors(sums, scene);
    result.rays = sums.rays();
    const std::vector<TotalContributions> totals =
        evaluate_organs({sums, scene, spec}, is_done, result);
    std::vector<TotalSizes> sizes;
    for (std::size_t b = 0; b < result.bands; ++b) {
        sizes.push_back(sizes_of(totals[b], flows[b]));
    }
    result.budget = evaluate_budget(flows, sizes, sums->emitted_flux);
    result.canopy = evaluate_canopy(flows, sizes, sums->emitted_flux, scene, spec);
    result.escaped_by_difference = sums->escaped == EscapedLight::remainder;
    result.paths = sums.paths();
    result.replicates = static_cast<std::uint32_t>(sums->replicates.size());
    cut_intervals(PhysicalBounds(scene, spec, sums->emitted_flux), scene, spec, result);
    return result;
}

/// Evaluates sums of all origins together, and of each of them.
Result evaluate_with_origins(const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    Result result = evaluate(of_all_origins(sums), scene, spec);
    for (std::size_t i = 0; i < sums->origins.size(); ++i) {
        result.origins.push_back(
            {sums->origins[i].name,
             evaluate(of_origin(sums, i), scene, evaluation_of_origin(spec, i))});
    }
    return result;
}

}  // namespace

GroupResults groups_of_sums(const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    GroupResults groups =
        evaluate_groups(sums, scene, spec, horizontal_flux(read_flows(sums, scene), scene, spec));
    cut_groups(PhysicalBounds(scene, spec, sums->emitted_flux), scene, spec, groups);
    return groups;
}

EvaluationSpec evaluation_of_origin(const EvaluationSpec& spec, std::size_t origin) {
    const OriginSources known = spec.origins.empty() ? OriginSources{} : spec.origins[origin];
    EvaluationSpec own = spec;
    own.ratios.clear();
    own.horizontal_irradiance = known.horizontal_irradiance;
    own.sources = known.sources;
    own.origins.clear();
    own.sun_shade = SunShade::together;
    return own;
}

Result evaluate(const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    if (!sums->origins.empty()) {
        return evaluate_with_origins(sums, scene, spec);
    }
    return evaluate_sums(sums, scene, spec, [](std::size_t, std::size_t) {});
}

Result evaluate(Sums&& sums, const Scene& scene, const EvaluationSpec& spec) {
    if (!sums->origins.empty()) {
        return evaluate_with_origins(sums, scene, spec);
    }
    Sums own = std::move(sums);
    return evaluate_sums(own, scene, spec, [&](std::size_t first, std::size_t last) {
        const std::vector<Organ>& organs = scene.organs();
        const std::size_t end =
            last < organs.size() ? organs[last].first_region : own->layout.regions();
        const std::size_t stride = own->layout.stride();
        for (ExactBins& bins : own->replicates) {
            bins.clear(organs[first].first_region * stride, end * stride);
        }
    });
}

}  // namespace quasimc
