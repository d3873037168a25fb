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

/// Type of a list of numbers in a GLB file.
struct GlbNumbers {
    std::uint32_t component_type = 0;  ///< 5123 uint16, 5125 uint32, 5126 float
    std::string_view type;             ///< "SCALAR", "VEC3", "VEC4"
    std::size_t bytes = 0;             ///< bytes per element, a multiple of 4
    bool is_index = false;             ///< names vertices
    bool is_normalized = false;        ///< integers represent fractions
};
inline constexpr GlbNumbers kGlbPoints{5126, "VEC3", 12};
inline constexpr GlbNumbers kGlbFloats{5126, "SCALAR", 4};
inline constexpr GlbNumbers kGlbColors{5123, "VEC4", 8, false, true};
inline constexpr GlbNumbers kGlbIndices{5125, "SCALAR", 4, true};

/// The binary part of a GLB file and its JSON description. Temporary files hold the bytes until
/// they are written.
class GlbParts {
  public:
    /// Adds a buffer view for lists of one kind. @returns its number
    std::size_t add_view(const GlbNumbers& kind);
    /// Adds a list to a view. @returns the number of its accessor
    /// @param bounds  of points; null for other numbers
    std::size_t add_list(std::size_t view, std::string_view bytes, const Bounds* bounds = nullptr);
    /// Adds a list of points, in single precision about an origin.
    std::size_t add_points(std::size_t view, const std::vector<Vec3>& points, const Vec3& origin);

    /// Writes the file. @param members  names and texts of the JSON's members, except asset, scene,
    /// buffers, views and accessors
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

/// Extracts parts of a scene as meshes in the axes of glTF: metres, y up.
class GlbMeshes {
  public:
    explicit GlbMeshes(const Scene& scene);

    /// Returns consecutive triangles of a scene, with shared vertices.
    /// @param first, count  triangles of one region
    [[nodiscard]] Mesh mesh(std::uint32_t first, std::uint32_t count);

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    const Scene& scene_;
    Affine outward_;                      // from the scene's axes and unit
    std::vector<std::uint32_t> numbers_;  // by vertex of the scene, in the current mesh
};

/// The centre of the bounds of points; the origin if there are none.
[[nodiscard]] Vec3 middle_of(const std::vector<Vec3>& points);

/// The list of scenes, with one scene. @param roots  number of its nodes, which are the first ones
[[nodiscard]] std::string glb_scene(std::size_t roots);

}  // namespace quasimc
