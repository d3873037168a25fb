#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/meshes/formats.h"
#include "io/meshes/placed_triangles.h"
#include "io/numbers.h"
#include "io/xml_scanner.h"
#include "io/xml_tree.h"

namespace quasimc {
namespace {

/// The child whose name is `name`, in capitals or not.
std::optional<std::size_t> child_of(
    const XmlTree& tree, std::size_t element, std::string_view name, std::string_view capital) {
    const auto found = tree.child(element, name);
    return found ? found : tree.child(element, capital);
}

/// Each mesh of the file becomes an organ.
class GwaReader {
  public:
    GwaReader(const XmlTree& tree, Reporter& reporter)
        : tree_(tree), reporter_(reporter), placed_(file_, reporter) {}

    MeshFile read() {
        for (const std::size_t mesh : tree_.children(0, "mesh")) {
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
    void read_mesh(std::size_t mesh) {
        const auto points = tree_.child(mesh, "points");
        const auto faces = tree_.child(mesh, "faces");
        if (!points || !faces) {
            fault(mesh, "a <mesh> lacks <points> or <faces>");
            return;
        }
        LocalTriangles triangles;
        const auto coordinates = numbers(*points);
        if (!coordinates || coordinates->size() % 3 != 0) {
            const std::size_t count = coordinates ? coordinates->size() : 0;
            if (count > 0) {
                fault(*points, fmt::format("<points> holds {} numbers", count), "a point has 3");
            }
            return;
        }
        for (std::size_t i = 0; i < coordinates->size(); i += 3) {
            triangles.points.push_back(
                {(*coordinates)[i], (*coordinates)[i + 1], (*coordinates)[i + 2]});
        }
        for (const std::size_t face : tree_.children(*faces, "face")) {
            read_face(face, triangles);
        }
        MeshGroup group{name_of(mesh), id_of(mesh), {}};
        placed_.add(triangles, {}, material_of(mesh), tree_[mesh].line, group);
        if (!group.parts.empty()) {
            file_.groups.push_back(std::move(group));
        }
    }

    void read_face(std::size_t face, LocalTriangles& triangles) {
        std::vector<Vec3> corners;
        std::vector<std::uint32_t> vertices;
        const auto values = numbers(face);
        if (!values) {
            return;
        }
        for (const double number : *values) {
            const auto count = static_cast<double>(triangles.points.size());
            if (!(number >= 0 && number < count) || number != std::floor(number)) {
                fault(
                    face, fmt::format("a face names point {}", number),
                    fmt::format("its mesh has {}, counted from 0", count));
                return;
            }
            vertices.push_back(static_cast<std::uint32_t>(number));
            corners.push_back(triangles.points[vertices.back()]);
        }
        if (corners.size() < 3 || corners.size() > kMostCorners) {
            fault(face, fmt::format("a face of {} corners", corners.size()));
        } else if (add_polygon(corners, vertices, triangles)) {
            crossed_.add("of line", tree_[face].line);
        }
    }

    std::string name_of(std::size_t mesh) {
        std::string name = one_line(xml_text(tree_[mesh].attribute("label")));
        if (!is_utf8(name)) {
            fault(mesh, "the label " + shown(name) + " is not UTF-8", "", "save the file as UTF-8");
            return "";
        }
        return name;
    }

    /// Nothing if it gives none.
    std::optional<std::int64_t> id_of(std::size_t mesh) {
        const std::string_view text = tree_[mesh].attribute("id");
        return parse_integer(trimmed(text.empty() ? tree_[mesh].attribute("Id") : text));
    }

    /// "color 120 100 50", from "Color 120 100 50"; "" without a colour.
    std::string material_of(std::size_t mesh) {
        const auto color = child_of(tree_, mesh, "Color", "color");
        std::vector<double> values;
        std::string_view text = color ? tree_[*color].text : std::string_view();
        constexpr Separators kSeparators = " \t\r\n\v\f,;";
        for (auto word = take_word(text, kSeparators); !word.empty();
             word = take_word(text, kSeparators)) {
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

    /// The numbers in an element; nothing after a fault.
    std::optional<std::vector<double>> numbers(std::size_t element) {
        std::vector<double> all;
        std::string_view text = tree_[element].text;
        constexpr Separators kSeparators = " \t\r\n\v\f";
        for (auto word = take_word(text, kSeparators); !word.empty();
             word = take_word(text, kSeparators)) {
            const std::optional<double> number = parse_real(word);
            if (!number || !std::isfinite(*number)) {
                fault(element, shown(word) + " is not a finite number");
                return std::nullopt;
            }
            all.push_back(*number);
        }
        return all;
    }

    void fault(
        std::size_t element, std::string problem, std::string why = {}, std::string what = {}) {
        reporter_.fault(tree_[element].line, std::move(problem), std::move(why), std::move(what));
    }

    const XmlTree& tree_;
    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    PlacedTriangles placed_;
    std::set<std::string> materials_;  // names
    CrossedFaces crossed_;
};

}  // namespace

MeshFile read_gwa(std::string_view bytes, FormatContext& context) {
    const XmlTree tree(bytes);
    if (tree.fault()) {
        context.reporter.fault(
            tree.fault()->line, std::string(tree.fault()->problem), "it is no XML");
        return {{}, {}, "line", {}};
    }
    if (tree.empty() || tree[0].name != "gwa") {
        context.reporter.fault(0, "it is no GWA file", "its outermost element is not <gwa>");
        return {{}, {}, "line", {}};
    }
    return GwaReader(tree, context.reporter).read();
}

}  // namespace quasimc
