#include "show_view.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"
#include "text/numbers.h"

namespace {

using quasimc::Faults;

/// Two numbers with a mark between them: "200,20".
std::optional<std::pair<double, double>> two_numbers(std::string_view text, char mark) {
    const std::size_t at = text.find(mark);
    if (at == std::string_view::npos) {
        return std::nullopt;
    }
    const auto first = quasimc::parse_real(quasimc::trimmed(text.substr(0, at)));
    const auto second = quasimc::parse_real(quasimc::trimmed(text.substr(at + 1)));
    return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

constexpr std::string_view kFisheye = "fisheye:";

/// A point "x,y,z" in the axes of the file, as a point with z up.
std::optional<quasimc::Vec3> point_of(
    std::string_view text, const quasimc::Orientation& axes, Faults& faults) {
    std::array<double, 3> numbers{};
    std::size_t count = 0;
    for (std::string_view rest = text; count < numbers.size(); ++count) {
        const std::size_t comma = count + 1 < numbers.size() ? rest.find(',') : rest.size();
        const auto number = quasimc::parse_real(quasimc::trimmed(rest.substr(0, comma)));
        if (comma == std::string_view::npos || !number || !std::isfinite(*number)) {
            break;
        }
        numbers[count] = *number;
        rest = comma < rest.size() ? rest.substr(comma + 1) : std::string_view();
    }
    if (count < numbers.size()) {
        faults.add(
            {"--camera", fmt::format("'{}' is not a point", text), "",
             "give the position of the fisheye lens, in the axes of the file: fisheye:0,0,1.3"});
        return std::nullopt;
    }
    return axes.inward({numbers[0], numbers[1], numbers[2]});
}

quasimc::ViewSpec view_of(
    const ViewArguments& arguments, const quasimc::Orientation& axes, Faults& faults) {
    quasimc::ViewSpec view;
    view.fov_deg = arguments.opening;
    if (const quasimc::NamedView* named = quasimc::find_view(arguments.view)) {
        view.azimuth_deg = named->azimuth_deg;
        view.elevation_deg = named->elevation_deg;
        return view;
    }
    if (arguments.view.starts_with(kFisheye)) {
        view.fisheye = point_of(arguments.view.substr(kFisheye.size()), axes, faults);
        return view;
    }
    const auto angles = two_numbers(arguments.view, ',');
    if (!angles || !std::isfinite(angles->first) || !(std::abs(angles->second) <= 90)) {
        std::string names;
        for (const quasimc::NamedView& entry : quasimc::view_table()) {
            names += fmt::format("{}, ", entry.name);
        }
        faults.add(
            {"--camera", fmt::format("'{}' is not a view", arguments.view), "",
             fmt::format(
                 "give {}azimuth and elevation of the eye in degrees: 200,20, or fisheye:x,y,z",
                 names)});
        return view;
    }
    view.azimuth_deg = angles->first;
    view.elevation_deg = angles->second;
    return view;
}

/// "x<0.5": the shown half-space, in the axes of the file.
std::optional<quasimc::CutPlane> cut_of(std::string_view text, const quasimc::Orientation& axes) {
    const std::size_t at = text.find_first_of("<>");
    if (at == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view axis = quasimc::trimmed(text.substr(0, at));
    const auto offset = quasimc::parse_real(quasimc::trimmed(text.substr(at + 1)));
    const bool is_axis = axis == "x" || axis == "y" || axis == "z";
    if (!is_axis || !offset || !std::isfinite(*offset)) {
        return std::nullopt;
    }
    const quasimc::Vec3 along{
        axis == "x" ? 1.0 : 0.0, axis == "y" ? 1.0 : 0.0, axis == "z" ? 1.0 : 0.0};
    const double sign = text[at] == '<' ? 1 : -1;
    return quasimc::CutPlane{sign * axes.inward(along), sign * *offset};
}

void set_cuts(
    const ViewArguments& arguments,
    const quasimc::Orientation& axes,
    quasimc::ScenePicture& picture,
    Faults& faults) {
    std::string_view rest = arguments.cuts;
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view text = rest.substr(0, comma);
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
        if (const auto cut = cut_of(text, axes)) {
            picture.render.cuts.push_back(*cut);
        } else {
            faults.add(
                {"--clip", fmt::format("'{}' is not a half of space", text), "",
                 "write the part to show, in the axes of the file: --clip 'x<0.5'"});
        }
    }
}

void set_size(const ViewArguments& arguments, quasimc::ScenePicture& picture, Faults& faults) {
    const auto size = two_numbers(arguments.size, 'x');
    const auto fits = [](double side) {
        constexpr double kMin = 16, kMax = 16384;
        return side >= kMin && side <= kMax && side == std::floor(side);
    };
    if (!size || !fits(size->first) || !fits(size->second)) {
        faults.add(
            {"--size", fmt::format("'{}' is not a size", arguments.size), "",
             "give width and height in pixels, 16 to 16384: 1200x900"});
        return;
    }
    picture.width = static_cast<std::size_t>(size->first);
    picture.height = static_cast<std::size_t>(size->second);
}

}  // namespace

std::pair<double, double> range_of(const ViewArguments& arguments, Faults& faults) {
    const auto range = two_numbers(arguments.range, ',');
    if (!arguments.range.empty() && (!range || !(range->first < range->second))) {
        faults.add(
            {"--range", fmt::format("'{}' is not a range", arguments.range), "",
             "give the values of the first and the last colour: 0,500"});
    }
    return range.value_or(std::pair(0.0, 0.0));
}

void set_view(
    const ViewArguments& arguments,
    const quasimc::Orientation& axes,
    quasimc::ScenePicture& picture,
    Faults& faults) {
    picture.view = view_of(arguments, axes, faults);
    set_size(arguments, picture, faults);
    picture.has_annotations = !arguments.bare;
    picture.is_transparent = arguments.background == "transparent";
    picture.render.threads = static_cast<unsigned>(arguments.threads);
    set_cuts(arguments, axes, picture, faults);
}

std::vector<Flag> view_flags(ViewArguments& arguments) {
    std::vector<std::string> maps;
    for (const quasimc::ColorMap& map : quasimc::color_map_table()) {
        maps.emplace_back(map.name);
    }
    const std::string kView = "View";
    return {
        {.name = "--camera",
         .target = &arguments.view,
         .summary = "front, back, right, left, top, bottom, azimuth and elevation of the eye in "
                    "degrees, or fisheye:x,y,z for the sky as a point sees it",
         .type_name = "VIEW",
         .group = kView,
         .default_text = arguments.view},
        {.name = "--fov",
         .target = &arguments.opening,
         .summary = "field of view in degrees; 0: parallel projection",
         .range = std::pair(0.0, 150.0),
         .group = kView,
         .default_text = "0"},
        {.name = "--clip",
         .target = &arguments.cuts,
         .summary = "show this part only, in the axes of the file: 'x<0.5', 'x<0.5,z>1'",
         .type_name = "HALVES",
         .group = kView},
        {.name = "--size",
         .target = &arguments.size,
         .summary = "width and height in pixels",
         .type_name = "WxH",
         .group = kView,
         .default_text = arguments.size},
        {.name = "--background",
         .target = &arguments.background,
         .summary = "white, or none",
         .choices = {"white", "transparent"},
         .group = kView,
         .default_text = arguments.background},
        {.name = "--no-annotations",
         .target = &arguments.bare,
         .summary = "without title, legend, scale bar and directions",
         .group = kView},
        {.name = "--colormap",
         .target = &arguments.colors,
         .summary = "colours of the scale",
         .choices = maps,
         .group = "Colours",
         .default_text = arguments.colors},
        {.name = "--range",
         .target = &arguments.range,
         .summary = "values of the first and the last colour: 0,500; default those of the picture",
         .type_name = "LOW,HIGH",
         .group = "Colours"}};
}
