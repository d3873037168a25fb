#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/table_reader.h"

namespace quasimc {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
/// Use of a property.
enum class PlyRole { none, x, y, z, corners, organ, material };

struct PlyProperty {
    std::string name;
    PlyRole role = PlyRole::none;
    bool is_list = false;
    PlyType type = PlyType::float32;
    PlyType count_type = PlyType::uint8;  ///< type of a list's count
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  ///< from the header, not verified
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::string_view body;
    /// Names of materials by their numbers, as written by write_ply().
    std::map<std::int64_t, std::string> materials = {};
    bool has_texture = false;  ///< the header names a texture (TextureFile), which may be a mask
};

/// Reads the header of a PLY file and checks that it has vertices and faces; empty after a fault.
[[nodiscard]] std::optional<PlyHeader> read_ply_header(std::string_view bytes, Reporter& reporter);

}  // namespace quasimc
