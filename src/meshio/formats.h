#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/input_files.h"
#include "geometry/mesh/mesh.h"
#include "quasimc/error.h"
#include "quasimc/mesh.h"
#include "scene/scene.h"
#include "text/table_reader.h"

namespace quasimc {

/// Triangles of one material.
struct MeshPart {
    std::string material;              ///< name in the file; "" if it has none
    std::vector<Face> faces;           ///< indices into the vertices of the file
    std::vector<std::uint32_t> lines;  ///< per triangle: line, or number of the face, from 1

    /// Adds the triangles of a face of 3 to kMaxCorners corners.
    /// @param numbers  of the corners, among the vertices of the file
    /// @returns whether its sides cross, so that it became a fan from its first corner
    bool add_face(
        std::span<const Vec3> corners, std::span<const std::uint32_t> numbers, std::uint32_t line);
};

/// Counts the faces of a file whose sides cross.
struct CrossedFaces {
    std::size_t count = 0;
    std::string first;  ///< "line 12", "face 3"

    void add(std::string_view word, std::uint64_t number);
    /// Warns of them if there are any.
    void warn(Reporter& reporter) const;
};

/// Largest number of corners of a face or list.
inline constexpr std::size_t kMaxCorners = 1024;

/// The triangles of a face of 3 to kMaxCorners corners. @throws InputError  if its sides cross
[[nodiscard]] std::vector<Triangle> face_triangles(std::span<const Vec3> corners);

/// A group or object of a file.
struct MeshGroup {
    std::string name;                ///< "" if the file gives none
    std::optional<std::int64_t> id;  ///< if the file gives one
    std::vector<MeshPart> parts;
    Labels labels = {};  ///< its other attributes in the file
    /// The names of the objects that contain it, from the outermost, and its own, joined by '/';
    /// "": its name alone.
    std::string path = {};

    /// Returns the part with a material; adds it if there is none.
    MeshPart& part(const std::string& material);
};

/// A material in a file.
struct MeshMaterial {
    std::string name;
    double reflectance = 0;
    double transmittance = 0;
    bool is_color = true;    ///< the reflectance is the mean of a diffuse colour, not measured
    bool has_optics = true;  ///< false: its library names it without a colour, so it is black
};

/// The geometry in a file.
struct MeshFile {
    std::vector<MeshGroup> groups;        ///< in the order of the file
    std::vector<MeshMaterial> materials;  ///< defined in the material libraries of the file
    std::string_view line_word;           ///< unit of MeshPart::lines: "line" or "face"
    std::vector<Vec3> vertices;
    /// Materials whose textures can cut out parts of their faces, with the word of the file for it
    /// ("map_d"), and materials that the file calls transparent ("d 0"). Neither is read.
    std::map<std::string, std::string> masks = {}, transparent = {};
    /// Other names of a material in run files: its number in the file, or the name that it shares
    /// with another material of the file.
    std::map<std::string, std::string> aliases = {};

    [[nodiscard]] Triangle triangle(const MeshPart& part, std::size_t i) const {
        const auto& [a, b, c] = part.faces[i];
        return {vertices[a], vertices[b], vertices[c]};
    }
    /// Returns the meshes of all parts, group after group, each with its own vertices. Moves the
    /// vertices and the faces out of the file.
    [[nodiscard]] std::vector<Mesh> take_meshes();
};

/// Input of a reader beside the bytes. Faults go to `reporter`, whose `file` is the file that is
/// read.
struct FormatContext {
    Reporter& reporter;
    InputFiles& files;  ///< reads files that the file names
    /// Folder of the file, relative to that of `files`; "" or with a '/' at the end.
    std::string folder;
    /// Axes and unit of the scene, for files with known axes and unit.
    UpAxis up = UpAxis::z;
    std::string length_unit = "m";
    /// Metres per unit of the plants in a scene of plants, if the run file gives it.
    std::optional<double> plant_metres = {};

