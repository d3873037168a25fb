#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/meshes/formats.h"

namespace quasimc {

/// The two parts of a glTF file.
struct GltfContainer {
    std::string_view json;
    std::optional<std::string_view> binary;  ///< what a GLB file holds behind the JSON
};

/// Takes a glTF file apart: GLB version 2, or JSON alone. @returns nothing after a fault
[[nodiscard]] std::optional<GltfContainer> open_gltf(std::string_view bytes, Reporter& reporter);

/// The bytes that a URI names: embedded ("data:...;base64,...") or in a file beside.
/// @throws InputError  if they can't be had
[[nodiscard]] std::string read_gltf_uri(std::string_view uri, FormatContext& context);

}  // namespace quasimc
