#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/file.h"
#include "scene/scene.h"

namespace quasimc {

/// A number of each organ, for other programs to show.
struct OrganField {
    std::string name;            ///< "absorbed_flux_density_PAR", no blanks
    std::string unit;            ///< "W m-2"; "" for none
    std::vector<double> values;  ///< in the order of the scene's organs; NaN where it is unknown
};

/// One row of the table of formats for a scene with numbers, the only place where one is entered.
struct FieldFormat {
    std::string_view name;
    std::string_view extension;
    std::string_view summary;
    void (*write)(const Scene& scene, std::span<const OrganField> fields, const TextSink& sink);
};
[[nodiscard]] std::span<const FieldFormat> field_format_table();
/// The row for the extension of a path, whatever its case, or null.
[[nodiscard]] const FieldFormat* field_format_of_path(std::string_view path);

/// VTK's XML PolyData: a triangle is a cell, with the organ's id and its numbers; names of organs
/// are field data. Binary, little-endian, double precision.
void write_vtp(const Scene& scene, std::span<const OrganField> fields, const TextSink& sink);
/// Binary PLY, double precision: each face has the id of its organ and its numbers.
void write_field_ply(const Scene& scene, std::span<const OrganField> fields, const TextSink& sink);

}  // namespace quasimc
