// Checks common to geometry files of all formats.

#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.h"
#include "base/text.h"
#include "meshio/float_steps.h"
#include "meshio/formats.h"

namespace quasimc {
namespace {

/// Adds a fault for each name that is not UTF-8; each material once.
void check_names(const MeshFile& file, Reporter& reporter) {
    std::set<std::string> materials;
    const auto check = [&](std::string_view what, const std::string& name, std::uint32_t line) {
        if (!is_utf8(name) && !reporter.is_full()) {
            reporter.fault(
                line, fmt::format("{} {} is not UTF-8", what, shown(name)), "",
                "save the file as UTF-8");
        }
    };
    const auto check_material = [&](const std::string& name, std::uint32_t line) {
        if (!is_utf8(name) && materials.insert(name).second) {
            check("the material", name, line);
        }
    };
    for (const MeshGroup& group : file.groups) {
        const bool has_line =
            file.line_word == "line" && !group.parts.empty() && !group.parts.front().lines.empty();
        const std::uint32_t line = has_line ? group.parts.front().lines.front() : 0;
        check("the name", group.name, line);
        for (const auto& [key, value] : group.labels) {
            check("the label", key, line);
            check("the label", value, line);
        }
        for (const MeshPart& part : group.parts) {
            check_material(part.material, line);
        }
    }
    for (const MeshMaterial& material : file.materials) {
        check_material(material.name, 0);
    }
}

void warn_of_float_steps(const MeshFile& file, Reporter& reporter) {
    std::vector<std::span<const Face>> parts;
    for (const MeshGroup& group : file.groups) {
        for (const MeshPart& part : group.parts) {
            parts.emplace_back(part.faces);
        }
    }
    if (std::string text = describe_float_steps(file.vertices, parts); !text.empty()) {
        reporter.warn(std::move(text));
    }
}

/// The area of all faces, and of those whose material is in a map.
struct PartAreas {
    double all = 0, found = 0;
    std::set<std::string> materials;  ///< materials found
};

PartAreas areas_of(const MeshFile& file, const std::map<std::string, std::string>& names) {
    PartAreas areas;
    for (const MeshGroup& group : file.groups) {
        for (const MeshPart& part : group.parts) {
            double sum = 0;
            for (std::size_t i = 0; i < part.faces.size(); ++i) {
                sum += area(file.triangle(part, i));
            }
            areas.all += sum;
            if (names.contains(part.material)) {
                areas.found += sum;
                areas.materials.insert(part.material);
            }
        }
    }
    return areas;
}

/// @param problem  follows "2 materials"; @param answer  ends the sentence
void warn_of_opacity(
    const MeshFile& file,
    const std::map<std::string, std::string>& names,
    std::string_view problem,
    std::string_view answer,
    Reporter& reporter) {
    if (names.empty()) {
        return;
    }
    const PartAreas areas = areas_of(file, names);
    if (areas.materials.empty()) {
        return;
    }
    std::set<std::string> words;
    for (const std::string& material : areas.materials) {
        words.insert(names.at(material));
    }
    const std::size_t count = areas.materials.size();
    reporter.warn(fmt::format(
        "{} {} {} ({}): {}, {:.4g} of the area of {:.4g}", counted(count, "material"),
        count == 1 ? "has" : "have", problem, fmt::join(words, ", "), answer, areas.found,
        areas.all));
}

/// Warns of masks and of transparency, which are not read, with the area concerned.
void warn_of_unread_opacity(const MeshFile& file, Reporter& reporter) {
    warn_of_opacity(
        file, file.masks, "textures that may mask parts of a face",
        "masks are not read; faces are opaque", reporter);
    warn_of_opacity(
        file, file.transparent, "an opacity below 1", "opacity is not read; faces are opaque",
        reporter);
}

}  // namespace

bool may_have_alpha(std::string_view image) {
    const std::string name = lower_case(image);
    return !name.ends_with(".jpg") && !name.ends_with(".jpeg");
}

MeshFile read_mesh(const FormatEntry& format, std::string_view bytes, FormatContext& context) {
    MeshFile file = format.read(bytes, context);
    if (context.reporter.faults.empty()) {
        check_names(file, context.reporter);
        warn_of_float_steps(file, context.reporter);
        warn_of_unread_opacity(file, context.reporter);
    }
    return file;
}

}  // namespace quasimc
