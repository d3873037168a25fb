#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "files/output_files.h"
#include "numbered_path.h"
#include "option_flags.h"
#include "picture/scene_picture.h"
#include "quasimc/quasimc.h"
#include "resultio/describe_result.h"
#include "show_colors.h"
#include "show_true_light.h"
#include "show_values.h"
#include "show_view.h"

namespace {

using quasimc::Faults;

struct ShowArguments {
    std::string file, output, minus, label, framed;
    ValueChoice choice;
    ViewArguments view;
    bool plain = false, realistic = false;
};

/// A picture, and the time that it shows.
struct Frame {
    quasimc::ScenePicture picture;
    std::string when;
};

/// The values of each picture: one, or with numbered pictures those of every time step.
std::vector<ShownValues> values_of(
    const ShowArguments& arguments, const ShownRun& shown, bool is_numbered) {
    std::vector<ShownValues> all;
    if (is_numbered) {
        all = read_shown_times(shown, arguments.file, arguments.choice);
    } else {
        all.push_back(read_shown_values(shown, arguments.file, arguments.choice));
    }
    if (!arguments.minus.empty()) {
        const ShownRun other = read_shown_run(arguments.minus, arguments.choice.point);
        if (other.result_text.empty()) {
            throw quasimc::InputError(
                {{"--minus", arguments.minus + " is not a result", "",
                  "give what `quasimc run --json` wrote"}});
        }
        for (ShownValues& values : all) {
            ValueChoice choice = arguments.choice;
            choice.time = is_numbered ? values.when : choice.time;
            subtract(
                shown.run.scene, other, std::filesystem::path(arguments.minus).filename().string(),
                read_shown_values(other, arguments.minus, choice), values);
        }
    }
    return all;
}

/// One scale for all pictures: that of the largest values.
std::pair<double, double> common_range(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all) {
    std::pair<double, double> range{};
    for (const ShownValues& values : all) {
        quasimc::ScenePicture picture;
        color_by_value(scene, values, {}, picture);
        range.first = std::min(range.first, picture.legend.low);
        range.second = std::max(range.second, picture.legend.high);
    }
    return range;
}

std::vector<Frame> frames_in_light(
    const ShowArguments& arguments,
    const ShownRun& shown,
    const quasimc::ScenePicture& base,
    bool is_numbered) {
    std::vector<Frame> frames;
    ValueChoice choice = arguments.choice;
    std::vector<std::string> times{choice.time};
    if (is_numbered) {
        choice.quantity = "incident_scattered";
        times.clear();
        for (const ShownValues& values : read_shown_times(shown, arguments.file, choice)) {
            times.push_back(values.when);
        }
    }
    for (const std::string& time : times) {
        choice.time = time;
        Frame& frame = frames.emplace_back(Frame{base, time});
        frame.picture.true_light = true_light_of(shown, arguments.file, choice);
        frame.picture.subtitle = "in the light of its sources" + (time.empty() ? "" : ", " + time) +
                                 (frame.picture.true_light->tints.empty()
                                      ? ""
                                      : "; one band: green and brown are not computed");
    }
    return frames;
}

/// The pictures, with the organs' colours, titles and suns.
/// @param base  with the view
std::vector<Frame> frames_of(
    const ShowArguments& arguments,
    const ShownRun& shown,
    std::pair<double, double> range,
    const quasimc::ScenePicture& base,
    bool is_numbered) {
    const quasimc::Scene& scene = shown.run.scene;
    std::vector<Frame> frames;
    if (arguments.realistic) {
        frames = frames_in_light(arguments, shown, base, is_numbered);
    } else if (!arguments.label.empty()) {
        color_by_label(scene, arguments.label, frames.emplace_back(Frame{base, ""}).picture);
    } else if (arguments.plain || shown.result_text.empty()) {
        color_plainly(scene, frames.emplace_back(Frame{base, ""}).picture);
    } else {
        const std::vector<ShownValues> all = values_of(arguments, shown, is_numbered);
        if (range.first == range.second && is_numbered) {
            range = common_range(scene, all);
        }
        for (const ShownValues& values : all) {
            Frame& frame = frames.emplace_back(Frame{base, values.when});
            color_by_value(
                scene, values, {arguments.choice.error, arguments.view.colors, range},
                frame.picture);
        }
    }
    for (Frame& frame : frames) {
        const auto& true_light = frame.picture.true_light;
        const quasimc::Sources* sources =
            true_light ? true_light->sources : sources_at(shown.run, frame.when);
        frame.picture.title = quasimc::title_of(shown.run);
        frame.picture.to_suns = suns_of(sources, shown.run.series.has_value());
    }
    return frames;
}

/// "canopy.png" in the current folder for fields/canopy.json.
std::string default_picture(const std::string& file) {
    return (file == "-" ? "scene" : std::filesystem::path(file).stem().string()) + ".png";
}

/// Whether the name numbers the time steps: "day_%02d.png".
bool is_numbered(
    const ShowArguments& arguments, const std::string& path, const quasimc::RunFile& run) {
    if (!numbered_path(path, 1)) {
        return false;
    }
    const bool is_one = !arguments.choice.time.empty() || !arguments.choice.day.empty() ||
                        arguments.plain || !arguments.label.empty();
    if (!run.series || is_one) {
        throw quasimc::InputError(
            {{"-o", fmt::format("'{}' numbers time steps", path),
              is_one ? "one picture is asked for" : "the run has no [time]",
              "name a file without %"}});
    }
    return true;
}

ShownRun read_shown(const std::string& file, std::size_t point) {
    const quasimc::FormatEntry* geometry = geometry_of(file);
    return geometry != nullptr ? read_shown_geometry(file, *geometry) : read_shown_run(file, point);
}

/// Frames a scene together with that of another file.
/// @param file  "": none
void frame_with(
    const std::string& file, const quasimc::Scene& scene, quasimc::ScenePicture& picture) {
    if (!file.empty()) {
        picture.framed = quasimc::shown_bounds(scene, picture.render.cuts);
        picture.framed.include(
            quasimc::shown_bounds(read_shown(file, 1).run.scene, picture.render.cuts));
    }
}

Exit show(const ShowArguments& arguments) {
    const std::string path =
        arguments.output.empty() ? default_picture(arguments.file) : arguments.output;
    require_pictures("show");
    check_picture_name("-o", path);
    const ShownRun shown = read_shown(arguments.file, arguments.choice.point);
    print_warnings(
        geometry_of(arguments.file) != nullptr ? shown.run.warnings
                                               : std::vector<quasimc::Warning>());
    Faults faults;
    quasimc::ScenePicture base;
    set_view(arguments.view, shown.run.scene.orientation(), base, faults);
    frame_with(arguments.framed, shown.run.scene, base);
    const auto range = range_of(arguments.view, faults);
    faults.throw_if_any();
    const bool is_sequence = is_numbered(arguments, path, shown.run);
    const std::vector<Frame> frames = frames_of(arguments, shown, range, base, is_sequence);
    std::vector<quasimc::OutputPath> paths;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        paths.push_back(
            {is_sequence ? *numbered_path(path, static_cast<std::int64_t>(i) + 1) : path, "-o"});
    }
    quasimc::OutputFiles output(paths, shown.inputs);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        output.sink(i)(draw_scene(shown.run.scene, frames[i].picture));
    }
    output.commit();
    output.throw_if_given_up();
    if (arguments.output.empty()) {
        fmt::print("written {}\n", path);
    }
    return Exit::done;
}

