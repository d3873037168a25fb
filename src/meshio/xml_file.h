#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "meshio/formats.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A mesh of an XML file, in coordinates of its own.
struct XmlMesh {
    std::vector<Vec3> points;
    std::vector<std::vector<std::uint32_t>> faces;  ///< 3 to kMaxCorners points each

    /// Its faces as a part of `file`. @param placed  the transformed points
    [[nodiscard]] MeshPart part(
        const std::vector<Vec3>& placed,
        std::string material,
        std::uint32_t line,
        MeshFile& file,
        CrossedFaces& crossed) const;
};

/// The elements of an XML text and their lines. Entities declared in the text are not expanded.
class XmlFile {
  public:
    /// Reads UTF-8, or Latin-1 (or Windows-1252 where that is the same) if the text declares it. A
    /// text that is no XML is a fault, and has no elements.
    XmlFile(std::string_view bytes, Reporter& reporter);

    /// The outermost element.
    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    /// Reports a fault at the line of an element.
    void fault(
        pugi::xml_node element,
        std::string problem,
        std::string why = {},
        std::string suggestion = {}) const;
    [[nodiscard]] std::uint32_t line(pugi::xml_node element) const;
    /// The numbers in an element, all finite; empty after a fault.
    [[nodiscard]] std::optional<std::vector<double>> numbers(pugi::xml_node element) const;
    /// The mesh of the <points> and <faces> of an element, without faulty ones.
    [[nodiscard]] XmlMesh mesh(pugi::xml_node element) const;

  private:
    [[nodiscard]] std::uint32_t line_at(std::ptrdiff_t offset) const;
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> face(
        pugi::xml_node element, std::size_t points) const;

    Reporter& reporter_;
    pugi::xml_document document_;
    std::vector<std::ptrdiff_t> line_ends_;  // positions in the parsed text
};

/// The text in an element, without blanks at its ends.
[[nodiscard]] std::string xml_text(pugi::xml_node element);

}  // namespace quasimc
