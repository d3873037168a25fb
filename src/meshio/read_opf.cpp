#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/xml_file.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Whether an element of the topology is a node of the plant.
bool is_node(pugi::xml_node element) {
    constexpr std::array<std::string_view, 4> kNodes{"topology", "decomp", "follow", "branch"};
    return std::find(kNodes.begin(), kNodes.end(), element.name()) != kNodes.end();
}

struct OpfMesh {
    XmlMesh mesh;
    bool is_scaled = true;     ///< its width follows the diameters of the node (enableScale)
    bool says_scaled = false;  ///< whether the file gives enableScale
};

/// Ids of a mesh and its material.
struct OpfShape {
    std::optional<std::int64_t> mesh, material;
};

/// The points of a mesh at a node: y and z of a scaled mesh are multiplied by the diameter
/// interpolated along x, then all points are transformed.
std::vector<Vec3> placed_points(
    const OpfMesh& shape, const Affine& transform, double diameter_down, double diameter_up) {
    const std::vector<Vec3>& points = shape.mesh.points;
    Bounds bounds;
    for (const Vec3& p : points) {
        bounds.add(p);
    }
    const double from = points.empty() ? 0 : bounds.low.x;
    const double length = points.empty() ? 0 : bounds.high.x - from;
    std::vector<Vec3> placed;
    placed.reserve(points.size());
    for (Vec3 p : points) {
        if (shape.is_scaled) {
            const double along = length > 0 ? (p.x - from) / length : 0;
            const double diameter = diameter_down + along * (diameter_up - diameter_down);
            p.y *= diameter;
            p.z *= diameter;
        }
        placed.push_back(transform.point(p));
    }
    return placed;
}

/// Reads the elements of a file: first the library of shapes, then the nodes of the plant.
class OpfReader : pugi::xml_tree_walker {
  public:
    OpfReader(const XmlFile& xml, Reporter& reporter) : xml_(xml), reporter_(reporter) {}

    MeshFile read() {
        xml_.root().parent().traverse(*this);
        if (!xml_.root().empty() && !has_topology_ && !reporter_.is_full()) {
            reporter_.faults.add(
                {reporter_.file, "has no <topology>", "it is not an OPF file", ""});
        }
        crossed_.warn(reporter_);
        if (without_girth_ > 0) {
            reporter_.warn(fmt::format(
                "{} nodes have no finite <dDwn> and <dUp>: their meshes, "
                "without enableScale, keep their size",
                without_girth_));
        }
        for (const auto& [id, reflectance] : reflectances_) {
            file_.materials.push_back({fmt::format("material {}", id), reflectance});
        }
        return std::move(file_);
    }

  private:
    bool for_each(pugi::xml_node& element) override {
        const std::string_view name = element.name();
        if (is_node(element)) {
            read_node(element);
        } else if (name == "mesh") {
            read_mesh(element);
        } else if (name == "material") {
            const auto color = xml_.numbers(element.child("diffuse"));
            const std::int64_t id = id_of(element, "Id");
            if (color && color->size() >= 3) {
                reflectances_[id] = ((*color)[0] + (*color)[1] + (*color)[2]) / 3;
            }
        } else if (name == "shape") {
            OpfShape& shape = shapes_[id_of(element, "Id")];
            shape.mesh = whole(element.child("meshIndex"));
            shape.material = whole(element.child("materialIndex"));
        }
        return !reporter_.is_full();
    }

    std::int64_t id_of(pugi::xml_node element, const char* key) {
        const auto id = parse_integer(trimmed(element.attribute(key).value()));
        if (!id) {
            xml_.fault(
                element,
                fmt::format("<{}> without a number as its {}", printable(element.name()), key));
        }
        return id.value_or(0);
    }

    /// The number in an element; empty without the element.
    std::optional<std::int64_t> whole(pugi::xml_node element) {
        const std::string text = xml_text(element);
        const auto number = parse_integer(text);
        if (element && !number) {
            xml_.fault(element, shown(text) + " is not a whole number");
        }
        return number;
    }

    /// Reads a mesh, which follows the diameters of its nodes unless enableScale is false.
    void read_mesh(pugi::xml_node element) {
        const std::int64_t id = id_of(element, "Id");
        if (meshes_.contains(id)) {
            xml_.fault(element, fmt::format("its Id {} is used by another mesh", id));
            return;
        }
        const pugi::xml_attribute scaled = element.attribute("enableScale");
        const std::string_view value = scaled.value();
        const bool is_unscaled = value == "false" || value == "False" || value == "FALSE";
        meshes_.emplace(id, OpfMesh{xml_.mesh(element), !is_unscaled, !scaled.empty()});
    }

