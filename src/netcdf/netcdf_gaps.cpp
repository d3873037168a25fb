#include "netcdf/netcdf_gaps.h"

#include <cstdint>

#include "runfile/run_file.h"

namespace quasimc {
namespace {

/// Defines the axes of a specification, with their coordinates.
class GapAxes {
  public:
    GapAxes(const GapFractionSpec& spec, NetcdfAxes& axes, NetcdfFile& file)
        : spec_(spec), axes_(axes), file_(file) {}

    /// An axis of bins, with their middles and bounds.
    /// @param bounds  one more than bins
    NetcdfAxes::Axis add_bins(
        const std::string& end, const std::string& summary, const std::vector<double>& bounds) {
        const std::string name = axes_.free_name(spec_.name + "_" + end);
        const std::string of_bounds = axes_.free_name(name + "_bounds");
        std::vector<double> middles, ends;
        for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
            middles.push_back((bounds[i] + bounds[i + 1]) / 2);
            ends.insert(ends.end(), {bounds[i], bounds[i + 1]});
        }
        const int bins = file_.add_dimension(name, middles.size());
        const NetcdfAttributes attributes{
            {"long_name", summary}, {"units", "degree"}, {"bounds", of_bounds}};
        file_.put(file_.add_variable(name, NetcdfType::real, {bins}, attributes), middles);
        file_.put(
            file_.add_variable(of_bounds, NetcdfType::real, {bins, axes_.bounds()}, {}), ends);
        return {bins, middles.size()};
    }

    /// @param coordinates  receives the names of the coordinates
    NetcdfAxes::Axis add_positions(std::string& coordinates) {
        const int dimension =
            file_.add_dimension(axes_.free_name(spec_.name + "_position"), spec_.positions.size());
        coordinates =
            axes_.add_positions(spec_.name + "_", "the position", {dimension}, spec_.positions);
        return {dimension, spec_.positions.size()};
    }

  private:
    const GapFractionSpec& spec_;
    NetcdfAxes& axes_;
    NetcdfFile& file_;
};

}  // namespace

NetcdfGaps::NetcdfGaps(const RunFile& run, NetcdfAxes& axes, NetcdfFile& file) : axes_(axes) {
    for (const GapFractionSpec& spec : run.gap_fractions) {
        GapAxes own(spec, axes, file);
        std::string coordinates;
        const NetcdfAxes::Axis positions = own.add_positions(coordinates);
        const NetcdfAxes::Axis rings =
            own.add_bins("ring", "angle from the zenith", spec.rings_deg);
        std::vector<double> azimuths;
        for (std::uint32_t i = 0; i <= spec.azimuths; ++i) {
            azimuths.push_back(360.0 * i / spec.azimuths);
        }
        const NetcdfAxes::Axis sectors =
            own.add_bins("sector", "azimuth, clockwise from north", azimuths);
        const NetcdfEstimates gap = axes.add_estimates(
            {spec.name, "1", "gap fraction", coordinates}, {positions, rings, sectors});
        variables_.push_back(
            {gap, define_indices(spec, "", coordinates, {positions}, rings),
             define_indices(spec, "_all", "", {}, rings)});
    }
}

/// @param positions  an axis, or none for all positions together
NetcdfGaps::Indices NetcdfGaps::define_indices(
    const GapFractionSpec& spec,
    const std::string& suffix,
    const std::string& coordinates,
    const std::vector<NetcdfAxes::Axis>& positions,
    const NetcdfAxes::Axis& rings) {
    const std::string end = suffix.empty() ? "" : ", all positions together";
    const auto add = [&](const std::string& name, const std::string& summary, bool has_rings) {
        std::vector<NetcdfAxes::Axis> axes = positions;
        if (has_rings) {
            axes.push_back(rings);
        }
        return axes_.add_estimates(
            {spec.name + "_" + name + suffix, "1", summary + end, coordinates}, axes);
    };
    return {
        .gap = add("of_ring", "gap fraction of a ring", true),
        .clumping = add("clumping_of_ring", "clumping index of a ring", true),
        .sky_transmittance = add("sky_transmittance", "transmitted part of a uniform sky", false),
        .effective_plant_area_index =
            add("effective_plant_area_index", "effective plant area index", false),
        .plant_area_index = add("plant_area_index", "plant area index", false),
        .clumping_index = add("clumping_index", "clumping index", false),
        .lai_2000 = add("lai_2000_index", "index of an LAI-2000, for its rings only", false)};
}

void NetcdfGaps::put_indices(
    const Indices& to,
    const std::vector<std::size_t>& start,
    const std::vector<GapIndices>& from,
    const std::vector<std::size_t>& sizes) {
    const std::size_t rings = from.front().gap.size();
    std::vector<std::size_t> with_rings = sizes;
    with_rings.push_back(rings);
    const auto put_rings = [&](const NetcdfEstimates& variables,
                               std::vector<Estimate> GapIndices::*member) {
        axes_.put(variables, start, with_rings, [&](std::size_t i) {
            return (from[i / rings].*member)[i % rings];
        });
    };
    const auto put_one = [&](const NetcdfEstimates& variables, Estimate GapIndices::*member) {
        axes_.put(variables, start, sizes, [&](std::size_t i) { return from[i].*member; });
    };
    put_rings(to.gap, &GapIndices::gap);
    put_rings(to.clumping, &GapIndices::clumping);
    put_one(to.sky_transmittance, &GapIndices::sky_transmittance);
    put_one(to.effective_plant_area_index, &GapIndices::effective_plant_area_index);
    put_one(to.plant_area_index, &GapIndices::plant_area_index);
    put_one(to.clumping_index, &GapIndices::clumping_index);
    axes_.put(to.lai_2000, start, sizes, [&](std::size_t i) {
        return from[i].lai_2000.value_or(kUnknownEstimate);
    });
}

void NetcdfGaps::put(const RunFile& run) {
    if (found_.empty() || axes_.sweep.changes_geometry()) {
        found_.clear();
        for (GapFractionSpec spec : run.gap_fractions) {
            spec.threads = run.spec.threads;
            found_.push_back(gap_fractions(run.scene, spec));
        }
    }
    const std::vector<std::size_t> start = axes_.indices_of(run);
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const GapFractions& found = found_[i];
        const std::size_t positions = found.by_position.size();
        axes_.put(
            variables_[i].gap, start, {positions, found.spec.rings(), found.spec.azimuths},
            [&](std::size_t number) { return found.gaps[number]; });
        put_indices(variables_[i].by_position, start, found.by_position, {positions});
        put_indices(variables_[i].all, start, {found.all}, {});
    }
}

}  // namespace quasimc
