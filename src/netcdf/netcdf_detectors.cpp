#include "netcdf/netcdf_detectors.h"

#include <fmt/format.h>

#include "results/evaluate.h"
#include "results/units.h"

namespace quasimc {

NetcdfDetectors::NetcdfDetectors(const RunFile& run, NetcdfAxes& axes) : axes_(axes) {
    for (const DetectorResult& detector : zero_detectors(run.scene)) {
        const NetcdfAxes::Axis bins =
            axes.add_names(detector.name + "_bin", detector.quantity, detector.bins);
        std::vector<NetcdfEstimates>& of_lists = variables_.emplace_back();
        for (const NetcdfBands& list : axes.bands) {
            const Band& first = run.scene.bands()[list.bands.front()];
            of_lists.push_back(axes.add_estimates(
                {detector.name + list.suffix, flux_unit(first.unit, run.scene.length_unit()),
                 fmt::format("flux by {} in a detector {}", detector.quantity, detector.type)},
                {axes.time(), axes.band(), bins}));
        }
    }
}

void NetcdfDetectors::put(const std::vector<std::size_t>& start, const Result& result) {
    for (std::size_t d = 0; d < result.detectors.size(); ++d) {
        const DetectorResult& detector = result.detectors[d];
        const std::size_t bins = detector.bins.size();
        for (std::size_t l = 0; l < axes_.bands.size(); ++l) {
            const NetcdfBands& list = axes_.bands[l];
            axes_.put(
                variables_[d][l], start,
                list.suffix.empty() ? std::vector{list.bands.size(), bins} : std::vector{bins},
                [&](std::size_t i) { return detector.at(i % bins, list.bands[i / bins]); });
        }
    }
}

}  // namespace quasimc