    /// Units of the scene per metre; 1 with a warning if the unit is unknown.
    [[nodiscard]] double units_per_metre();
};

/// One row of the table of geometry formats, the only list of them.
struct FormatEntry {
    std::string_view name;        ///< value of `format = "..."`
    std::string_view extensions;  ///< ".tri", lower case, separated by blanks
    std::string_view summary;     ///< one line for the manual
    std::string_view organs =
        "groups";  ///< default of the run file's `organs`: each, groups or one
    std::string_view keeps =
        {};  ///< properties of a scene that the format stores besides triangles
    MeshFile (*read)(std::string_view bytes, FormatContext& context) = nullptr;
    void (*write)(const Scene& scene, const TextSink& sink) = nullptr;  ///< null: it is read only
    bool has_units = false;  ///< lengths have a unit, and are converted to the scene's
    /// Metres per unit of length where a scene of plants (OPS) names such a file.
    double plant_metres = 1;
    /// Rounding of written coordinates, relative to the size of their organ; 0: all digits are
    /// kept.
    double precision = 0;
};

/// All formats, in the order of the manual.
[[nodiscard]] std::span<const FormatEntry> format_table();

/// The row with a name, or null.
[[nodiscard]] const FormatEntry* find_format(std::string_view name);
/// The row for the extension of a path, whatever its case, or null.
[[nodiscard]] const FormatEntry* format_of_path(std::string_view path);

/// Whether an image file can have an alpha channel, and so be a mask: JPEG has none.
[[nodiscard]] bool may_have_alpha(std::string_view image);

/// The names of the formats that have a writer.
[[nodiscard]] std::vector<std::string> writable_formats();

/// A format of geometry that is not supported, and advice for its files.
struct ForeignFormat {
    std::string_view extension, name, advice;
};
/// The row for the extension of a path, or null.
[[nodiscard]] const ForeignFormat* foreign_format_of_path(std::string_view path);

/// Reads a file, and makes the checks common to all formats: names are UTF-8, and coordinates are
/// not too coarse for the triangles.
[[nodiscard]] MeshFile read_mesh(
    const FormatEntry& format, std::string_view bytes, FormatContext& context);

/// Writes the triangles of a scene.
/// @throws InputError  if the format has no writer
void write_geometry(const FormatEntry& format, const Scene& scene, const TextSink& sink);

// The readers. Each reports all faults (up to a hundred) and returns the valid parts.
[[nodiscard]] MeshFile read_tri(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_obj(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_ply(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_can(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_def(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_fasttracer(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_opf(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_gwa(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_stl(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_ops(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_gltf(std::string_view bytes, FormatContext& context);
[[nodiscard]] MeshFile read_vgx(std::string_view bytes, FormatContext& context);

// The writers. Coordinates are in the axes of the scene's file, with all digits.

/// Writes one triangle a line; before an organ a comment with its id and name.
void write_tri(const Scene& scene, const TextSink& sink);
/// Start of a comment with a label of the object above: "# label key = value".
inline constexpr std::string_view kObjLabel = "# label ";

/// Writes an object for each organ, with its labels in comments; materials are named, without a
/// library.
void write_obj(const Scene& scene, const TextSink& sink);
/// Writes binary PLY in double precision; each face has the id of its organ and the number of its
/// material.
void write_ply(const Scene& scene, const TextSink& sink);

/// Writes a line for each triangle, with the label of its organ.
void write_can(const Scene& scene, const TextSink& sink);
/// Writes a text with a solid for each organ.
void write_stl(const Scene& scene, const TextSink& sink);

/// Writes binary glTF 2.0: a node for each organ, with its id and labels. Metres, y up, single
/// precision about the centre of each organ. @throws InputError  if it takes 4 GiB or more
void write_glb(const Scene& scene, const TextSink& sink);

/// Adds the materials of an OBJ file's library, and their masks, to `file`. A material that it has
/// already stays as it is.
void read_mtl(std::string_view bytes, FormatContext& context, MeshFile& file);

}  // namespace quasimc
