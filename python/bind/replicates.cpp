#include "replicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "result.h"
#include "results/combine.h"
#include "results/evaluate.h"
#include "results/groups.h"
#include "results/totals.h"
#include "run/evaluation_of.h"
#include "run/run_state.h"
#include "sums/origin_sums.h"
#include "sums/statistics.h"
#include "sums/sum_data.h"

namespace quasimc::python {
namespace {

using RowStarts = py::array_t<std::int64_t, py::array::c_style>;
using OrganIndices = py::array_t<std::uint32_t, py::array::c_style>;
using Numbers = py::array_t<double, py::array::c_style>;

/// Rows of a sparse matrix of weights, of organs: views of its arrays.
std::vector<OrganWeights> rows_of(
    const RowStarts& starts, const OrganIndices& organs, const Numbers& weights) {
    std::vector<OrganWeights> rows;
    for (py::ssize_t i = 0; i + 1 < starts.size(); ++i) {
        const auto first = static_cast<std::size_t>(starts.at(i));
        const auto count = static_cast<std::size_t>(starts.at(i + 1)) - first;
        rows.push_back(
            {std::span(organs.data(), organs.size()).subspan(first, count),
             std::span(weights.data(), weights.size()).subspan(first, count)});
    }
    return rows;
}

/// @param shape  of the estimates, to which an axis of (mean, standard error, low, high) is added
Numbers array_of(const std::vector<Estimate>& estimates, std::vector<py::ssize_t> shape) {
    shape.push_back(4);
    Numbers array(std::move(shape));
    double* out = array.mutable_data();
    for (const Estimate& estimate : estimates) {
        const Estimate e = reported(estimate);
        for (const double number : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
            *out++ = number;
        }
    }
    return array;
}

/// The result of a computation, meanwhile without the lock of the interpreter.
template <typename Compute>
auto unlocked(const Compute& compute) {
    const py::gil_scoped_release release;
    return compute();
}

Numbers combined(
    const ReplicateSums& kept,
    const RowStarts& starts,
    const OrganIndices& organs,
    const Numbers& weights) {
    const std::vector<OrganWeights> rows = rows_of(starts, organs, weights);
    const auto values = unlocked([&] { return combine(kept.sums, *kept.scene, kept.spec, rows); });
    return array_of(
        values, {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(kQuantities),
                 static_cast<py::ssize_t>(kept.sums->bands())});
}

Numbers combined_sunlit(
    const ReplicateSums& kept,
    const RowStarts& starts,
    const OrganIndices& organs,
    const Numbers& weights) {
    const std::vector<OrganWeights> rows = rows_of(starts, organs, weights);
    const auto values =
        unlocked([&] { return combine_sunlit(kept.sums, *kept.scene, kept.spec, rows); });
    return array_of(values, {static_cast<py::ssize_t>(values.size())});
}

/// @param shape  (..., 2): one contribution more, and one less
Numbers sizes_of(const std::vector<ContributionSize>& sizes, std::vector<py::ssize_t> shape) {
    Numbers array(std::move(shape));
    double* out = array.mutable_data();
    for (const ContributionSize& size : sizes) {
        *out++ = size.more;
        *out++ = size.less;
    }
    return array;
}

/// Values (replicates, sums, bands), and sizes of a contribution (sums, bands, 2).
py::tuple tuple_of(
    const CombinedReplicates& all, const ReplicateSums& kept, std::size_t sums, std::size_t bands) {
    const auto count = static_cast<py::ssize_t>(sums), columns = static_cast<py::ssize_t>(bands);
    const auto number = static_cast<py::ssize_t>(kept.sums->replicates.size());
    const Numbers values(std::vector<py::ssize_t>{number, count, columns}, all.values.data());
    return py::make_tuple(values, sizes_of(all.sizes, {count, columns, 2}));
}

py::tuple replicates(
    const ReplicateSums& kept,
    const RowStarts& starts,
    const OrganIndices& organs,
    const Numbers& weights,
    std::size_t quantity) {
    const std::vector<OrganWeights> rows = rows_of(starts, organs, weights);
    const std::array quantities{quantity_table().at(quantity).quantity};
    const CombinedReplicates all = unlocked(
        [&] { return combine_replicates(kept.sums, *kept.scene, kept.spec, rows, quantities); });
    return tuple_of(all, kept, rows.size(), kept.sums->bands());
}

py::tuple sunlit_replicates(
    const ReplicateSums& kept,
    const RowStarts& starts,
    const OrganIndices& organs,
    const Numbers& weights) {
    const std::vector<OrganWeights> rows = rows_of(starts, organs, weights);
    const CombinedReplicates all = unlocked(
        [&] { return combine_sunlit_replicates(kept.sums, *kept.scene, kept.spec, rows); });
    return tuple_of(all, kept, rows.size(), 1);
}

/// The light of the whole scene: name -> (values (replicates, bands), sizes (bands, 2)).
py::dict totals_of(const ReplicateSums& kept) {
    const auto all =
        unlocked([&] { return replicates_of_totals(kept.sums, *kept.scene, kept.spec); });
    const auto bands = static_cast<py::ssize_t>(kept.sums->bands());
    py::dict totals;
    for (const TotalReplicates& total : all) {
        const auto replicates = static_cast<py::ssize_t>(total.values.size()) / bands;
        totals[py::str(std::string(total.name))] = py::make_tuple(
            Numbers(std::vector<py::ssize_t>{replicates, bands}, total.values.data()),
            sizes_of(total.sizes, {bands, 2}));
    }
    return totals;
}

/// Groups of the kept sums, which are not those of the run: a dict as of groups_dict().
py::object groups_of(
    const ReplicateSums& kept,
    const std::vector<std::string>& labels,
    std::uint32_t layers,
    const std::vector<double>& layer_heights) {
    EvaluationSpec spec = kept.spec;
    spec.groups = {labels, layers, layer_heights};
    Faults faults;
    check_groups(*kept.scene, spec.groups, faults);
    faults.throw_if_any();
    auto groups = std::make_unique<GroupResults>();
    {
        const py::gil_scoped_release release;
        *groups = groups_of_sums(kept.sums, *kept.scene, spec);
        report_groups(*groups);
    }
    const GroupResults& results = *groups;
    const py::capsule owner(
        groups.release(), [](void* pointer) { delete static_cast<GroupResults*>(pointer); });
    return groups_dict(results, owner);
}

std::shared_ptr<ReplicateSums> origin_of(const ReplicateSums& kept, const std::string& name) {
    const auto& origins = kept.sums->origins;
    const auto found = std::ranges::find(origins, name, &SumOrigin::name);
    if (found == origins.end()) {
        throw py::key_error(name);
    }
    const auto index = static_cast<std::size_t>(found - origins.begin());
    EvaluationSpec spec = evaluation_of_origin(kept.spec, index);
    return std::make_shared<ReplicateSums>(
        ReplicateSums{kept.scene, of_origin(kept.sums, index), std::move(spec)});
}

/// The light of all origins together.
std::shared_ptr<ReplicateSums> whole_of(const ReplicateSums& kept) {
    return std::make_shared<ReplicateSums>(
        ReplicateSums{kept.scene, of_all_origins(kept.sums), kept.spec});
}

/// Estimates of numbers that may have any sign, as of sums: see OrganContributions::estimate().
/// @param deviations  (replicates, n), from the means
/// @param sizes  (n, 2): the change by one contribution more, and by one less
Numbers estimates(const Numbers& means, const Numbers& deviations, const Numbers& sizes) {
    const auto count = static_cast<std::size_t>(means.size());
    const auto replicates = static_cast<std::size_t>(deviations.shape(0));
    std::vector<Estimate> all(count);
    std::vector<double> samples(replicates);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t r = 0; r < replicates; ++r) {
            samples[r] = deviations.data()[r * count + i];
        }
        all[i] = estimate_signed(
            means.data()[i], samples, {sizes.data()[2 * i], sizes.data()[2 * i + 1]});
    }
    return array_of(all, {static_cast<py::ssize_t>(count)});
}

}  // namespace

