#include "netcdf/netcdf_layout.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "resultio/describe_series.h"
#include "resultio/part_columns.h"
#include "results/evaluate.h"
#include "results/groups.h"
#include "results/units.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

const NetcdfAttributes kTimeAttributes{
    {"standard_name", "time"},
    {"units", "seconds since 1970-01-01 00:00:00 UTC"},
    {"calendar", "standard"}};

/// The name and the words of light of one origin.
constexpr const char* kByOrigin = "_by_origin";
constexpr const char* kOfOrigin = ", of an origin";

/// Chunks of about ten thousand numbers: a few times of a small scene, or a part of a large one.
std::vector<std::size_t> chunk_of(const std::vector<std::size_t>& sizes) {
    constexpr std::size_t kNumbers = 1 << 15;
    std::vector<std::size_t> chunk(sizes.size(), 1);
    std::size_t left = kNumbers;
    for (std::size_t i = sizes.size(); i-- > 0;) {
        chunk[i] = std::clamp<std::size_t>(sizes[i], 1, std::max<std::size_t>(left, 1));
        left /= chunk[i];
    }
    return chunk;
}

}  // namespace

NetcdfLayout::NetcdfLayout(const RunFile& run, std::string_view program_version, NetcdfFile& file)
    : columns(written_columns(run)),
      bands(netcdf_bands(run, columns)),
      run_(run),
      file_(file),
      sweep_(run),
      rows_(netcdf_rows(run, sweep_.changes_daylight())) {
    file_.add_attributes(netcdf_attributes(run, program_version));
    define_axes();
    define_points();
    define_times();
    define_days();
    define_organs();
    define_light();
    define_detectors();
}

std::optional<std::size_t> NetcdfLayout::row_of(std::size_t time_step) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), time_step);
    return found == rows_.end() || *found != time_step
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - rows_.begin()));
}

std::string NetcdfLayout::free_name(std::string_view wish) {
    std::string name(wish);
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c < 0x80; },
        '_');
    std::string free = name;
    for (int number = 2; !names_.insert(free).second; ++number) {
        free = fmt::format("{}_{}", name, number);
    }
    return free;
}

void NetcdfLayout::define_axes() {
    names_ = {"time", "time_bounds", "time_text", "day",   "organ", "organ_name",
              "area", "band",        "bounds",    "ratio", "origin"};
    for (const NetcdfSweep::Axis& axis : sweep_.axes()) {
        axis_names_.push_back(free_name(axis.name));
        points_.push_back(file_.add_dimension(axis_names_.back(), axis.size));
    }
    if (run_.series) {
        time_ = file_.add_dimension("time", std::max<std::size_t>(rows_.size(), 1));
        day_ = file_.add_dimension("day", std::max<std::size_t>(run_.series->days.size(), 1));
    }
    if (bands.size() == 1 && bands.front().suffix.empty()) {
        std::vector<std::string> names;
        for (const std::size_t b : columns.bands) {
            names.push_back(run_.scene.bands()[b].name);
        }
        band_ = file_.add_dimension("band", names.size());
        file_.put(
            file_.add_variable("band", NetcdfType::text, {*band_}, {{"long_name", "waveband"}}),
            names);
    }
    if (!columns.origins.empty()) {
        origin_ = file_.add_dimension("origin", columns.origins.size());
        file_.put(
            file_.add_variable(
                "origin", NetcdfType::text, {*origin_}, {{"long_name", "origin of the light"}}),
            columns.origins);
    }
    if (!run_.spec.ratios.empty()) {
        ratio_ = file_.add_dimension("ratio", run_.spec.ratios.size());
        file_.put(
            file_.add_variable(
                "ratio", NetcdfType::text, {*ratio_}, {{"long_name", "the bands of a ratio"}}),
            run_.spec.ratios);
    }
}

void NetcdfLayout::define_points() {
    for (const NetcdfSweep::Key& key : sweep_.keys()) {
        std::vector<double> numbers;
        for (const std::string& text : key.values) {
            if (const auto number = parse_real(text)) {
                numbers.push_back(*number);
            }
        }
        const bool is_number = numbers.size() == key.values.size();
        // A key with its own axis is a coordinate variable, with the name of the dimension.
        const bool is_axis = sweep_.axes()[key.axis].name == key.name;
        const std::string name = is_axis ? axis_names_[key.axis] : free_name(key.name);
        if (!is_axis) {
            coordinates_ += (coordinates_.empty() ? "" : " ") + name;
            organ_coordinates_ += " " + name;
        }
        const int variable = file_.add_variable(
            name, is_number ? NetcdfType::real : NetcdfType::text, {points_[key.axis]},
            {{"long_name", "value of " + key.name}});
        is_number ? file_.put(variable, numbers) : file_.put(variable, key.values);
    }
}

