#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/runfile/table_reader.h"

namespace quasimc {

/// Rows of numbers, one after the other: the points <x,y,z> or the indices [i,j,k] of a list.
struct GeomRows {
    std::vector<double> numbers;
    std::vector<std::size_t> ends;  ///< of each row, among the numbers

    [[nodiscard]] std::size_t size() const { return ends.size(); }
    [[nodiscard]] std::size_t begin_of(std::size_t row) const {
        return row == 0 ? 0 : ends[row - 1];
    }
};

/// What stands after the name of a field: a number, a word (True, OX, a colour), a row or rows of
/// numbers, or objects, by their places in the file.
using GeomValue =
    std::variant<std::monostate, double, std::string_view, GeomRows, std::vector<std::size_t>>;

struct GeomField {
    std::string_view name;
    std::uint32_t line = 0;
    GeomValue value;
};

/// An object of a scene of PlantGL: Shape, Material, Translated, TriangleSet, ...
struct GeomObject {
    std::string_view type, name;  ///< name: "" if it has none
    std::uint32_t line = 0;
    std::vector<GeomField> fields;

    [[nodiscard]] const GeomField* find(std::string_view field) const;
};

/// The objects of a file. What is in another one, or is named in it, stands before it.
struct GeomText {
    std::vector<GeomObject> objects;
    std::vector<std::size_t> shapes;  ///< those that are Shape
};

/// Reads PlantGL's .geom, as PlantGL writes it: without macros, included files and expressions.
/// @returns nothing after a fault
[[nodiscard]] std::optional<GeomText> read_geom_text(std::string_view text, Reporter& reporter);

}  // namespace quasimc
