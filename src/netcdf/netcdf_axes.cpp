#include "netcdf/netcdf_axes.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "text/numbers.h"

namespace quasimc {
namespace {

const NetcdfAttributes kTimeAttributes{
    {"standard_name", "time"},
    {"units", "seconds since 1970-01-01 00:00:00 UTC"},
    {"calendar", "standard"}};

}  // namespace

NetcdfAxes::NetcdfAxes(const RunFile& run, NetcdfFile& file)
    : columns(written_columns(run)),
      bands(netcdf_bands(run, columns)),
      sweep(run),
      run_(run),
      file_(file),
      names_{"time", "time_bounds", "time_text", "day", "organ", "organ_name", "area", "bounds"},
      rows_(netcdf_rows(run, sweep.changes_daylight())) {
    define_bands();
    if (!columns.origins.empty()) {
        origin_ = add_names("origin", "origin of the light", columns.origins);
    }
    if (!run_.spec.ratios.empty()) {
        ratio_ = add_names("ratio", "the bands of a ratio", run_.spec.ratios);
    }
    define_points();
    define_times();
}

std::optional<std::size_t> NetcdfAxes::row_of(std::size_t time_step) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), time_step);
    return found == rows_.end() || *found != time_step
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - rows_.begin()));
}

std::vector<NetcdfAxes::Axis> NetcdfAxes::points() const {
    return points_;
}

int NetcdfAxes::bounds() {
    if (!bounds_) {
        bounds_ = file_.add_dimension("bounds", 2);
    }
    return *bounds_;
}

std::string NetcdfAxes::valid_name(std::string_view wish) {
    std::string name(wish);
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c < 0x80; },
        '_');
    return name;
}

std::string NetcdfAxes::free_name(std::string_view wish) {
    const std::string name = valid_name(wish);
    std::string free = name;
    for (int number = 2; !names_.insert(free).second; ++number) {
        free = fmt::format("{}_{}", name, number);
    }
    return free;
}

std::string NetcdfAxes::add_positions(
    const std::string& prefix,
    const std::string& what,
    const std::vector<int>& dimensions,
    const std::vector<Vec3>& positions) {
    constexpr std::array kParts{&Vec3::x, &Vec3::y, &Vec3::z};
    std::string names;
    for (std::size_t axis = 0; axis < kParts.size(); ++axis) {
        std::vector<double> values;
        values.reserve(positions.size());
        for (const Vec3& position : positions) {
            values.push_back(position.*kParts[axis]);
        }
        const std::string letter(1, "xyz"[axis]);
        const std::string name = free_name(prefix + letter);
        names += (names.empty() ? "" : " ") + name;
        file_.put(
            file_.add_variable(
                name, NetcdfType::real, dimensions,
                {{"long_name", fmt::format("{} of {}, in the axes of the run file", letter, what)},
                 {"units", run_.scene.length_unit()}}),
            values);
    }
    return names;
}

void NetcdfAxes::add_texts(
    const std::string& name,
    const std::string& summary,
    const std::vector<int>& dimensions,
    const std::vector<std::string>& values) {
    file_.put(
        file_.add_variable(name, NetcdfType::text, dimensions, {{"long_name", summary}}), values);
}

NetcdfAxes::Axis NetcdfAxes::add_names(
    const std::string& wish, const std::string& summary, const std::vector<std::string>& all) {
    const std::string name = free_name(wish);
    const int dimension = file_.add_dimension(name, all.size());
    add_texts(name, summary, {dimension}, all);
    return {dimension, all.size()};
}

void NetcdfAxes::define_bands() {
    if (bands.size() != 1 || !bands.front().suffix.empty()) {
        return;
    }
    std::vector<std::string> names;
    for (const std::size_t b : columns.bands) {
        names.push_back(run_.scene.bands()[b].name);
    }
    band_ = add_names("band", "waveband", names);
}

void NetcdfAxes::define_points() {
    for (const NetcdfSweep::Axis& axis : sweep.axes()) {
        axis_names_.push_back(free_name(axis.name));
        points_.emplace_back(file_.add_dimension(axis_names_.back(), axis.size), axis.size);
    }
    for (const NetcdfSweep::Key& key : sweep.keys()) {
        std::vector<double> numbers;
        for (const std::string& text : key.values) {
            if (const auto number = parse_real(text)) {
                numbers.push_back(*number);
            }
        }
        const bool is_number = numbers.size() == key.values.size();
        // A key with its own axis is a coordinate variable, with the name of the dimension.
        const bool is_axis = sweep.axes()[key.axis].name == key.name;
        const std::string name = is_axis ? axis_names_[key.axis] : free_name(key.name);
        if (!is_axis) {
            coordinates_ += (coordinates_.empty() ? "" : " ") + name;
        }
        const int variable = file_.add_variable(
            name, is_number ? NetcdfType::real : NetcdfType::text, {*points_[key.axis].first},
            {{"long_name", "value of " + key.name}});
        is_number ? file_.put(variable, numbers) : file_.put(variable, key.values);
    }
}

