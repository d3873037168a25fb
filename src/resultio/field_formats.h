#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "scene/scene.h"

namespace quasimc {

/// A number of each organ, for other programs to show.
struct OrganField {
    std::string name;            ///< "absorbed_flux_density_PAR", no blanks
    std::string unit;            ///< "W m-2"; "" for none
    std::vector<double> values;  ///< in the order of the scene's organs; NaN where it is unknown
};

/// A scene with the numbers and colours that other programs show.
struct FieldScene {
    const Scene& scene;
    std::vector<OrganField> fields = {};
    /// Colour of each organ: red, green and blue, sRGB; may be empty.
    std::vector<std::array<std::uint8_t, 3>> colors = {};
    std::string colors_of = {};  ///< quantity shown, with the ends of the scale; "" for none
};

/// One row of the table of formats for a scene with numbers, the only list of them.
struct FieldFormat {
    std::string_view name;
    std::string_view extension;
    std::string_view summary;
    void (*write)(const FieldScene& shown, const TextSink& sink);
};
[[nodiscard]] std::span<const FieldFormat> field_format_table();
/// The row of that name, or null.
[[nodiscard]] const FieldFormat* find_field_format(std::string_view name);
/// The row for the extension of a path, whatever its case, or null.
[[nodiscard]] const FieldFormat* field_format_of_path(std::string_view path);

/// VTK's XML PolyData: a triangle is a cell, with the organ's id and its numbers; names of organs
/// are field data. Binary, little-endian, double precision.
void write_vtp(const FieldScene& shown, const TextSink& sink);
/// Binary PLY, double precision: each face has the id of its organ and its numbers.
void write_field_ply(const FieldScene& shown, const TextSink& sink);
/// Binary glTF 2.0, single precision: each vertex has the numbers and the colour of its organ.
/// @throws InputError  for more organs than single precision can count, or 4 GiB and more
void write_field_glb(const FieldScene& shown, const TextSink& sink);

}  // namespace quasimc
