#include "summable_light.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include <pybind11/stl.h>

#include "base/parallel.h"
#include "results/combine.h"
#include "results/summable_light.h"

namespace quasimc::python {

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

Numbers sizes_of(const std::vector<ContributionSize>& sizes, std::vector<py::ssize_t> shape) {
    Numbers array(std::move(shape));
    double* out = array.mutable_data();
    for (const ContributionSize& size : sizes) {
        *out++ = size.more;
        *out++ = size.less;
    }
    return array;
}

namespace {

using RowStarts = py::array_t<std::int64_t, py::array::c_style>;
using OrganIndices = py::array_t<std::uint32_t, py::array::c_style>;

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

std::shared_ptr<SummableLight> combined(
    const SummableLight& light,
    const RowStarts& starts,
    const OrganIndices& organs,
    const Numbers& weights) {
    const std::vector<OrganWeights> rows = rows_of(starts, organs, weights);
    return unlocked(
        [&] { return std::make_shared<SummableLight>(light.combined(rows, thread_count(0))); });
}

/// A view of numbers of a light, which it keeps alive.
py::array view_of(const double* first, std::vector<py::ssize_t> shape, const py::object& owner) {
    Numbers view(std::move(shape), first, owner);
    view.attr("flags").attr("writeable") = false;
    return view;
}

/// The numbers of a light as arrays, to be stored.
py::tuple state_of(const SummableLight& light) {
    const SummableColumns& columns = light.columns();
    py::list kinds;
    for (const ContributionKind& kind : columns.kinds) {
        kinds.append(py::make_tuple(static_cast<int>(kind.sample), kind.many));
    }
    return py::make_tuple(
        static_cast<int>(columns.summand), columns.replicates, kinds,
        Numbers(static_cast<py::ssize_t>(light.numbers().size()), light.numbers().data()));
}

std::shared_ptr<SummableLight> light_from(const py::tuple& state) {
    SummableColumns columns;
    columns.summand = static_cast<Summand>(state[0].cast<int>());
    columns.replicates = state[1].cast<std::uint32_t>();
    for (const auto& [sample, many] : state[2].cast<std::vector<std::pair<int, double>>>()) {
        columns.kinds.push_back({static_cast<Sample>(sample), many});
    }
    const auto numbers = state[3].cast<Numbers>();
    return std::make_shared<SummableLight>(
        std::move(columns), std::vector<double>(numbers.data(), numbers.data() + numbers.size()));
}

/// See estimate_signed().
/// @param deviations  (replicates, n), from the means
/// @param sizes  (n, 2): the change by one contribution more, and by one less
Numbers estimates(const Numbers& means, const Numbers& deviations, const Numbers& sizes) {
    const auto count = static_cast<std::size_t>(means.size());
    if (count == 0) {
        return array_of({}, {0});
    }
    std::vector<ContributionSize> of_contributions(count);
    for (std::size_t i = 0; i < count; ++i) {
        of_contributions[i] = {sizes.data()[2 * i], sizes.data()[2 * i + 1]};
    }
    const SignedNumbers numbers{
        std::span(means.data(), count),
        std::span(deviations.data(), static_cast<std::size_t>(deviations.size())),
        of_contributions};
    // Below this a thread starts later than it would end.
    constexpr std::size_t kFewNumbers = 1 << 16;
    const unsigned threads = count < kFewNumbers ? 1 : thread_count(0);
    return array_of(
        unlocked([&] { return estimate_signed(numbers, threads); }),
        {static_cast<py::ssize_t>(count)});
}

}  // namespace

void bind_summable_light(py::module_& module) {
    const auto size = [](const SummableLight& light) {
        return static_cast<py::ssize_t>(light.size());
    };
    py::class_<SummableLight, std::shared_ptr<SummableLight>>(module, "SummableLight")
        .def("__len__", size)
        .def_property_readonly(
            "replicates", [](const SummableLight& light) { return light.columns().replicates; })
        .def_property_readonly(
            "means",
            [size](const py::object& self) {
                const auto& light = self.cast<const SummableLight&>();
                return view_of(light.means().data(), {size(light)}, self);
            })
        .def_property_readonly(
            "deviations",
            [size](const py::object& self) {
                const auto& light = self.cast<const SummableLight&>();
                const py::ssize_t replicates = light.columns().replicates;
                return view_of(light.deviations().data(), {replicates, size(light)}, self);
            })
        .def_property_readonly(
            "sizes",
            [size](const SummableLight& light) {
                return sizes_of(light.sizes(), {size(light), 2});
            })
        .def(
            "estimates",
            [size](const SummableLight& light) {
                return array_of(unlocked([&] { return light.estimates(); }), {size(light)});
            })
        .def("combined", &combined, py::arg("starts"), py::arg("organs"), py::arg("weights"))
        .def_static(
            "joined",
            [](const std::vector<const SummableLight*>& lights) {
                return SummableLight::joined(lights);
            },
            py::arg("lights"))
        .def(py::pickle(&state_of, &light_from));
    module.def("estimates", &estimates, py::arg("means"), py::arg("deviations"), py::arg("sizes"));
}

}  // namespace quasimc::python
