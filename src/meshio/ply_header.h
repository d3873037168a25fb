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
/// What we read a property for.
enum class PlyRole { none, x, y, z, corners, organ, material };

struct PlyProperty {
    std::string name;
    PlyRole role = PlyRole::none;
    bool is_list = false;
    PlyType type = PlyType::float32;
    PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  ///< what the header says: not to be trusted
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::string_view body;
    /// Names of materials, by their numbers, as write_ply() writes them.
    std::map<std::int64_t, std::string> materials = {};
    bool has_texture = false;  ///< names a file of colours (TextureFile), which may hold a mask
};

/// Reads the header of a PLY file and checks that vertices and faces can be had; nothing after a
/// fault.
[[nodiscard]] std::optional<PlyHeader> read_ply_header(std::string_view bytes, Reporter& reporter);

}  // namespace quasimc
