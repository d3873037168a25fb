#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/meshes/formats.h"
#include "io/meshes/opf_shapes.h"
#include "io/numbers.h"
#include "io/xml_scanner.h"

namespace quasimc {
namespace {

/// Elements of the topology are nodes of the plant.
bool is_node(std::string_view name) {
    constexpr std::array<std::string_view, 4> kNodes{"topology", "decomp", "follow", "branch"};
    return std::find(kNodes.begin(), kNodes.end(), name) != kNodes.end();
}

/// Follows the tags of a file: first the library of shapes, then the nodes of the plant.
class OpfReader {
  public:
    OpfReader(std::string_view bytes, Reporter& reporter) : scanner_(bytes), reporter_(reporter) {}

    MeshFile read() {
        XmlScanner::Kind kind = scanner_.next();
        for (; !reporter_.is_full() && !is_given_up_; kind = scanner_.next()) {
            if (kind == XmlScanner::Kind::open) {
                open();
            } else if (kind == XmlScanner::Kind::close) {
                close();
            } else {
                break;
            }
        }
        if (kind == XmlScanner::Kind::broken) {
            fault(scanner_.line(), std::string(scanner_.problem()), "it is no XML");
        } else if (kind == XmlScanner::Kind::end && !open_.empty()) {
            fault(
                open_.back().line, fmt::format("<{}> is not closed", shown(open_.back().name)),
                "the file ends before");
        } else if (kind == XmlScanner::Kind::end && !has_topology_) {
            reporter_.faults.add({reporter_.file, "has no <topology>", "it is no OPF file", ""});
        }
        crossed_.warn(reporter_);
        if (without_girth_ > 0) {
            reporter_.warnings.push_back(
                {reporter_.file, fmt::format(
                                     "{} nodes have no finite <dDwn> and <dUp>: their meshes, "
                                     "without enableScale, keep their size",
                                     without_girth_)});
        }
        for (const auto& [id, reflectance] : library_.reflectances) {
            file_.materials.push_back({fmt::format("material {}", id), reflectance});
        }
        return std::move(file_);
    }

  private:
    /// An element that is open.
    struct Element {
        std::string_view name;
        std::uint32_t line = 0;
        std::int64_t id = 0;               ///< of mesh, material, shape, node
        Labels labels = {};                ///< of a node
        std::optional<std::size_t> group;  ///< of a node with a shape
    };

    [[nodiscard]] std::string_view parent() const {
        return open_.size() < 2 ? std::string_view() : open_[open_.size() - 2].name;
    }

    void open() {
        const std::string_view name = scanner_.name();
        Element element{name, scanner_.line(), 0, {}, {}};
        if (name == "mesh" || name == "material" || name == "shape") {
            element.id = read_id("Id");
        }
        if (name == "mesh") {
            read_mesh(library_.meshes[element.id]);
        } else if (is_node(name)) {
            has_topology_ = true;
            element.id = read_id("id");
            for (const std::string_view key : {"class", "scale"}) {
                if (const auto value = scanner_.attribute(key)) {
                    add_label(element, key, *value);
                }
            }
        } else if (name == "geometry") {
            place_ = {};
        }
        open_.push_back(std::move(element));
    }

    /// A mesh follows the girth of its nodes unless it says that it does not.
    void read_mesh(OpfMesh& mesh) {
        const auto value = scanner_.attribute("enableScale");
        mesh.says_scaled = value.has_value();
        mesh.is_scaled = !value || !(*value == "false" || *value == "False" || *value == "FALSE");
    }

    std::int64_t read_id(std::string_view key) {
        const auto word = scanner_.attribute(key);
        const auto id = word ? parse_integer(trimmed(*word)) : std::nullopt;
        if (!id) {
            fault(
                scanner_.line(),
                fmt::format("<{}> without a number as its {}", shown(scanner_.name()), key));
        }
        return id.value_or(0);
    }

