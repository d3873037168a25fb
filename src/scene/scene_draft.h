#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "geometry/scene_geometry.h"
#include "scene/scene.h"

namespace quasimc {

struct OrganSpec;

/// A part of an organ: faces of the draft's mesh, or one of its copies.
struct DraftPart {
    static constexpr std::uint32_t kNoCopy = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t material = 0;  ///< index among the names of the draft
    std::uint32_t first_face = 0, face_count = 0;
    std::uint32_t copy = kNoCopy;
};

/// Properties of an organ that the scene does not keep.
struct DraftOrgan {
    std::size_t location_end = 0;  ///< end of its location in SceneDraft::locations
    double field_of_view_deg = 90;
    std::uint32_t first_part = 0, part_count = 0;
    bool has_id = false;
};

/// The organs that a SceneBuilder was given, in few large arrays: an organ may be a single
/// triangle.
struct SceneDraft {
    std::vector<Organ> organs;
    std::vector<DraftOrgan> given;  ///< by organ
    std::vector<DraftPart> parts;
    Mesh mesh;                     ///< the faces of all parts
    std::vector<Instance> copies;  ///< instances of meshes that parts share
    std::vector<std::string> material_names;
    std::string locations;  ///< locations of the organs in their files, concatenated

    void add(OrganSpec spec);
    [[nodiscard]] std::span<const DraftPart> parts_of(std::size_t organ) const {
        return std::span(parts).subspan(given[organ].first_part, given[organ].part_count);
    }
    [[nodiscard]] std::string_view location_of(std::size_t organ) const {
        const std::size_t begin = organ == 0 ? 0 : given[organ - 1].location_end;
        return std::string_view(locations).substr(begin, given[organ].location_end - begin);
    }
    /// Number of triangles of a part.
    [[nodiscard]] std::size_t size_of(const DraftPart& part) const {
        return part.copy == DraftPart::kNoCopy ? part.face_count : copies[part.copy].mesh->size();
    }
    [[nodiscard]] Triangle triangle(const DraftPart& part, std::size_t i) const {
        return part.copy == DraftPart::kNoCopy ? mesh[part.first_face + i]
                                               : copies[part.copy].triangle(i);
    }
    /// Number of all triangles.
    [[nodiscard]] std::size_t triangle_count() const;

  private:
    [[nodiscard]] std::uint32_t number_of_material(std::string name);
    [[nodiscard]] SharedLabels share(Labels labels);

    std::unordered_map<std::string, std::uint32_t> material_numbers_;
    /// A given mesh, and the same mesh with its vertices in order.
    struct SharedMesh {
        std::shared_ptr<const Mesh> given;
        std::shared_ptr<const Mesh> ordered;
    };
    std::unordered_map<const Mesh*, SharedMesh> shared_;
    struct LabelsBefore {
        using is_transparent = void;
        bool operator()(const Labels& a, const Labels& b) const { return a < b; }
    };
    std::set<SharedLabels, LabelsBefore> labels_;
};

}  // namespace quasimc
