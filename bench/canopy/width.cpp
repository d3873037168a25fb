// Reported errors over true ones, and the coverage of 95 % intervals, by kind of quantity.
//
//     ./dev bench width --truths FOLDER            all scenes, both numbers of paths
//     ./dev bench width --cases slit --runs 20     some scenes, fewer seeds

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "methods.h"
#include "parts.h"
#include "width_scenes.h"
#include "width_truth.h"

namespace quasimc::bench {
namespace {

/// Squares of errors and counts of one kind of quantity in one band, over all seeds.
class WidthRow {
  public:
    void add_truth(const Estimate& truth) {
        ++quantities_;
        truths_ += truth.mean;
        truth_variance_ += truth.standard_error * truth.standard_error;
    }
    void add(const Estimate& e, const Estimate& truth) {
        const double error = e.mean - truth.mean;
        const double reported = e.standard_error;
        if (std::isfinite(reported)) {
            reported_ += reported * reported;
        }
        squares_ += error * error - truth.standard_error * truth.standard_error;
        bias_ += error;
        covered_ += e.ci95_low <= truth.mean && truth.mean <= e.ci95_high ? 1 : 0;
        ++count_;
    }
    void end_seed() {
        biases_.push_back(bias_ / quantities_);
        bias_ = 0;
    }

    [[nodiscard]] double quantities() const { return quantities_; }
    /// The mean of the truths.
    [[nodiscard]] double mean() const { return truths_ / quantities_; }
    /// Zero where the error of the truth exceeds the difference.
    [[nodiscard]] double rms() const { return std::sqrt(std::max(0., squares_) / count_); }
    [[nodiscard]] double reported_over_true() const {
        return squares_ > 0 ? std::sqrt(reported_ / squares_) : kUnknown;
    }
    /// Root mean square error of the truth over that of a run.
    [[nodiscard]] double truth_error() const {
        return rms() > 0 ? std::sqrt(truth_variance_ / quantities_) / rms() : kUnknown;
    }
    [[nodiscard]] double coverage() const { return covered_ / count_; }
    /// The mean error, and its standard error over seeds.
    [[nodiscard]] std::pair<double, double> bias() const {
        const auto runs = static_cast<double>(biases_.size());
        double sum = 0, squares = 0;
        for (const double bias : biases_) {
            sum += bias;
        }
        for (const double bias : biases_) {
            squares += (bias - sum / runs) * (bias - sum / runs);
        }
        return {sum / runs, std::sqrt(squares / std::max(1., runs - 1) / runs)};
    }

  private:
    static constexpr double kUnknown = kUnknownEstimate.mean;

