#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "commands.h"
#include "files/output_files.h"
#include "option_flags.h"
#include "picture/scene_picture.h"
#include "quasimc/quasimc.h"
#include "show_colors.h"
#include "show_true_light.h"
#include "show_values.h"
#include "text/numbers.h"

namespace {

using quasimc::Faults;

struct ShowArguments {
    std::string file, output;
    ValueChoice choice;
    std::string label, view = "200,20", size = "1200x900", colors = "viridis", range, cuts;
    double opening = 0;
    std::size_t threads = 0;
    bool plain = false, bare = false, realistic = false;
};

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

quasimc::ViewSpec view_of(const ShowArguments& arguments, Faults& faults) {
    quasimc::ViewSpec view;
    view.fov_deg = arguments.opening;
    if (const quasimc::NamedView* named = quasimc::find_view(arguments.view)) {
        view.azimuth_deg = named->azimuth_deg;
        view.elevation_deg = named->elevation_deg;
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
             fmt::format("give {}or azimuth and elevation of the eye in degrees: 200,20", names)});
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
    const ShowArguments& arguments,
    const quasimc::Scene& scene,
    quasimc::ScenePicture& picture,
    Faults& faults) {
    std::string_view rest = arguments.cuts;
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view text = rest.substr(0, comma);
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
        if (const auto cut = cut_of(text, scene.orientation())) {
            picture.render.cuts.push_back(*cut);
        } else {
            faults.add(
                {"--clip", fmt::format("'{}' is not a half of space", text), "",
                 "write the part to show, in the axes of the file: --clip 'x<0.5'"});
        }
    }
}