    /// NaN if an axis has no diameter.
    static double diameter(pugi::xml_node geometry, const char* name) {
        const pugi::xml_node element = geometry.child(name);
        return element ? parse_real(xml_text(element)).value_or(std::nan("")) : 1;
    }

    /// Empty after a fault.
    std::optional<Affine> transform_of(pugi::xml_node geometry) {
        const pugi::xml_node element = geometry.child("mat");
        const auto m = xml_.numbers(element);
        if (!element || !m) {
            return m ? std::optional(Affine{}) : std::nullopt;
        }
        if (m->size() != 12) {
            xml_.fault(
                element, fmt::format("<mat> has {} numbers", m->size()),
                "it must have three rows of four");
            return std::nullopt;
        }
        const auto row = [&m](std::size_t i) { return Vec3{(*m)[i], (*m)[i + 1], (*m)[i + 2]}; };
        return Affine{{row(0), row(4), row(8)}, Vec3{(*m)[3], (*m)[7], (*m)[11]}};
    }

    /// Makes an organ of a node with a shape.
    void read_node(pugi::xml_node node) {
        has_topology_ = true;
        MeshGroup group{"", id_of(node, "id"), {}};
        for (const pugi::xml_node geometry : node.children("geometry")) {
            add_part(geometry, xml_.line(node), group);
        }
        if (group.parts.empty()) {
            return;
        }
        for (const char* key : {"class", "scale"}) {
            add_label(key, node.attribute(key).value(), group);
        }
        group.name = group.labels.empty() ? "" : group.labels.front().second;
        group.name += fmt::format(" {}", *group.id);
        for (const pugi::xml_node element : node.children()) {
            if (element.type() == pugi::node_element && !is_node(element) &&
                element.name() != std::string_view("geometry")) {
                add_label(element.name(), xml_text(element), group);
            }
        }
        file_.groups.push_back(std::move(group));
    }

    /// Adds the shape of a <geometry>.
    void add_part(pugi::xml_node geometry, std::uint32_t line, MeshGroup& group) {
        const auto number = whole(geometry.child("shapeIndex"));
        const auto transform = transform_of(geometry);
        if (!number || !transform) {
            return;
        }
        const OpfShape shape = shapes_.contains(*number) ? shapes_.at(*number) : OpfShape{};
        const auto mesh = shape.mesh ? meshes_.find(*shape.mesh) : meshes_.end();
        if (mesh == meshes_.end()) {
            xml_.fault(
                geometry, fmt::format("there is no shape {} with a mesh", *number),
                "<shapeBDD> and <meshBDD> must come before <topology>");
            return;
        }
        double down = diameter(geometry, "dDwn"), up = diameter(geometry, "dUp");
        if (mesh->second.is_scaled && !std::isfinite(down + up)) {
            if (mesh->second.says_scaled) {
                xml_.fault(
                    geometry, "<dDwn> or <dUp> is not a finite number",
                    "the shape's mesh is scaled by them (enableScale)");
                return;
            }
            without_girth_ += 1;
            down = up = 1;
        }
        MeshPart part = mesh->second.mesh.part(
            placed_points(mesh->second, *transform, down, up),
            shape.material ? fmt::format("material {}", *shape.material) : "", line, file_,
            crossed_);
        if (!part.faces.empty()) {
            group.parts.push_back(std::move(part));
        }
    }

    /// Adds a label, unless it is empty or repeats a name. "Name" also names the organ.
    static void add_label(std::string_view key, std::string_view text, MeshGroup& group) {
        const std::string value = one_line(trimmed(text));
        if (find_label(group.labels, key) == nullptr && !value.empty()) {
            group.name = key == "Name" ? value : group.name;
            group.labels.emplace_back(key, value);
        }
    }

    const XmlFile& xml_;
    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    std::map<std::int64_t, OpfMesh> meshes_;
    std::map<std::int64_t, OpfShape> shapes_;
    std::map<std::int64_t, double> reflectances_;  // by material: mean of the diffuse colour
    CrossedFaces crossed_;
    std::size_t without_girth_ = 0;
    bool has_topology_ = false;
};

}  // namespace

MeshFile read_opf(std::string_view bytes, FormatContext& context) {
    const XmlFile xml(bytes, context.reporter);
    return OpfReader(xml, context.reporter).read();
}

}  // namespace quasimc