    void close() {
        if (open_.empty() || open_.back().name != scanner_.name()) {
            fault(
                scanner_.line(), fmt::format("</{}> closes nothing", shown(scanner_.name())),
                "it is no XML");
            is_given_up_ = true;
            return;
        }
        Element& element = open_.back();
        if (is_node(element.name)) {
            finish_node(element);
        } else if (element.name == "geometry" && is_node(parent())) {
            add_organ(open_[open_.size() - 2]);
        } else if (parent() == "geometry") {
            read_place(element.name);
        } else if (is_node(parent())) {
            add_label(open_[open_.size() - 2], element.name, scanner_.text());
        } else if (open_.size() >= 2) {
            read_library(element.name, open_[open_.size() - 2]);
        }
        open_.pop_back();
    }

    /// @param of  the mesh, material or shape that it belongs to
    void read_library(std::string_view name, const Element& of) {
        if (of.name == "mesh" && name == "points") {
            read_points(library_.meshes[of.id]);
        } else if (of.name == "faces" && name == "face" && open_.size() >= 3) {
            read_face(library_.meshes[open_[open_.size() - 3].id]);
        } else if (of.name == "material" && name == "diffuse") {
            const std::vector<double> color = numbers();
            if (color.size() >= 3) {
                library_.reflectances[of.id] = (color[0] + color[1] + color[2]) / 3;
            }
        } else if (of.name == "shape" && name == "meshIndex") {
            library_.shapes[of.id].mesh = whole();
        } else if (of.name == "shape" && name == "materialIndex") {
            library_.shapes[of.id].material = whole();
        }
    }

    void read_points(OpfMesh& mesh) {
        const std::vector<double> coordinates = numbers();
        if (coordinates.size() % 3 != 0) {
            fault(
                scanner_.text_line(), fmt::format("<points> holds {} numbers", coordinates.size()),
                "a point is x y z");
            return;
        }
        if (!mesh.faces.empty()) {
            fault(
                scanner_.text_line(), "points of a mesh that has faces already",
                "its Id is that of another one, or its points stand behind its faces");
            return;
        }
        mesh.points.clear();
        for (std::size_t i = 0; i < coordinates.size(); i += 3) {
            mesh.points.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
        }
    }

    void read_face(OpfMesh& mesh) {
        std::vector<std::uint32_t> face;
        for (const double number : numbers()) {
            if (!(number >= 0 && number < static_cast<double>(mesh.points.size())) ||
                number != std::floor(number)) {
                fault(
                    scanner_.text_line(), fmt::format("a face names point {}", number),
                    fmt::format(
                        "its mesh has {}, counted from 0, before its faces", mesh.points.size()));
                return;
            }
            face.push_back(static_cast<std::uint32_t>(number));
        }
        if (face.size() < 3 || face.size() > kMostCorners) {
            fault(scanner_.text_line(), fmt::format("a face of {} corners", face.size()));
            return;
        }
        mesh.faces.push_back(std::move(face));
    }

    void read_place(std::string_view name) {
        if (name == "shapeIndex") {
            place_.shape = whole();
        } else if (name == "dUp" || name == "dDwn") {
            // Not a number where an axis has no girth of its own: it matters only to a scaled mesh.
            (name == "dUp" ? place_.diameter_up : place_.diameter_down) =
                parse_real(trimmed(scanner_.text())).value_or(std::nan(""));
        } else if (name == "mat") {
            const std::vector<double> m = numbers();
            if (m.size() != 12) {
                fault(
                    scanner_.text_line(), fmt::format("<mat> holds {} numbers", m.size()),
                    "it has three rows of four");
                return;
            }
            place_.transform = {
                {Vec3{m[0], m[1], m[2]}, Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]}},
                Vec3{m[3], m[7], m[11]}};
        }
    }

