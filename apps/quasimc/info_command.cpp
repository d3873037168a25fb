#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "commands.h"
#include "meshio/geometry_scene.h"
#include "option_flags.h"
#include "quasimc/quasimc.h"

namespace {

struct InfoArguments {
    std::string file, format;
};

/// A line of the report. Control characters in names from files must not reach the terminal, nor
/// end the line.
std::string line(std::string_view word, const std::string& text) {
    return fmt::format("{:<10}{}\n", word, quasimc::one_line(quasimc::printable(text)));
}

/// @param unit  of length; "" if the file does not say
std::string bounds_text(const quasimc::Scene& scene, const std::string& unit) {
    const quasimc::Vec3 a = scene.orientation().outward(scene.bounds().low);
    const quasimc::Vec3 b = scene.orientation().outward(scene.bounds().high);
    const auto axis = [](std::string_view name, double p, double q) {
        return fmt::format(
            "{} {:.6g} to {:.6g} ({:.6g})", name, std::min(p, q), std::max(p, q), std::abs(q - p));
    };
    return line(
        "bounds", fmt::format(
                      "{}, {}, {}{}", axis("x", a.x, b.x), axis("y", a.y, b.y), axis("z", a.z, b.z),
                      unit.empty() ? "; the file has no unit" : " " + unit));
}

std::string areas_text(const quasimc::Scene& scene, const std::string& unit) {
    double all = 0;
    const quasimc::Organ* least = nullptr;
    const quasimc::Organ* most = nullptr;
    for (const quasimc::Organ& organ : scene.organs()) {
        all += organ.area;
        least = least == nullptr || organ.area < least->area ? &organ : least;
        most = most == nullptr || organ.area > most->area ? &organ : most;
    }
    return line(
        "area", fmt::format(
                    "{:.6g}{} one-sided; smallest organ {:.3g} ('{}'), largest {:.3g} ('{}')", all,
                    unit.empty() ? "" : fmt::format(" {}2", unit), least->area, least->name,
                    most->area, most->name));
}

std::string materials_text(const quasimc::Scene& scene) {
    struct Use {
        std::size_t organs = 0;
        double area = 0;
    };
    std::map<std::string, Use> uses;
    for (const quasimc::Region& region : scene.regions()) {
        Use& use = uses[scene.material_name(region)];
        ++use.organs;
        use.area += region.area;
    }
    std::string text;
    for (const auto& [name, use] : uses) {
        text += line(
            "material",
            fmt::format(
                "{}: {}, area {:.6g}", name, quasimc::counted(use.organs, "organ"), use.area));
    }
    return text;
}

std::string labels_text(const quasimc::Scene& scene) {
    constexpr std::size_t kShown = 6;
    std::map<std::string, std::set<std::string>> values;
    std::map<std::string, std::size_t> organs;
    for (const quasimc::Organ& organ : scene.organs()) {
        for (const auto& [key, value] : organ.labels) {
            values[key].insert(value);
            ++organs[key];
        }
    }
    std::string text;
    for (const auto& [key, all] : values) {
        std::string label = fmt::format(
            "{}: {}, {}:", key, quasimc::counted(organs[key], "organ"),
            quasimc::counted(all.size(), "value"));
        std::size_t shown = 0;
        for (auto value = all.begin(); value != all.end() && shown < kShown; ++value, ++shown) {
            label += fmt::format(" {}", *value);
        }
        text += line("label", label + (all.size() > kShown ? " ..." : ""));
    }
    return text;
}

/// The numbers of triangles without area and of the smallest ones.
std::string triangles_text(const quasimc::Scene& scene) {
    std::vector<double> areas;
    areas.reserve(scene.triangle_count());
    for (const quasimc::Organ& organ : scene.organs()) {
        for (const quasimc::Triangle& triangle : scene.triangles_of(organ)) {
            areas.push_back(quasimc::area(triangle));
        }
    }
    if (areas.empty()) {
        return line("triangles", "0");
    }
    const auto none = std::count(areas.begin(), areas.end(), 0.0);
    std::nth_element(areas.begin(), areas.begin() + areas.size() / 2, areas.end());
    return line(
        "triangles", fmt::format(
                         "{}, median area {:.3g}, {} without area", areas.size(),
                         areas[areas.size() / 2], none));
}

std::string scene_text(const quasimc::Scene& scene, const std::string& unit) {
    return bounds_text(scene, unit) + line("organs", std::to_string(scene.organs().size())) +
           triangles_text(scene) + areas_text(scene, unit) + materials_text(scene) +
           labels_text(scene);
}

std::string warnings_text(const std::vector<quasimc::Warning>& warnings) {
    std::string text;
    for (const quasimc::Warning& warning : warnings) {
        text += line("warning", fmt::format("{}: {}", warning.where, warning.text));
    }
    return text.empty() ? line("warning", "none") : text;
}

std::string geometry_text(const std::string& path, const quasimc::FormatEntry& format) {
    const quasimc::GeometryScene read = quasimc::read_geometry_scene(path, format);
    return line("file", fmt::format("{}: {}, {}", path, format.name, format.summary)) +
           scene_text(read.scene, read.unit) + warnings_text(read.warnings);
}

std::string run_text(const std::string& path) {
    quasimc::RunSweep sweep = quasimc::read_run_sweep(path);
    const std::vector<quasimc::Warning> warnings = sweep.warnings();
    const std::size_t points = sweep.size();
    const quasimc::RunFile run = sweep.take(0);
    std::string text =
        line("file", fmt::format("{}: run file, {}", path, quasimc::counted(points, "point")));
    for (const quasimc::Band& band : run.scene.bands()) {
        text += line("band", fmt::format("{} [{}]", band.name, band.unit));
    }
    return text + scene_text(run.scene, run.scene.length_unit()) + warnings_text(warnings);
}

Exit print_info(const InfoArguments& arguments) {
    const quasimc::FormatEntry* format = arguments.format.empty()
                                             ? quasimc::format_of_path(arguments.file)
                                             : quasimc::find_format(arguments.format);
    const std::string text =
        format != nullptr ? geometry_text(arguments.file, *format) : run_text(arguments.file);
    std::fputs(text.c_str(), stdout);
    return Exit::done;
}

}  // namespace

Command info_command() {
    const auto arguments = std::make_shared<InfoArguments>();
    std::vector<std::string> formats;
    for (const quasimc::FormatEntry& entry : quasimc::format_table()) {
        formats.emplace_back(entry.name);
    }
    return {
        "info",
        "describe a geometry or run file, and report possible problems",
        {{"FILE", &arguments->file, "geometry file or run file", true},
         {.name = "--format",
          .target = &arguments->format,
          .summary = "format of a geometry file whose name does not say it",
          .choices = formats}},
        [arguments] { return print_info(*arguments); }};
}
