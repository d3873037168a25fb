#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/spool.h"
#include "quasimc/error.h"
#include "quasimc/mesh.h"
#include "scene/scene.h"
#include "text/json.h"

namespace quasimc {

/// What a list of numbers in a GLB file is.
struct GlbNumbers {
    std::uint32_t component_type = 0;  ///< 5123 uint16, 5125 uint32, 5126 float
    std::string_view type;             ///< "SCALAR", "VEC3", "VEC4"
    std::size_t bytes = 0;             ///< of an element, a multiple of 4
    bool is_index = false;             ///< names vertices
    bool is_normalized = false;        ///< integers stand for fractions
};
inline constexpr GlbNumbers kGlbPoints{5126, "VEC3", 12};
inline constexpr GlbNumbers kGlbFloats{5126, "SCALAR", 4};
inline constexpr GlbNumbers kGlbColors{5123, "VEC4", 8, false, true};
inline constexpr GlbNumbers kGlbIndices{5125, "SCALAR", 4, true};

/// The binary part of a GLB file and what the JSON says of it. Bytes are kept in temporary files
/// until they are written.
class GlbParts {
  public:
    /// Adds a buffer view for lists of one kind. @returns its number
    std::size_t add_view(const GlbNumbers& kind);
    /// A list in a view. @returns the number of its accessor
    /// @param bounds  of points; null for other numbers
    std::size_t add_list(std::size_t view, std::string_view bytes, const Bounds* bounds = nullptr);
    /// The same of points, in single precision about an origin.
    std::size_t add_points(std::size_t view, const std::vector<Vec3>& points, const Vec3& origin);

    /// Writes the file. @param members  of the JSON and their texts, all but asset, scene, buffers,
    /// views and accessors
    /// @throws InputError  if it takes 4 GiB or more
    void write(
        const std::vector<std::pair<std::string_view, std::string>>& members, const TextSink& sink);

  private:
    struct View {
        GlbNumbers kind;
        std::uint64_t size = 0;
        std::unique_ptr<Spool> bytes;
    };

    std::vector<View> views_;
    std::string accessors_;  // texts of a list
    std::size_t lists_ = 0;
};

/// Takes parts of a scene as meshes of their own, in metres with y up, as glTF has it.
class GlbMeshes {
  public:
    explicit GlbMeshes(const Scene& scene);

    /// The triangles of a scene from one number on, with the vertices that they share.
    /// @param first, count  triangles of one region
    [[nodiscard]] Mesh mesh(std::uint32_t first, std::uint32_t count);

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    const Scene& scene_;
    Affine outward_;                      // from the scene's axes and unit
    std::vector<std::uint32_t> numbers_;  // of the scene's vertices in the mesh being made
};

/// The middle of the box about points; the origin if there are none.
[[nodiscard]] Vec3 middle_of(const std::vector<Vec3>& points);

/// The list of scenes, which is one. @param roots  how many nodes it has, the first ones
[[nodiscard]] std::string glb_scene(std::size_t roots);

}  // namespace quasimc
