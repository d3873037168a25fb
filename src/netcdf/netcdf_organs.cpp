#include "netcdf/netcdf_organs.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "resultio/part_columns.h"
#include "results/groups.h"

namespace quasimc {
namespace {

/// Areas in a chunk.
constexpr std::size_t kMaxChunk = 1 << 15;

}  // namespace

NetcdfOrgans::NetcdfOrgans(const RunFile& run, NetcdfAxes& axes, NetcdfFile& file)
    : run_(run), axes_(axes), file_(file), count_(run.scene.organs().size()) {
    define_organs();
    light_.emplace(
        run, axes,
        NetcdfRows{"", {organ_axis()}, coordinates_, 0, count_, axes.columns.quantities});
    define_parts();
}

void NetcdfOrgans::define_organs() {
    const std::vector<Organ>& organs = run_.scene.organs();
    organ_ = file_.add_dimension("organ", organs.size());
    std::vector<std::int64_t> ids;
    std::vector<std::string> names;
    for (const Organ& organ : organs) {
        ids.push_back(organ.id);
        names.push_back(organ.name);
    }
    file_.put(
        file_.add_variable(
            "organ", NetcdfType::integer, {organ_}, {{"long_name", "id of the organ"}}),
        std::span<const std::int64_t>(ids));
    axes_.add_texts("organ_name", "name of the organ", {organ_}, names);
    define_areas();
    define_labels();
}

void NetcdfOrgans::define_areas() {
    std::vector<int> dimensions;
    std::vector<std::size_t> chunk;
    const bool is_swept = axes_.sweep.changes_geometry();
    for (const auto& [dimension, size] : is_swept ? axes_.points() : std::vector<Axis>()) {
        dimensions.push_back(*dimension);
        chunk.push_back(1);
    }
    dimensions.push_back(organ_);
    chunk.push_back(std::clamp<std::size_t>(run_.scene.organs().size(), 1, kMaxChunk));
    area_ = file_.add_variable(
        "area", NetcdfType::real, dimensions,
        {{"long_name", "one-sided area"}, {"units", run_.scene.length_unit() + "2"}}, chunk);
    put_areas(run_);
}

void NetcdfOrgans::put_areas(const RunFile& run) {
    const bool is_swept = axes_.sweep.changes_geometry();
    if (run.point > 0 && !is_swept) {
        return;
    }
    std::vector<double> areas;
    for (const Organ& organ : run.scene.organs()) {
        areas.push_back(organ.area);
    }
    axes_.put(
        area_, is_swept ? axes_.indices_of(run) : std::vector<std::size_t>(), {areas.size()},
        areas);
}

void NetcdfOrgans::define_labels() {
    const std::vector<Organ>& organs = run_.scene.organs();
    for (const std::string_view key : label_keys(run_.scene)) {
        const std::string name = axes_.free_name("label_" + std::string(key));
        coordinates_ += " " + name;
        std::vector<std::string> values(organs.size());
        for (std::size_t i = 0; i < organs.size(); ++i) {
            for (const auto& label : organs[i].labels) {
                values[i] = label.first == key ? label.second : values[i];
            }
        }
        axes_.add_texts(name, "label " + std::string(key), {organ_}, values);
    }
}

void NetcdfOrgans::define_parts() {
    for (const NetcdfBands& list : axes_.bands) {
        for (const SunShadeEntry& entry : axes_.columns.parts) {
            if (entry.has_bands()) {
                define_part({entry, list.bands, list.suffix.empty()}, list.suffix);
            }
        }
    }
    for (const SunShadeEntry& entry : axes_.columns.parts) {
        if (!entry.has_bands()) {
            define_part({entry, {0}}, "");
        }
    }
}

void NetcdfOrgans::define_part(NetcdfPart part, const std::string& suffix) {
    const auto define = [&](const std::string& name, CsvTimes times) {
        const PartColumn column{part.entry, part.bands.front()};
        const bool is_daily = times == CsvTimes::days;
        const Axis& time = is_daily ? axes_.day() : axes_.time();
        const std::vector<Axis> axes = part.has_axis
                                           ? std::vector<Axis>{time, axes_.band(), organ_axis()}
                                           : std::vector<Axis>{time, organ_axis()};
        const std::string summary =
            is_daily ? summary_of(column, times) : std::string(part.entry.summary);
        return axes_.add_estimates(
            {name, unit_of(run_, column, times), summary, coordinates_}, axes);
    };
    part.light = define(std::string(part.entry.name) + suffix, CsvTimes::time_steps);
    if (run_.series) {
        const char* kind = !part.entry.has_bands()                   ? ""
                           : part.entry.part == SunShadePart::direct ? "_day_sum"
                                                                     : "_day_mean";
        part.days = define(std::string(part.entry.of_sums) + suffix + kind, CsvTimes::days);
    }
    parts_.push_back(std::move(part));
}

void NetcdfOrgans::put_part(
    const NetcdfPart& part,
    const NetcdfEstimates& to,
    const std::vector<std::size_t>& start,
    const SunShadeLight& parts) {
    if (parts.empty()) {
        return;
    }
    axes_.put(to, start, light_->sizes(part.has_axis ? part.bands.size() : 0), [&](std::size_t i) {
        return parts.at(i % count_, part.entry.quantity, part.bands[i / count_]);
    });
}

void NetcdfOrgans::put(const std::vector<std::size_t>& start, const Result& result) {
    light_->put(start, result);
    for (const NetcdfPart& part : parts_) {
        put_part(part, part.light, start, result.sun_shade);
    }
}

void NetcdfOrgans::put_day(const std::vector<std::size_t>& start, const SeriesSum& sum) {
    light_->put_day(start, sum);
    for (const NetcdfPart& part : parts_) {
        put_part(part, *part.days, start, sum.sun_shade);
    }
}

}  // namespace quasimc
