#include "netcdf/netcdf_sensors.h"

#include <set>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "results/sensor_transmittance.h"
#include "runfile/table_rows.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// Defines the axes and coordinates of a set.
class SensorAxes {
  public:
    SensorAxes(const RunFile& run, NetcdfAxes& axes, NetcdfFile& file)
        : run_(run), axes_(axes), file_(file), positions_(sensor_positions(run.scene)) {}

    NetcdfRows add(const SensorSet& set, std::size_t first) {
        NetcdfRows rows{
            .prefix = prefix_of(set.name),
            .first = first,
            .count = set.rows(),
            .quantities = sensor_quantities(axes_.columns.quantities, set.receiver)};
        const std::vector<std::size_t> shape = sensor_shape(set);
        const std::vector<std::string> ends = shape.size() == 2 ? std::vector<std::string>{"j", "i"}
                                                                : std::vector<std::string>{"point"};
        std::vector<int> dimensions;
        for (std::size_t i = 0; i < shape.size(); ++i) {
            const std::string name = axes_.free_name(rows.prefix + ends[i]);
            dimensions.push_back(file_.add_dimension(name, shape[i]));
            rows.axes.emplace_back(dimensions.back(), shape[i]);
        }
        add_names(set, dimensions, rows);
        add_positions(dimensions, rows);
        return rows;
    }

  private:
    /// The valid name of a set, with a number if others have it.
    std::string prefix_of(const std::string& name) {
        const std::string valid = NetcdfAxes::valid_name(name);
        std::string free = valid + "_";
        for (int number = 2; !prefixes_.insert(free).second; ++number) {
            free = fmt::format("{}_{}_", valid, number);
        }
        return free;
    }

    void add_names(const SensorSet& set, const std::vector<int>& dimensions, NetcdfRows& rows) {
        std::vector<std::string> names;
        for (std::size_t i = 0; i < set.rows(); ++i) {
            names.push_back(set.is_averaged ? set.name : set.points[i].name);
        }
        rows.coordinates = axes_.free_name(rows.prefix + "name");
        axes_.add_texts(rows.coordinates, "name of the sensor", dimensions, names);
    }

    void add_positions(const std::vector<int>& dimensions, NetcdfRows& rows) {
        std::vector<Vec3> positions;
        for (std::size_t i = 0; i < rows.count; ++i) {
            positions.push_back(run_.scene.orientation().outward(positions_[rows.first + i]));
        }
        rows.coordinates +=
            " " + axes_.add_positions(rows.prefix, "the sensor", dimensions, positions);
    }

    const RunFile& run_;
    NetcdfAxes& axes_;
    NetcdfFile& file_;
    const std::vector<Vec3> positions_;
    std::set<std::string> prefixes_;
};

}  // namespace

void NetcdfSensors::define(const RunFile& run) {
    if (!sets_.empty()) {
        return;
    }
    SensorAxes own(run, axes_, file_);
    std::size_t first = 0;
    for (const SensorSet& set : run.scene.sensors()) {
        sets_.push_back({LightVariables(run, axes_, own.add(set, first))});
        first += set.rows();
    }
}

void NetcdfSensors::put(
    const RunFile& run, const std::vector<std::size_t>& start, const Result& result) {
    if (!result.sensors) {
        return;
    }
    define(run);
    for (Set& set : sets_) {
        set.light.put(start, *result.sensors);
    }
    put_transmittance(run, start, result);
}

void NetcdfSensors::put_day(
    const RunFile& run, const std::vector<std::size_t>& start, const SeriesSum& sum) {
    if (!sum.sensors) {
        return;
    }
    define(run);
    for (Set& set : sets_) {
        set.light.put_day(start, *sum.sensors);
    }
    put_transmittance(run, start, sum);
}

/// @param light  a Result or a SeriesSum, with sensors
template <typename Light>
void NetcdfSensors::put_transmittance(
    const RunFile& run, const std::vector<std::size_t>& start, const Light& light) {
    constexpr bool kIsDay = std::is_same_v<Light, SeriesSum>;
    const SensorTransmittance fraction(run.scene);
    for (Set& set : sets_) {
        if (!fraction.has(set.light.first_row())) {
            continue;
        }
        std::vector<NetcdfEstimates>& variables = kIsDay ? set.of_days : set.transmittance;
        if (variables.empty()) {
            variables = set.light.add_fractions(
                std::string(kTransmittance), "light from above / light on the horizontal",
                kIsDay ? CsvTimes::days : CsvTimes::time_steps);
        }
        set.light.put_fractions(variables, start, [&](std::size_t row, std::size_t band) {
            return fraction.at(light, row, band);
        });
    }
}

}  // namespace quasimc