    double quantities_ = 0, truths_ = 0, truth_variance_ = 0;
    double reported_ = 0, squares_ = 0, covered_ = 0, count_ = 0, bias_ = 0;
    std::vector<double> biases_;
};

/// By band and kind.
using WidthRows = std::map<std::pair<std::size_t, WidthKind>, WidthRow>;

/// The rows to which a quantity belongs; none if its truth is 0.
using RowsOfValues = std::vector<std::vector<WidthRow*>>;

/// A quarter of the median leaf, by band.
std::map<std::size_t, double> dim_limits(const std::vector<WidthValue>& truth) {
    std::map<std::size_t, std::vector<double>> leaves;
    for (const WidthValue& value : truth) {
        if (value.kind == WidthKind::leaves && value.estimate.mean != 0) {
            leaves[value.band].push_back(value.estimate.mean);
        }
    }
    std::map<std::size_t, double> limits;
    for (auto& [band, values] : leaves) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        limits[band] = *middle / 4;
    }
    return limits;
}

RowsOfValues rows_of(const std::vector<WidthValue>& truth, WidthRows& rows) {
    const std::map<std::size_t, double> limits = dim_limits(truth);
    RowsOfValues of_values(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const WidthValue& value = truth[i];
        if (value.estimate.mean == 0 || !std::isfinite(value.estimate.mean)) {
            continue;
        }
        of_values[i].push_back(&rows[{value.band, value.kind}]);
        const auto limit = limits.find(value.band);
        if (value.kind == WidthKind::leaves && limit != limits.end() &&
            value.estimate.mean < limit->second) {
            of_values[i].push_back(&rows[{value.band, WidthKind::dim_leaves}]);
        }
        for (WidthRow* row : of_values[i]) {
            row->add_truth(value.estimate);
        }
    }
    return of_values;
}

/// The band of a row, as a word.
std::string band_name(const WidthScene& scene, std::size_t band, WidthKind kind) {
    if (kind == WidthKind::sunlit) {
        return "-";
    }
    return kind == WidthKind::ratios ? scene.ratios[band] : scene.scene.bands()[band].name;
}

void print_rows(const WidthScene& scene, std::uint64_t paths, const WidthRows& rows) {
    for (const auto& [key, row] : rows) {
        const auto& [band, kind] = key;
        const double percent = 100 / row.mean();
        const auto [bias, bias_error] = row.bias();
        char biases[40];
        std::snprintf(biases, sizeof biases, "%.3g (%.2g)", percent * bias, percent * bias_error);
        std::printf(
            "%-14s %6llu %-11s %-10s %6.0f %9.2f %8.1f %18s %9.3g %9.2f\n", scene.name.c_str(),
            static_cast<unsigned long long>(paths), band_name(scene, band, kind).c_str(),
            name_of(kind), row.quantities(), row.reported_over_true(), 100 * row.coverage(), biases,
            percent * row.rms(), row.truth_error());
    }
}

void print_costs(
    const WidthScene& scene, double cpu_seconds, const std::string& method, const WidthRows& rows) {
    std::printf(
        "%-14s %s, %.4f s of CPU time a run; 1 / (rms^2 x CPU s):", "", method.c_str(),
        cpu_seconds);
    for (const auto& [key, row] : rows) {
        const bool is_leaf = key.second == WidthKind::leaves || key.second == WidthKind::day;
        if (is_leaf && row.rms() > 0) {
            const double relative = row.rms() / row.mean();
            std::printf(
                " %s %.4g", scene.scene.bands()[key.first].name.c_str(),
                1 / (relative * relative * cpu_seconds));
        }
    }
    std::printf("\n");
}

RunSpec spec_of(const WidthScene& scene, const Effort& effort) {
    RunSpec spec;
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
        if (effort.method == kMethodNames[i]) {
            spec.method = kMethods[i];
        }
    }
    if (!scene.hours.empty()) {
        spec.method = Method::ray_bundles;
        spec.time_method = TimeMethod::daylight_coefficients;
    }
    return spec;
}

void print_budget(
    const WidthScene& scene,
    const std::vector<WidthValue>& truth,
    const RunSpec& asked,
    std::uint32_t runs) {
    WidthRows rows;
    const RowsOfValues of_values = rows_of(truth, rows);
    RunSpec spec = asked;
    double cpu_seconds = 0;
    std::string method;
    Simulator simulator;
    for (std::uint32_t seed = 1; seed <= runs; ++seed) {
        spec.seed = seed;
        const WidthValues run = run_width(simulator, scene, spec);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            for (WidthRow* row : of_values[i]) {
                row->add(run.values[i].estimate, truth[i].estimate);
            }
        }
        for (auto& [key, row] : rows) {
            row.end_seed();
        }
        cpu_seconds += run.cpu_seconds / runs;
        method = run.method;
    }
    print_rows(scene, spec.paths, rows);
    print_costs(scene, cpu_seconds, method, rows);
}

}  // namespace

void print_width(const Effort& effort) {
    std::printf(
        "\n== Widths of intervals: reported over true errors of %u seeds; truth: its error over "
        "the rms error\n%-14s %6s %-11s %-10s %6s %9s %8s %18s %9s %9s\n",
        effort.width_runs, "scene", "paths", "band", "kind", "number", "rep/true", "cover %",
        "bias % (s.e.)", "rms %", "truth");
    const std::vector<std::uint64_t> all_paths = effort.only_paths > 0
                                                     ? std::vector{effort.only_paths}
                                                     : std::vector<std::uint64_t>{4096, 65536};
    for (const WidthCase& one : width_cases()) {
        if (std::string(one.name).find(effort.cases) == std::string::npos) {
            continue;
        }
        const WidthScene scene = one.make();
        RunSpec spec = spec_of(scene, effort);
        if (!can_run(spec.method, scene.scene)) {
            continue;
        }
        const std::vector<WidthValue> truth =
            truth_of(scene, effort.truths, scene.truth_paths / effort.truth_divisor);
        for (const std::uint64_t paths : all_paths) {
            spec.paths = paths;
            print_budget(scene, truth, spec, effort.width_runs);
        }
    }
}

}  // namespace quasimc::bench
