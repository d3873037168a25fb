// What is checked of every file of geometry, whatever its format.

#include <set>

#include <fmt/format.h>

#include "base/text.h"
#include "io/meshes/float_steps.h"
#include "io/meshes/formats.h"

namespace quasimc {
namespace {

/// Adds a fault for each name that is not UTF-8; each material once.
class NameCheck {
  public:
    NameCheck(const MeshFile& file, Reporter& reporter) : file_(file), reporter_(reporter) {}

    void check() {
        for (const MeshGroup& group : file_.groups) {
            const std::uint32_t line = line_of(group);
            check("the name", group.name, line);
            for (const auto& [key, value] : group.labels) {
                check("the label", key, line);
                check("the label", value, line);
            }
            for (const MeshPart& part : group.parts) {
                check_material(part.material, line);
            }
        }
        for (const MeshMaterial& material : file_.materials) {
            check_material(material.name, 0);
        }
    }

  private:
    [[nodiscard]] std::uint32_t line_of(const MeshGroup& group) const {
        const bool has_line =
            file_.line_word == "line" && !group.parts.empty() && !group.parts.front().lines.empty();
        return has_line ? group.parts.front().lines.front() : 0;
    }

    void check_material(const std::string& name, std::uint32_t line) {
        if (!is_utf8(name) && materials_.insert(name).second) {
            check("the material", name, line);
        }
    }

    void check(std::string_view what, const std::string& name, std::uint32_t line) {
        if (!is_utf8(name) && !reporter_.is_full()) {
            reporter_.fault(
                line, fmt::format("{} {} is not UTF-8", what, shown(name)), "",
                "save the file as UTF-8");
        }
    }

    const MeshFile& file_;
    Reporter& reporter_;
    std::set<std::string> materials_;
};

void warn_of_float_steps(const MeshFile& file, Reporter& reporter) {
    std::vector<std::span<const Face>> parts;
    for (const MeshGroup& group : file.groups) {
        for (const MeshPart& part : group.parts) {
            parts.emplace_back(part.faces);
        }
    }
    if (std::string text = describe_float_steps(file.vertices, parts); !text.empty()) {
        reporter.warnings.push_back({reporter.file, std::move(text)});
    }
}

}  // namespace

MeshFile read_mesh(const FormatEntry& format, std::string_view bytes, FormatContext& context) {
    MeshFile file = format.read(bytes, context);
    if (context.reporter.faults.empty()) {
        NameCheck(file, context.reporter).check();
        warn_of_float_steps(file, context.reporter);
        warn_of_unread_opacity(file, context.reporter);
    }
    return file;
}

}  // namespace quasimc