void set_size(const ShowArguments& arguments, quasimc::ScenePicture& picture, Faults& faults) {
    const auto size = two_numbers(arguments.size, 'x');
    const auto fits = [](double side) {
        constexpr double kLeast = 16, kMost = 16384;
        return side >= kLeast && side <= kMost && side == std::floor(side);
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

std::pair<double, double> range_of(const ShowArguments& arguments, Faults& faults) {
    const auto range = two_numbers(arguments.range, ',');
    if (!arguments.range.empty() && (!range || !(range->first < range->second))) {
        faults.add(
            {"--range", fmt::format("'{}' is not a range", arguments.range), "",
             "give the values of the first and the last colour: 0,500"});
    }
    return range.value_or(std::pair(0.0, 0.0));
}

/// Sets the camera, the clipping planes and the annotations.
void set_view(
    const ShowArguments& arguments,
    const quasimc::Scene& scene,
    quasimc::ScenePicture& picture,
    Faults& faults) {
    picture.view = view_of(arguments, faults);
    picture.has_annotations = !arguments.bare;
    picture.render.threads = static_cast<unsigned>(arguments.threads);
    set_cuts(arguments, scene, picture, faults);
}

/// Sets the organs' colours, the title and the suns of the picture.
void set_colors(
    const ShowArguments& arguments,
    const ShownRun& shown,
    std::pair<double, double> range,
    quasimc::ScenePicture& picture) {
    const quasimc::RunFile& run = shown.run;
    picture.title = title_of(run);
    std::optional<ShownValues> values;
    if (arguments.realistic) {
        picture.true_light = true_light_of(shown, arguments.file, arguments.choice);
        picture.subtitle = "in the light of its sources" +
                           (arguments.choice.time.empty() ? "" : ", " + arguments.choice.time);
    } else if (!arguments.label.empty()) {
        color_by_label(run.scene, arguments.label, picture);
    } else if (arguments.plain || shown.result_text.empty()) {
        color_plainly(run.scene, picture);
    } else {
        values = read_shown_values(shown, arguments.file, arguments.choice);
        color_by_value(
            run.scene, *values, {arguments.choice.error, arguments.colors, range}, picture);
    }
    picture.to_suns = suns_of(run, values ? &*values : nullptr);
}

/// "canopy.png" in the current folder for fields/canopy.json.
std::string default_picture(const std::string& file) {
    return (file == "-" ? "scene" : std::filesystem::path(file).stem().string()) + ".png";
}

Exit show(const ShowArguments& arguments) {
    const std::string path =
        arguments.output.empty() ? default_picture(arguments.file) : arguments.output;
    require_pictures("show");
    check_picture_name("-o", path);
    const quasimc::FormatEntry* geometry = geometry_of(arguments.file);
    const ShownRun shown = geometry != nullptr
                               ? read_shown_geometry(arguments.file, *geometry)
                               : read_shown_run(arguments.file, arguments.choice.point);
    print_warnings(geometry != nullptr ? shown.run.warnings : std::vector<quasimc::Warning>());
    Faults faults;
    quasimc::ScenePicture picture;
    set_size(arguments, picture, faults);
    set_view(arguments, shown.run.scene, picture, faults);
    const auto range = range_of(arguments, faults);
    faults.throw_if_any();
    quasimc::OutputFiles output({{path, "-o"}}, shown.inputs);
    set_colors(arguments, shown, range, picture);
    output.sink(0)(draw_scene(shown.run.scene, picture));
    output.commit();
    output.throw_if_given_up();
    if (arguments.output.empty()) {
        fmt::print("written {}\n", path);
    }
    return Exit::done;
}

/// The flags for drawing.
std::vector<Flag> view_flags(ShowArguments& arguments) {
    std::vector<std::string> maps;
    for (const quasimc::ColorMap& map : quasimc::color_map_table()) {
        maps.emplace_back(map.name);
    }
    const std::string kView = "View";
    return {
        {.name = "--camera",
         .target = &arguments.view,
         .summary = "front, back, right, left, top, bottom, or azimuth and elevation of the eye in "
                    "degrees",
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
        {.name = "--no-annotations",
         .target = &arguments.bare,
         .summary = "without title, legend, scale bar and directions",
         .group = kView},
        {.name = "--threads",
         .target = &arguments.threads,
         .summary = "threads; 0: all cores",
         .group = kView,
         .default_text = "0"},
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

/// All flags of `quasimc show`.
std::vector<Flag> flags_of(ShowArguments& arguments) {
    ValueChoice& choice = arguments.choice;
    const std::string kColors = "Colours";
    std::vector<Flag> flags{
        {"FILE", &arguments.file,
         "JSON result; or a run file or geometry file, whose surfaces are drawn", true},
        {.name = "-o,--output",
         .target = &arguments.output,
         .summary = "PNG picture to write, - for standard output; default NAME.png in the current "
                    "folder",
         .type_name = "FILE"},
        point_flag(choice.point),
        {.name = "--time",
         .target = &choice.time,
         .summary = "with [time]: the time step that begins so, 2024-06-21T12; default the sum",
         .type_name = "TIME"},
        {.name = "--day",
         .target = &choice.day,
         .summary = "with [time]: the sum of this day, 2024-06-21, instead of --time",
         .type_name = "DAY",
         .excludes = "--time"},
        {.name = "--quantity",
         .target = &choice.quantity,
         .summary = "quantity that colours show (`quasimc list quantities`), sunlit_fraction or a "
                    "ratio of the run",
         .type_name = "NAME",
         .group = kColors,
         .default_text = choice.quantity},
        {.name = "--band",
         .target = &choice.band,
         .summary = "its band; default the first",
         .type_name = "NAME",
         .group = kColors},
        {.name = "--error",
         .target = &choice.error,
         .summary = "show its standard error in per cent of the value",
         .group = kColors},
        {.name = "--label",
         .target = &arguments.label,
         .summary = "colour organs by this label instead",
         .type_name = "NAME",
         .group = kColors},
        {.name = "--realistic",
         .target = &arguments.realistic,
         .summary = "as an eye sees it, in the light of its sources",
         .group = kColors},
        {.name = "--geometry-only",
         .target = &arguments.plain,
         .summary = "show the surfaces without light",
         .group = kColors}};
    std::vector<Flag> view = view_flags(arguments);
    std::move(view.begin(), view.end(), std::back_inserter(flags));
    return flags;
}

}  // namespace

Command show_command() {
    const auto arguments = std::make_shared<ShowArguments>();
    return {
        "show", "draw a picture of a result, of the scene of a run file, or of a geometry file",
        flags_of(*arguments), [arguments] { return show(*arguments); }};
}