constexpr const char* kColors = "Colours";  // a group of flags

std::vector<Flag> flags_of_view(ShowArguments& arguments) {
    std::vector<Flag> flags = view_flags(arguments.view);
    for (Flag& flag : flags) {
        flag.excludes = flag.group == kColors ? "--error" : "";
    }
    flags.push_back(
        {.name = "--frame",
         .target = &arguments.framed,
         .summary = "make room in the picture for this scene too: a result, run file or geometry "
                    "file; pictures with the same frame can be compared",
         .type_name = "FILE",
         .group = "View"});
    flags.push_back(
        {.name = "--threads",
         .target = &arguments.view.threads,
         .summary = "threads; 0: all cores",
         .group = "View",
         .default_text = "0"});
    return flags;
}

/// All flags of `quasimc show`.
std::vector<Flag> flags_of(ShowArguments& arguments) {
    ValueChoice& choice = arguments.choice;
    std::vector<Flag> flags{
        {"FILE", &arguments.file,
         "JSON result; or a run file or geometry file, whose surfaces are drawn", true},
        {.name = "-o,--output",
         .target = &arguments.output,
         .summary = "PNG picture to write, - for standard output; default NAME.png in the current "
                    "folder; %02d in a name is the number of a time step, and every one with light "
                    "is drawn",
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
         .summary = "show its relative standard error, in classes",
         .group = kColors},
        {.name = "--minus",
         .target = &arguments.minus,
         .summary = "show the difference from this result, by organ id",
         .type_name = "FILE",
         .excludes = "--error",
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
    std::vector<Flag> view = flags_of_view(arguments);
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