void NetcdfLayout::define_times() {
    if (!time_ || rows_.empty()) {
        return;
    }
    const int ends = file_.add_dimension("bounds", 2);
    std::vector<double> begin, bounds;
    std::vector<std::string> texts;
    for (const std::size_t row : rows_) {
        const TimeStepNotes& notes = run_.series->notes[row];
        begin.push_back(netcdf_seconds(notes.time));
        bounds.push_back(begin.back());
        bounds.push_back(
            notes.cumulated ? netcdf_seconds(notes.cumulated->until)
                            : begin.back() + notes.seconds);
        texts.push_back(notes.time);
    }
    NetcdfAttributes attributes = kTimeAttributes;
    attributes.emplace_back("long_name", "beginning of the averaging interval");
    attributes.emplace_back("bounds", "time_bounds");
    file_.put(file_.add_variable("time", NetcdfType::real, {*time_}, attributes), begin);
    file_.put(
        file_.add_variable("time_bounds", NetcdfType::real, {*time_, ends}, kTimeAttributes),
        bounds);
    file_.put(
        file_.add_variable(
            "time_text", NetcdfType::text, {*time_},
            {{"long_name", "local time with its offset from UTC"}}),
        texts);
}

void NetcdfLayout::define_days() {
    if (!day_ || run_.series->days.empty()) {
        return;
    }
    file_.put(
        file_.add_variable(
            "day", NetcdfType::text, {*day_},
            {{"long_name", "day, or first and last day of a period"}}),
        run_.series->days);
}

void NetcdfLayout::define_organs() {
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
    file_.put(
        file_.add_variable(
            "organ_name", NetcdfType::text, {organ_}, {{"long_name", "name of the organ"}}),
        names);
    define_areas();
    define_labels();
}

void NetcdfLayout::define_areas() {
    std::vector<int> dimensions;
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; sweep_.changes_geometry() && i < points_.size(); ++i) {
        dimensions.push_back(points_[i]);
        sizes.push_back(sweep_.axes()[i].size);
    }
    dimensions.push_back(organ_);
    sizes.push_back(run_.scene.organs().size());
    area_ = file_.add_variable(
        "area", NetcdfType::real, dimensions,
        {{"long_name", "one-sided area"}, {"units", run_.scene.length_unit() + "2"}},
        chunk_of(sizes));
    put_areas(run_);
}

void NetcdfLayout::put_areas(const RunFile& run) {
    if (run.point > 0 && !sweep_.changes_geometry()) {
        return;
    }
    std::vector<double> areas;
    for (const Organ& organ : run.scene.organs()) {
        areas.push_back(organ.area);
    }
    NetcdfBlock block;
    if (sweep_.changes_geometry()) {
        block.start = indices_of(run);
        block.count.assign(block.start.size(), 1);
    }
    block.start.push_back(0);
    block.count.push_back(areas.size());
    file_.put(area_, block, areas);
}

void NetcdfLayout::define_labels() {
    const std::vector<Organ>& organs = run_.scene.organs();
    for (const std::string_view key : label_keys(run_.scene)) {
        const std::string name = free_name("label_" + std::string(key));
        organ_coordinates_ += " " + name;
        std::vector<std::string> values(organs.size());
        for (std::size_t i = 0; i < organs.size(); ++i) {
            for (const auto& label : organs[i].labels) {
                values[i] = label.first == key ? label.second : values[i];
            }
        }
        file_.put(
            file_.add_variable(
                name, NetcdfType::text, {organ_}, {{"long_name", "label " + std::string(key)}}),
            values);
    }
}

NetcdfEstimates NetcdfLayout::define_estimates(
    const std::string& name,
    const std::string& unit,
    const std::string& summary,
    const std::vector<Axis>& axes,
    const std::string& coordinates) {
    std::vector<int> dimensions = points_;
    std::vector<std::size_t> sizes;
    for (const NetcdfSweep::Axis& axis : sweep_.axes()) {
        sizes.push_back(axis.size);
    }
    for (const auto& [dimension, size] : axes) {
        if (dimension) {
            dimensions.push_back(*dimension);
            sizes.push_back(size);
        }
    }
    const std::string mean = free_name(name), error = free_name(name + "_standard_error"),
                      low = free_name(name + "_ci95_low"), high = free_name(name + "_ci95_high");
    const auto add = [&](const std::string& variable, const std::string& words,
                         const std::string& ancillary) {
        NetcdfAttributes attributes{{"long_name", words}, {"units", unit}};
        if (!coordinates.empty()) {
            attributes.emplace_back("coordinates", coordinates);
        }
        if (!ancillary.empty()) {
            attributes.emplace_back("ancillary_variables", ancillary);
        }
        return file_.add_variable(
            variable, NetcdfType::real, dimensions, attributes, chunk_of(sizes));
    };
    NetcdfEstimates estimates;
    estimates.variables = {
        add(mean, summary, fmt::format("{} {} {}", error, low, high)),
        add(error, "standard error of " + mean, ""),
        add(low, "lower end of the 95 % confidence interval of " + mean, ""),
        add(high, "upper end of the 95 % confidence interval of " + mean, "")};
    return estimates;
}

