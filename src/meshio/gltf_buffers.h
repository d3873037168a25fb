#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshio/formats.h"
#include "meshio/gltf_values.h"

namespace quasimc {

/// The two parts of a glTF file.
struct GltfContainer {
    std::string_view json;
    std::optional<std::string_view> binary;  ///< the chunk of a GLB file after the JSON
};

/// Splits a glTF file: GLB version 2, or JSON alone. @returns empty after a fault
[[nodiscard]] std::optional<GltfContainer> open_gltf(std::string_view bytes, Reporter& reporter);

/// Numbers in a buffer, element after element, `stride` bytes apart.
struct GltfAccessor {
    std::string_view bytes;  ///< from the first element on
    std::size_t count = 0, stride = 0;
    std::uint32_t component_type = 0;  ///< 5120 to 5126: int8, uint8, int16, uint16, uint32, float
    std::size_t components = 0;        ///< per element: 1 (SCALAR) to 4
    bool is_normalized = false;        ///< integers represent fractions
    std::vector<double> low, high;     ///< bounds given in the file, per component; or empty

    /// Whether its numbers are integers and not normalized.
    [[nodiscard]] bool is_whole() const;

    /// A component of an element, both in range.
    [[nodiscard]] double at(std::size_t element, std::size_t component) const;
};

/// The buffers of a glTF file.
class GltfBuffers {
  public:
    /// Reads the buffers that are in files of their own or in the JSON.
    /// @param root  of the document; it and the container must outlive the buffers
    GltfBuffers(const Node& root, const GltfContainer& container, FormatContext& context);

    /// The accessor with a valid number; empty after a fault.
    [[nodiscard]] std::optional<GltfAccessor> accessor(std::size_t number);

  private:
    void find_buffer(const Node& json, std::size_t number, FormatContext& context);
    void read_buffer(const Node& json, std::size_t number, FormatContext& context);
    bool find_bytes(const Node& json, GltfAccessor& accessor, const std::string& where);
    std::optional<std::pair<std::string_view, std::uint64_t>> view_bytes(
        const Node& view, std::uint64_t offset, const std::string& where);

    const Node& root_;
    GltfValues values_;
    std::optional<std::string_view> binary_;
    std::vector<std::string> read_;  // bytes of the buffers that were read
    // By buffer; empty if it could not be read.
    std::vector<std::optional<std::string_view>> bytes_;
};

}  // namespace quasimc
