#include "resultio/read_run_data.h"

#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "options/options.h"
#include "resultio/json_parts.h"
#include "resultio/read_nodes.h"
#include "resultio/read_rows.h"
#include "results/evaluate.h"
#include "results/fraction_table.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The value from 0 to `last` with a name; `otherwise` if there is none.
template <typename Value, typename NameOf>
Value value_named(std::string_view name, Value last, Value otherwise, NameOf name_of) {
    for (int i = 0; i <= static_cast<int>(last); ++i) {
        if (name_of(static_cast<Value>(i)) == name) {
            return static_cast<Value>(i);
        }
    }
    return otherwise;
}

StopReason stop_of(std::string_view name) {
    return value_named(name, StopReason::no_light, StopReason::finished, stop_name);
}

Method method_of(std::string_view name) {
    return value_named(name, Method::automatic, Method::automatic, method_name);
}

void read_completed(const Node& light, Result& result) {
    if (const Node* method = light.find("method")) {
        result.chosen = {method_of(text_in(*method, "used")), text_in(*method, "reason")};
    }
    if (const Node* completed = light.find("completed")) {
        result.paths = count_in(*completed, "paths");
        result.replicates = static_cast<std::uint32_t>(count_in(*completed, "replicates"));
        result.rays = count_in(*completed, "rays");
        result.stop = stop_of(text_in(*completed, "stop"));
        result.fraction_at_target = number_in(*completed, "fraction_at_target");
    }
    if (const Node* timing = light.find("timing")) {
        result.preparation_seconds = number_in(*timing, "preparation_s");
        result.solve_seconds = number_in(*timing, "solve_s");
        result.solve_cpu_seconds = number_in(*timing, "solve_cpu_s");
    }
    result.escaped_by_difference = flag_in(light, "escaped_by_difference");
}

void read_rounds(const Node* rounds, Result& result) {
    for (std::size_t i = 0; const Node* round = item_at(rounds, i); ++i) {
        result.rounds.push_back(
            {count_in(*round, "paths"), number_in(*round, "seconds"),
             number_in(*round, "median_error"), number_in(*round, "worst_error"),
             number_in(*round, "fraction_at_target")});
    }
}

/// The object of a band; null if there is none.
const Node* of_band(const Node* bands, const Band& band) {
    return bands != nullptr ? bands->find(band.name) : nullptr;
}

/// Emitted light, whose interval is not written; it is exact if its error is 0.
Estimate emitted_of(const Node& energy) {
    const double mean = number_in(energy, "emitted");
    const double error = number_in(energy, "emitted_standard_error");
    return error == 0 ? Estimate{mean, 0, mean, mean} : Estimate{mean, error, kNan, kNan};
}

void read_energy(const Node* bands, const RunFile& run, Result& result) {
    for (const Band& band : run.scene.bands()) {
        const Node* energy = of_band(bands, band);
        if (energy == nullptr) {
            return;
        }
        const auto part = [&](std::string_view key) { return estimate_in(energy, key); };
        result.budget.push_back(
            {emitted_of(*energy), part("absorbed_by_organs"), part("absorbed_by_ground"),
             part("escaped"), part("cut_off"), part("imbalance"),
             number_in(*energy, "closure_error")});
    }
}

void read_audit(const Node* audit, const RunFile& run, Result& result) {
    if (audit == nullptr || audit->as<Node::Table>() == nullptr) {
        return;
    }
    Audit& read = result.audit.emplace();
    read.paths = count_in(*audit, "paths");
    read.replicates = static_cast<std::uint32_t>(count_in(*audit, "replicates"));
    read.p_value = number_in(*audit, "p_value");
    for (const Band& band : run.scene.bands()) {
        if (const Node* one = of_band(audit->find("bands"), band)) {
            read.bands.push_back(
                {number_in(*one, "reduced_chi_square"), number_in(*one, "degrees_of_freedom"),
                 number_in(*one, "chi_square_p_value"), number_in(*one, "difference"),
                 number_in(*one, "standard_error"), number_in(*one, "difference_p_value")});
        }
    }
}

void read_detectors(const Node* list, const RunFile& run, Result& result) {
    result.detectors = zero_detectors(run.scene);
    const std::size_t bands = run.scene.bands().size();
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        const Node* detector = item_at(list, d);
        const Node* bins = detector != nullptr ? detector->find("bins") : nullptr;
        std::vector<Estimate>& values = result.detectors[d].values;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const Node* bin = item_at(bins, i / bands);
            values[i] = estimate_in(
                bin != nullptr ? bin->find("flux") : nullptr, run.scene.bands()[i % bands].name);
        }
    }
}

/// Counts the time steps that were computed, by method and by the end of their runs.
void count_time_steps(const Node* time_steps, SeriesSummary& summary) {
    for (std::size_t i = 0; const Node* step = item_at(time_steps, i); ++i) {
        Result result;
        read_completed(*step, result);
        if (text_in(*step, "computed") == text_in(*step, "time") && result.paths > 0) {
            ++summary.methods[result.chosen.method];
            summary.at_target += result.stop == StopReason::target_reached ? 1 : 0;
        }
    }
}

}  // namespace

void read_run_data(const Node& light, const RunFile& run, Result& result) {
    read_completed(light, result);
    read_rounds(light.find("rounds"), result);
    read_energy(light.find("energy"), run, result);
    result.canopy = read_canopy(light, run);
    read_audit(light.find("audit"), run, result);
    read_detectors(light.find("detectors"), run, result);
}

std::vector<CanopyFractions> read_canopy(const Node& light, const RunFile& run) {
    const Node* bands = light.find("canopy");
    std::vector<CanopyFractions> canopy;
    for (const Band& band : run.scene.bands()) {
        if (const Node* own = of_band(bands, band)) {
            CanopyFractions& fractions = canopy.emplace_back();
            fractions.incident = number_in(*own, "incident");
            for (const FractionEntry& entry : fraction_table()) {
                fractions.*entry.part = estimate_in(own, entry.name);
            }
        }
    }
    return canopy.size() == run.scene.bands().size() ? canopy : std::vector<CanopyFractions>();
}

SeriesSummary read_series_summary(const Node& series) {
    SeriesSummary summary;
    if (const Node* completed = series.find("completed")) {
        summary.completed = count_in(*completed, "time_steps");
        summary.computed = count_in(*completed, "computed");
        summary.with_fewer_paths = count_in(*completed, "with_fewer_paths");
        summary.stop = stop_of(text_in(*completed, "stop"));
        summary.rays = count_in(*completed, "rays");
        summary.audited = count_in(*completed, "audited");
        summary.audit_p_value = number_in(*completed, "audit_p_value");
    }
    if (const Node* timing = series.find("timing")) {
        summary.seconds = number_in(*timing, "total_s");
        summary.preparation_seconds = number_in(*timing, "preparation_s");
        summary.solve_seconds = number_in(*timing, "solve_s");
        summary.solve_cpu_seconds = number_in(*timing, "solve_cpu_s");
    }
    count_time_steps(series.find("time_steps"), summary);
    return summary;
}

}  // namespace quasimc
