#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/line_scanner.h"
#include "io/meshes/formats.h"
#include "io/meshes/placed_triangles.h"
#include "io/meshes/unknown_keywords.h"
#include "io/xml_tree.h"

namespace quasimc {

/// What parts the numbers in an element.
inline constexpr Separators kDaeBlanks = " \t\r\n\v\f";

/// A part of a geometry of COLLADA.
struct DaePart {
    std::string_view symbol;  ///< stands for a material, which each instance binds
    LocalTriangles triangles;
};

struct DaeGeometry {
    std::string name;
    std::vector<DaePart> parts;
};

/// A COLLADA file as a tree whose elements are found by their ids, and the geometries in it.
class DaeLibrary {
  public:
    DaeLibrary(const XmlTree& tree, Reporter& reporter);

    /// The element that "#id" names; nothing, and a fault, if there is none that is called so.
    std::optional<std::size_t> target(
        std::size_t of, std::string_view reference, std::string_view name);
    /// The geometry of an element <geometry>, read when it is first asked for.
    const DaeGeometry& geometry(std::size_t element);
    /// What an element is called: its name, or its id.
    [[nodiscard]] std::string name_of(std::size_t element) const;
    /// What the effect of a <material> says.
    struct Appearance {
        std::optional<double> reflectance;  ///< the mean of its diffuse colour, if it has one
        bool has_mask = false;              ///< a texture can cut out parts of its faces
    };
    Appearance appearance_of(std::size_t material);
    /// The numbers in an element; nothing after a fault.
    /// @param count  how many there must be; nothing: any number
    std::optional<std::vector<double>> numbers(
        std::size_t element, std::optional<std::size_t> count = {});
    void fault(
        std::size_t element, std::string problem, std::string why = {}, std::string what = {});
    /// Notes elements in a node or a mesh that COLLADA has not.
    void check_children(std::size_t element, std::span<const std::string_view> known);
    /// Warns of what was left out, of numbers that don't fit and of faces whose sides cross.
    void finish();

  private:
    /// What a primitive takes from its list of numbers for each corner.
    struct Corners {
        std::size_t stride = 1, offset = 0;         ///< of the numbers of vertices
        std::optional<std::size_t> positions = {};  ///< the <source>
    };

    void read_mesh(std::size_t mesh, DaeGeometry& geometry);
    void read_primitive(std::size_t primitive, DaeGeometry& geometry);
    std::optional<Corners> read_inputs(std::size_t primitive);
    std::optional<std::size_t> positions_of(std::size_t vertices);
    std::optional<std::vector<Vec3>> read_points(std::size_t source);
    std::optional<std::vector<std::uint32_t>> read_corners(
        std::size_t list, const Corners& corners, std::size_t points);
    void add_faces(
        std::size_t primitive,
        std::size_t list,
        const std::vector<std::uint32_t>& corners,
        DaePart& part);
    void add_face(
        std::size_t list, std::span<const std::uint32_t> corners, LocalTriangles& triangles);
    /// Notes it if an element's attribute `count` is not what it holds.
    /// @param is_part  it may state fewer than there are
    void check_count(std::size_t element, std::size_t found, bool is_part = false);
    void check_faces(std::size_t primitive, std::size_t corners);

    const XmlTree& tree_;
    Reporter& reporter_;
    std::map<std::string_view, std::size_t> ids_;
    std::map<std::size_t, DaeGeometry> geometries_;
    CrossedFaces crossed_;
    UnknownKeywords unknown_;
    std::size_t left_out_ = 0;  // lines
    std::size_t repeated_ids_ = 0, wrong_counts_ = 0;
    std::string first_repeated_, first_wrong_;
    bool has_alpha_ = false;  // whether one of its images can be a mask
};

}  // namespace quasimc