void SumsKeeper::on_last_round(const RunSoFar& run) {
    const Sums& sums = *run.snapshot().done;
    const double bytes = static_cast<double>(sums->replicates.size()) *
                         static_cast<double>(sums->layout.bins()) * sizeof(std::int64_t);
    sums_ = bytes <= max_bytes_ ? std::make_unique<Sums>(sums) : nullptr;
}

std::shared_ptr<ReplicateSums> SumsKeeper::take(
    std::shared_ptr<const Scene> scene, const Sources& sources, const RunSpec& spec) {
    if (!sums_) {
        return nullptr;
    }
    RunSpec complete = spec;
    complete.origins.clear();
    for (const SumOrigin& origin : (*sums_)->origins) {
        complete.origins.push_back(origin.name);
    }
    EvaluationSpec evaluation = evaluation_of(*scene, sources, complete);
    const std::unique_ptr<Sums> own = std::move(sums_);
    return std::make_shared<ReplicateSums>(
        ReplicateSums{std::move(scene), std::move(*own), std::move(evaluation)});
}

void bind_replicates(py::module_& module) {
    py::class_<ReplicateSums, std::shared_ptr<ReplicateSums>>(module, "Replicates")
        .def_property_readonly(
            "count", [](const ReplicateSums& kept) { return kept.sums->replicates.size(); })
        .def("combine", &combined, py::arg("starts"), py::arg("organs"), py::arg("weights"))
        .def(
            "combine_sunlit", &combined_sunlit, py::arg("starts"), py::arg("organs"),
            py::arg("weights"))
        .def(
            "replicates", &replicates, py::arg("starts"), py::arg("organs"), py::arg("weights"),
            py::arg("quantity"))
        .def(
            "sunlit_replicates", &sunlit_replicates, py::arg("starts"), py::arg("organs"),
            py::arg("weights"))
        .def("totals", &totals_of)
        .def("groups", &groups_of, py::arg("labels"), py::arg("layers"), py::arg("layer_heights"))
        .def("whole", &whole_of)
        .def("origin", &origin_of, py::arg("name"));
    module.def("estimates", &estimates, py::arg("means"), py::arg("deviations"), py::arg("sizes"));
}

}  // namespace quasimc::python