    /// The shape that a <geometry> places becomes an organ.
    void add_organ(Element& node) {
        if (!place_.shape) {
            return;
        }
        const OpfMesh* mesh = library_.find_mesh(*place_.shape);
        if (mesh == nullptr) {
            fault(
                scanner_.line(), fmt::format("there is no shape {} with a mesh", *place_.shape),
                "<shapeBDD> and <meshBDD> come before <topology>");
            return;
        }
        const bool has_girth = std::isfinite(place_.diameter_down + place_.diameter_up);
        if (mesh->is_scaled && !mesh->says_scaled && !has_girth) {
            without_girth_ += 1;
            place_.diameter_down = place_.diameter_up = 1;
        } else if (mesh->is_scaled && !has_girth) {
            fault(
                scanner_.line(), "<dDwn> or <dUp> is not a finite number",
                "the shape's mesh is scaled by them (enableScale)");
            return;
        }
        const auto first = static_cast<std::uint32_t>(file_.vertices.size());
        const std::vector<Vec3> points = placed_points(*mesh, place_);
        file_.vertices.insert(file_.vertices.end(), points.begin(), points.end());
        MeshPart part{library_.material_of(*place_.shape), {}, {}};
        for (const std::vector<std::uint32_t>& face : mesh->faces) {
            std::vector<Vec3> corners;
            std::vector<std::uint32_t> vertices;
            for (const std::uint32_t point : face) {
                corners.push_back(points[point]);
                vertices.push_back(first + point);
            }
            if (part.add_face(corners, vertices, node.line)) {
                crossed_.add("of line", node.line);
            }
        }
        if (!part.faces.empty()) {
            node.group = file_.groups.size();
            file_.groups.push_back({"", node.id, {std::move(part)}});
        }
    }

    void finish_node(Element& node) {
        if (!node.group) {
            return;
        }
        MeshGroup& group = file_.groups[*node.group];
        std::string kind;
        for (const auto& [key, value] : node.labels) {
            kind = key == "class" ? value : kind;
            group.name = key == "Name" ? value : group.name;
        }
        if (group.name.empty()) {
            group.name = fmt::format("{} {}", kind, node.id);
        }
        group.labels = std::move(node.labels);
    }

    void add_label(Element& node, std::string_view key, std::string_view text) {
        const std::string value = one_line(xml_text(text));
        const bool is_new = std::none_of(
            node.labels.begin(), node.labels.end(),
            [key](const auto& label) { return label.first == key; });
        if (!is_utf8(value) || !is_utf8(key)) {
            fault(scanner_.line(), shown(key) + " is not UTF-8", "", "save the file as UTF-8");
        } else if (is_new && !value.empty()) {
            node.labels.emplace_back(key, value);
        }
    }

    /// The numbers in the present element.
    std::vector<double> numbers() {
        std::vector<double> all;
        std::string_view text = scanner_.text();
        constexpr Separators kSeparators = " \t\r\n\v\f";
        for (std::string_view word = take_word(text, kSeparators); !word.empty();
             word = take_word(text, kSeparators)) {
            const std::optional<double> number = parse_real(word);
            if (!number || !std::isfinite(*number)) {
                fault(scanner_.text_line(), shown(word) + " is not a finite number");
                return {};
            }
            all.push_back(*number);
        }
        return all;
    }

    std::optional<std::int64_t> whole() {
        const std::optional<std::int64_t> number = parse_integer(trimmed(scanner_.text()));
        if (!number) {
            fault(scanner_.line(), shown(trimmed(scanner_.text())) + " is no whole number");
        }
        return number;
    }

    void fault(
        std::uint32_t line, std::string problem, std::string why = {}, std::string what = {}) {
        reporter_.fault(line, std::move(problem), std::move(why), std::move(what));
    }

    XmlScanner scanner_;
    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    OpfLibrary library_;
    OpfPlace place_;
    std::vector<Element> open_;
    CrossedFaces crossed_;
    std::size_t without_girth_ = 0;
    bool has_topology_ = false, is_given_up_ = false;
};

}  // namespace

MeshFile read_opf(std::string_view bytes, FormatContext& context) {
    return OpfReader(bytes, context.reporter).read();
}

}  // namespace quasimc
