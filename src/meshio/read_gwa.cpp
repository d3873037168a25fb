#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/placed_triangles.h"
#include "meshio/xml_file.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Each mesh of the file becomes an organ.
class GwaReader {
  public:
    GwaReader(const XmlFile& xml, Reporter& reporter) : xml_(xml), reporter_(reporter) {}

    MeshFile read() {
        for (const pugi::xml_node mesh : xml_.root().children("mesh")) {
            if (reporter_.is_full()) {
                break;
            }
            read_mesh(mesh);
        }
        crossed_.warn(reporter_);
        drop_repeated_ids(file_, "mesh", reporter_);
        return std::move(file_);
    }

  private:
    void read_mesh(pugi::xml_node element) {
        if (!element.child("points") || !element.child("faces")) {
            xml_.fault(element, "a <mesh> lacks <points> or <faces>");
            return;
        }
        const XmlMesh mesh = xml_.mesh(element);
        MeshPart part =
            mesh.part(mesh.points, material_of(element), xml_.line(element), file_, crossed_);
        if (!part.faces.empty()) {
            const std::string_view id = element.attribute("id").value();
            file_.groups.push_back(
                {one_line(trimmed(element.attribute("label").value())),
                 parse_integer(trimmed(id.empty() ? element.attribute("Id").value() : id)),
                 {std::move(part)}});
        }
    }

    /// "color 120 100 50", from "Color 120 100 50"; "" without a colour.
    std::string material_of(pugi::xml_node mesh) {
        const std::string text = xml_text(mesh.child(mesh.child("Color") ? "Color" : "color"));
        std::vector<double> values;
        std::string_view rest = text;
        constexpr Separators kSeparators = " \t\r\n\v\f,;";
        for (auto word = take_word(rest, kSeparators); !word.empty();
             word = take_word(rest, kSeparators)) {
            if (const auto number = parse_real(word); number && std::isfinite(*number)) {
                values.push_back(*number);
            }
        }
        if (values.size() < 3) {
            return "";
        }
        constexpr double kFull = 255;
        const double mean = (values[0] + values[1] + values[2]) / 3 / kFull;
        std::string name = fmt::format("color {} {} {}", values[0], values[1], values[2]);
        if (materials_.insert(name).second) {
            file_.materials.push_back({name, std::min(1.0, std::max(0.0, mean))});
        }
        return name;
    }

    const XmlFile& xml_;
    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    std::set<std::string> materials_;  // names
    CrossedFaces crossed_;
};

}  // namespace

MeshFile read_gwa(std::string_view bytes, FormatContext& context) {
    const XmlFile xml(bytes, context.reporter);
    if (!xml.root().empty() && xml.root().name() != std::string_view("gwa")) {
        context.reporter.fault(0, "it is not a GWA file", "its outermost element is not <gwa>");
        return {{}, {}, "line", {}};
    }
    return GwaReader(xml, context.reporter).read();
}

}  // namespace quasimc