void NetcdfAxes::define_times() {
    if (!run_.series) {
        return;
    }
    const std::vector<std::string>& days = run_.series->days;
    time_.second = std::max<std::size_t>(rows_.size(), 1);
    time_.first = file_.add_dimension("time", time_.second);
    day_.second = std::max<std::size_t>(days.size(), 1);
    day_.first = file_.add_dimension("day", day_.second);
    if (!days.empty()) {
        add_texts("day", "day, or first and last day of a period", {*day_.first}, days);
    }
    if (rows_.empty()) {
        return;
    }
    std::vector<double> begin, ends;
    std::vector<std::string> texts;
    for (const std::size_t row : rows_) {
        const TimeStepNotes& notes = run_.series->notes[row];
        begin.push_back(netcdf_seconds(notes.time));
        ends.push_back(begin.back());
        ends.push_back(
            notes.cumulated ? netcdf_seconds(notes.cumulated->until)
                            : begin.back() + notes.seconds);
        texts.push_back(notes.time);
    }
    NetcdfAttributes attributes = kTimeAttributes;
    attributes.emplace_back("long_name", "beginning of the averaging interval");
    attributes.emplace_back("bounds", "time_bounds");
    file_.put(file_.add_variable("time", NetcdfType::real, {*time_.first}, attributes), begin);
    file_.put(
        file_.add_variable(
            "time_bounds", NetcdfType::real, {*time_.first, bounds()}, kTimeAttributes),
        ends);
    add_texts("time_text", "local time with its offset from UTC", {*time_.first}, texts);
}

std::vector<int> NetcdfAxes::dimensions_of(const std::vector<Axis>& axes) const {
    std::vector<int> dimensions;
    for (const std::vector<Axis>& list : {points_, axes}) {
        for (const auto& [dimension, size] : list) {
            if (dimension) {
                dimensions.push_back(*dimension);
            }
        }
    }
    return dimensions;
}

/// Chunks of about ten thousand numbers: a few times of a small scene, or a part of a large one.
std::vector<std::size_t> NetcdfAxes::chunk_of(const std::vector<Axis>& axes) const {
    constexpr std::size_t kNumbers = 1 << 15;
    std::vector<std::size_t> chunk;
    for (const std::vector<Axis>& list : {points_, axes}) {
        for (const auto& [dimension, size] : list) {
            if (dimension) {
                chunk.push_back(size);
            }
        }
    }
    std::size_t left = kNumbers;
    for (std::size_t i = chunk.size(); i-- > 0;) {
        chunk[i] = std::clamp<std::size_t>(chunk[i], 1, std::max<std::size_t>(left, 1));
        left /= chunk[i];
    }
    return chunk;
}

int NetcdfAxes::add_variable(
    const std::string& name,
    const NetcdfQuantity& quantity,
    const std::vector<Axis>& axes,
    const std::string& ancillary) {
    NetcdfAttributes attributes{{"long_name", quantity.summary}, {"units", quantity.unit}};
    const bool has_both = !quantity.coordinates.empty() && !coordinates_.empty();
    const std::string coordinates = quantity.coordinates + (has_both ? " " : "") + coordinates_;
    if (!coordinates.empty()) {
        attributes.emplace_back("coordinates", coordinates);
    }
    if (!ancillary.empty()) {
        attributes.emplace_back("ancillary_variables", ancillary);
    }
    return file_.add_variable(
        name, NetcdfType::real, dimensions_of(axes), attributes, chunk_of(axes));
}

int NetcdfAxes::add_reals(const NetcdfQuantity& quantity, const std::vector<Axis>& axes) {
    return add_variable(free_name(quantity.name), quantity, axes, "");
}

NetcdfEstimates NetcdfAxes::add_estimates(
    const NetcdfQuantity& quantity, const std::vector<Axis>& axes) {
    const std::string mean = free_name(quantity.name),
                      error = free_name(quantity.name + "_standard_error"),
                      low = free_name(quantity.name + "_ci95_low"),
                      high = free_name(quantity.name + "_ci95_high");
    const auto add = [&](const std::string& variable, const std::string& summary) {
        NetcdfQuantity part = quantity;
        part.summary = summary + mean;
        return add_variable(variable, part, axes, "");
    };
    return {
        {add_variable(mean, quantity, axes, fmt::format("{} {} {}", error, low, high)),
         add(error, "standard error of "),
         add(low, "lower end of the 95 % confidence interval of "),
         add(high, "upper end of the 95 % confidence interval of ")}};
}

NetcdfBlock NetcdfAxes::block_of(
    const std::vector<std::size_t>& start, const std::vector<std::size_t>& sizes) {
    NetcdfBlock block{start, std::vector<std::size_t>(start.size(), 1)};
    block.start.resize(start.size() + sizes.size(), 0);
    block.count.insert(block.count.end(), sizes.begin(), sizes.end());
    return block;
}

std::size_t NetcdfAxes::size_of(const std::vector<std::size_t>& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace quasimc