void NetcdfLayout::define_light() {
    const Axis time = time_axis(), band = band_axis(), day = day_axis(), organ = organ_axis();
    const Axis ratio{ratio_, run_.spec.ratios.size()};
    const Axis origin{origin_, columns.origins.size()};
    const auto define = [&](const std::string& name, const std::string& unit,
                            const std::string& summary, const std::vector<Axis>& axes) {
        return define_estimates(name, unit, summary, axes, organ_coordinates_);
    };
    for (const NetcdfBands& list : bands) {
        const Band& first = run_.scene.bands()[list.bands.front()];
        for (const QuantityEntry& entry : columns.quantities) {
            const std::string unit = unit_of(entry, first, run_.scene.length_unit());
            const std::string name = std::string(entry.name) + list.suffix;
            const std::string summary(entry.summary);
            light.push_back(define(name, unit, summary, {time, band, organ}));
            if (origin_) {
                light_by_origin.push_back(define(
                    name + kByOrigin, unit, summary + kOfOrigin, {time, origin, band, organ}));
            }
            if (!run_.series) {
                continue;
            }
            const std::string summed = summed_unit(unit).name;
            days.push_back(
                define(name + "_day_sum", summed, summary + ", summed", {day, band, organ}));
            if (origin_) {
                days_by_origin.push_back(define(
                    name + "_day_sum" + kByOrigin, summed, summary + kOfOrigin + ", summed",
                    {day, origin, band, organ}));
            }
        }
    }
    if (columns.has_sunlit) {
        sunlit = define(
            "sunlit_fraction", "1", "fraction of the area lit directly by directional sources",
            {time, organ});
    }
    if (columns.has_sunlit_hours && run_.series) {
        sunlit_hours =
            define("sunlit_hours", "h", "sunlit fraction of the area x time", {day, organ});
    }
    define_parts();
    if (ratio_) {
        ratios = define(
            "light_ratio", "1", "ratio of incident light, both sides of the organ",
            {time, ratio, organ});
    }
}

void NetcdfLayout::define_parts() {
    for (const NetcdfBands& list : bands) {
        for (const SunShadeEntry& entry : columns.parts) {
            if (entry.has_bands()) {
                define_part({entry, list.bands, list.suffix.empty()}, list.suffix);
            }
        }
    }
    for (const SunShadeEntry& entry : columns.parts) {
        if (!entry.has_bands()) {
            define_part({entry, {0}}, "");
        }
    }
}

void NetcdfLayout::define_part(NetcdfPart part, const std::string& suffix) {
    const auto axes = [&](const Axis& first) {
        return part.has_axis ? std::vector{first, band_axis(), organ_axis()}
                             : std::vector{first, organ_axis()};
    };
    const PartColumn column{part.entry, part.bands.front()};
    const std::string summary(part.entry.summary);
    part.light = define_estimates(
        std::string(part.entry.name) + suffix, unit_of(run_, column, CsvTimes::time_steps), summary,
        axes(time_axis()), organ_coordinates_);
    if (run_.series) {
        const char* kind = !part.entry.has_bands()                   ? ""
                           : part.entry.part == SunShadePart::direct ? "_day_sum"
                                                                     : "_day_mean";
        part.days = define_estimates(
            std::string(part.entry.of_sums) + suffix + kind, unit_of(run_, column, CsvTimes::days),
            summary_of(column, CsvTimes::days), axes(day_axis()), organ_coordinates_);
    }
    parts.push_back(std::move(part));
}

void NetcdfLayout::define_detectors() {
    for (const DetectorResult& detector : zero_detectors(run_.scene)) {
        const std::string axis = free_name(detector.name + "_bin");
        const int bin = file_.add_dimension(axis, detector.bins.size());
        file_.put(
            file_.add_variable(axis, NetcdfType::text, {bin}, {{"long_name", detector.quantity}}),
            detector.bins);
        std::vector<NetcdfEstimates>& of_lists = detectors.emplace_back();
        for (const NetcdfBands& list : bands) {
            const Band& first = run_.scene.bands()[list.bands.front()];
            of_lists.push_back(define_estimates(
                detector.name + list.suffix, flux_unit(first.unit, run_.scene.length_unit()),
                fmt::format("flux by {} in a detector {}", detector.quantity, detector.type),
                {time_axis(), band_axis(), {bin, detector.bins.size()}}, coordinates_));
        }
    }
}

}  // namespace quasimc
