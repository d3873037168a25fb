#include "results/means.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/checks.h"
#include "results/bounds/organ_reader.h"
#include "results/flows.h"
#include "results/groups.h"
#include "results/organ_blocks.h"

namespace quasimc {
namespace {

Estimate mean_alone(double mean) {
    Estimate e = kUnknownEstimate;
    e.mean = mean;
    return e;
}

/// The values of item `index`, which has `each` of them.
std::span<Estimate> part(std::vector<Estimate>& all, std::size_t index, std::size_t each) {
    return std::span(all).subspan(index * each, each);
}

/// Turns light into the means of an organ's or a group's quantities and ratios.
class MeansWriter {
  public:
    MeansWriter(const EvaluationSpec& spec, std::size_t bands)
        : spec_(spec), on_both_sides_(bands) {}

    /// @param light  per band, flux
    /// @param values  [quantity][band]
    void write(
        std::span<const Incident> light,
        double area,
        std::span<Estimate> values,
        std::span<Estimate> ratios) {
        const std::size_t bands = light.size();
        const double per_area = area > 0 ? 1 / area : 0;
        for (std::size_t b = 0; b < bands; ++b) {
            const std::array<double, kQuantities> means = quantities_of(light[b], per_area);
            for (std::size_t q = 0; q < kQuantities; ++q) {
                values[q * bands + b] = mean_alone(means[q]);
            }
            on_both_sides_[b] = means[static_cast<std::size_t>(Quantity::incident_direct)] +
                                means[static_cast<std::size_t>(Quantity::incident_scattered)];
        }
        for (std::size_t i = 0; i < ratios.size(); ++i) {
            const auto [above, below] = spec_.ratios[i];
            const double all = on_both_sides_[below];
            ratios[i] = all == 0 ? kUnknownEstimate : mean_alone(on_both_sides_[above] / all);
        }
    }

  private:
    const EvaluationSpec& spec_;
    std::vector<double> on_both_sides_;  // per band, per area
};

/// Writes the means of organs and groups of a scene.
class SceneMeans {
  public:
    SceneMeans(const Sums& sums, const Scene& scene, const EvaluationSpec& spec, Result& result)
        : sums_(sums), reader_(sums), scene_(scene), spec_(spec), result_(result) {}

    void write_organs() const {
        result_.values.resize(scene_.organs().size() * kQuantities * result_.bands);
        result_.ratio_values.resize(scene_.organs().size() * result_.ratios);
        for_each_block(scene_, spec_.threads, [&](std::size_t first, std::size_t last) {
            MeansWriter writer(spec_, result_.bands);
            std::vector<Incident> light(result_.bands);
            for (std::size_t i = first; i < last; ++i) {
                write_organ(i, light, writer);
            }
        });
    }

    void write_groups(const std::vector<OrganGroup>& groups) const {
        GroupResults& to = result_.groups;
        to.bands = result_.bands;
        to.ratios = result_.ratios;
        to.values.resize(groups.size() * kQuantities * to.bands);
        to.ratio_values.resize(groups.size() * to.ratios);
        parallel_blocks(groups.size(), spec_.threads, [&](std::uint64_t g, unsigned) {
            std::vector<Incident> light(to.bands);
            for (const std::uint32_t organ : groups[g].organs) {
                const OrganReader reader(reader_, scene_, spec_, scene_.organs()[organ]);
                for (std::size_t b = 0; b < to.bands; ++b) {
                    light[b] += reader.incident(0, b);
                }
            }
            MeansWriter(spec_, to.bands)
                .write(
                    light, groups[g].area, part(to.values, g, kQuantities * to.bands),
                    part(to.ratio_values, g, to.ratios));
        });
    }

  private:
    void write_organ(std::size_t index, std::vector<Incident>& light, MeansWriter& writer) const {
        const Organ& organ = scene_.organs()[index];
        const std::span<Estimate> values = part(result_.values, index, kQuantities * result_.bands);
        const std::span<Estimate> ratios = part(result_.ratio_values, index, result_.ratios);
        if (!is_measured(sums_, organ)) {
            std::fill(values.begin(), values.end(), kUnknownEstimate);
            std::fill(ratios.begin(), ratios.end(), kUnknownEstimate);
            return;
        }
        const OrganReader reader(reader_, scene_, spec_, organ);
        for (std::size_t b = 0; b < light.size(); ++b) {
            light[b] = reader.incident(0, b);
        }
        writer.write(light, organ.area, values, ratios);
    }

    const Sums& sums_;
    SumReader reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    Result& result_;
};

}  // namespace

Result evaluate_means(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<OrganGroup>& groups) {
    EXPECT(sums->samples > 0 && sums->replicates.size() == 1);
    Result result;
    result.bands = sums->bands();
    result.names = scene.names();
    result.ratios = spec.ratios.size();
    const BandFlows flows = read_flows(sums, scene);
    result.budget = evaluate_budget(flows);
    result.canopy = evaluate_canopy(flows, sums, scene, spec);
    const SceneMeans means(sums, scene, spec, result);
    means.write_organs();
    means.write_groups(groups);
    return result;
}

}  // namespace quasimc
