#include "replicates.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "result.h"
#include "results/evaluate.h"
#include "results/groups.h"
#include "results/totals.h"
#include "run/evaluation_of.h"
#include "run/run_state.h"
#include "summable_light.h"
#include "sums/origin_sums.h"
#include "sums/sum_data.h"

namespace quasimc::python {
namespace {

double bytes_of(const SumData& sums) {
    return static_cast<double>(sums.replicates.size()) * static_cast<double>(sums.layout.bins()) *
           sizeof(std::int64_t);
}

/// Light of a quantity in a band, read from the sums once.
std::shared_ptr<SummableLight> light_of(
    ReplicateSums& kept, std::size_t quantity, std::size_t band) {
    const LightKey key{quantity, band};
    const auto is_it = [&](const auto& known) { return known.first == key; };
    if (const auto known = std::ranges::find_if(kept.lights, is_it); known != kept.lights.end()) {
        return known->second;
    }
    const auto made = std::make_shared<SummableLight>(unlocked([&] {
        return quantity == kQuantities
                   ? SummableLight::of_sunlit_area(kept.sums, *kept.scene, kept.spec)
                   : SummableLight::of_flux(
                         kept.sums, *kept.scene, kept.spec,
                         kQuantityRows.at(quantity).entry.quantity, band);
    }));
    kept.lights.emplace_back(key, made);
    const auto bytes = [](double sum, const auto& known) {
        return sum + static_cast<double>(known.second->numbers().size() * sizeof(double));
    };
    while (kept.lights.size() > 1 &&
           std::accumulate(kept.lights.begin(), kept.lights.end(), 0.0, bytes) >
               bytes_of(*kept.sums)) {
        kept.lights.erase(kept.lights.begin());
    }
    return made;
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

}  // namespace

void SumsKeeper::on_last_round(const RunSoFar& run) {
    const Sums& sums = *run.snapshot().done;
    sums_ = bytes_of(*sums) <= max_bytes_ ? std::make_unique<Sums>(sums) : nullptr;
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
        .def("light", &light_of, py::arg("quantity"), py::arg("band"))
        .def("totals", &totals_of)
        .def("groups", &groups_of, py::arg("labels"), py::arg("layers"), py::arg("layer_heights"))
        .def("whole", &whole_of)
        .def("origin", &origin_of, py::arg("name"));
}

}  // namespace quasimc::python
