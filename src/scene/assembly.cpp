#include "scene/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

namespace quasimc {
namespace {

/// The scale factor of a similarity transform; empty if the transform changes shapes.
std::optional<double> similarity(const Affine& a) {
    const double square = dot(a.rows[0], a.rows[0]);
    constexpr double kRounding = 1e-12;
    const auto is = [&](double x, double expected) {
        return std::abs(x - expected) <= kRounding * square;
    };
    const bool similar = is(dot(a.rows[1], a.rows[1]), square) &&
                         is(dot(a.rows[2], a.rows[2]), square) &&
                         is(dot(a.rows[0], a.rows[1]), 0) && is(dot(a.rows[1], a.rows[2]), 0) &&
                         is(dot(a.rows[2], a.rows[0]), 0);
    return similar && square > 0 ? std::optional(std::sqrt(square)) : std::nullopt;
}

/// Areas of instances. The area of a mesh is summed once for all copies of one shape.
class InstanceAreas {
  public:
    double of(const Instance& instance) {
        if (const auto factor = similarity(instance.transform)) {
            const auto [known, is_new] = areas_.try_emplace(instance.mesh.get());
            known->second = is_new ? area(*instance.mesh) : known->second;
            return *factor * *factor * known->second;
        }
        double sum = 0;
        for (std::size_t i = 0; i < instance.mesh->size(); ++i) {
            sum += area(instance.triangle(i));
        }
        return sum;
    }

  private:
    std::unordered_map<const Mesh*, double> areas_;
};

/// Whether the inverse transform of rays keeps their precision.
bool is_well_conditioned(const Affine& a) {
    const double volume = std::abs(dot(a.rows[0], cross(a.rows[1], a.rows[2])));
    const double lengths = length(a.rows[0]) * length(a.rows[1]) * length(a.rows[2]);
    constexpr double kFlat = 0.05;
    return volume > kFlat * lengths && volume > 0;
}

/// Chooses the copies of the draft that are stored as instances.
std::vector<bool> choose_instances(const SceneDraft& draft) {
    std::unordered_map<const Mesh*, std::size_t> uses;
    for (const Instance& copy : draft.copies) {
        ++uses[copy.mesh.get()];
    }
    std::vector<bool> chosen;
    for (const Instance& copy : draft.copies) {
        chosen.push_back(
            uses[copy.mesh.get()] >= kMinCopies && copy.mesh->size() >= kSmallestPrototype &&
            is_well_conditioned(copy.transform));
    }
    return chosen;
}

/// Adds the triangles of an instance to a mesh.
void append_copy(const Instance& copy, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& p : copy.mesh->vertices) {
        mesh.vertices.push_back(copy.transform.point(p));
    }
    for (const auto& [a, b, c] : copy.mesh->faces) {
        mesh.faces.push_back({first + a, first + b, first + c});
    }
}

class Assembler {
  public:
    Assembler(SceneDraft draft, std::span<const MaterialId> materials)
        : draft_(std::move(draft)), materials_(materials), is_instance_(choose_instances(draft_)) {
        std::uint32_t most = 0;
        for (const MaterialId material : materials) {
            most = std::max(most, material.value);
        }
        region_of_.assign(std::size_t{most} + 1, kNone);
    }

    DraftAssembly run() {
        mesh_.vertices = std::move(draft_.mesh.vertices);
        mesh_.faces.reserve(draft_.mesh.faces.size());
        result_.triangle_regions.reserve(draft_.mesh.faces.size());
        for (std::size_t i = 0; i < draft_.organs.size(); ++i) {
            append(i);
        }
        for (const std::size_t i : instanced_organs_) {
            draft_.organs[i].first_triangle += static_cast<std::uint32_t>(mesh_.size());
        }
        result_.organs = std::move(draft_.organs);
        draft_ = {};
        order_vertices(mesh_);
        mesh_.vertices.shrink_to_fit();
        result_.mesh = std::move(mesh_);
        return std::move(result_);
    }

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    void append(std::size_t number) {
        Organ& organ = draft_.organs[number];
        const std::span<const DraftPart> parts = draft_.parts_of(number);
        const bool has_instance = std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
            return part.copy != DraftPart::kNoCopy && is_instance_[part.copy];
        });
        if (has_instance) {
            instanced_organs_.push_back(number);
        }
        const std::uint32_t& count = has_instance ? instance_triangles_ : own_triangles_;
        organ.first_region = static_cast<std::uint32_t>(result_.regions.size());
        organ.first_triangle = count;
        for (const std::uint32_t i : add_regions(number)) {
            const std::uint32_t region = region_of_[materials_[parts[i].material].value];
            has_instance ? add_instance(parts[i], region) : add_triangles(parts[i], region);
        }
        for (const DraftPart& part : parts) {
            region_of_[materials_[part.material].value] = kNone;
        }
        organ.triangle_count = count - organ.first_triangle;
        organ.region_count =
            static_cast<std::uint32_t>(result_.regions.size()) - organ.first_region;
        for (std::size_t e = organ.first_region; e < result_.regions.size(); ++e) {
            organ.area += result_.regions[e].area;
        }
    }

    /// Adds a region for each material of the organ's non-empty parts. Returns these parts, sorted
    /// by region.
    std::vector<std::uint32_t> add_regions(std::size_t number) {
        const std::span<const DraftPart> given = draft_.parts_of(number);
        const auto region = [&](std::uint32_t i) -> std::uint32_t& {
            return region_of_[materials_[given[i].material].value];
        };
        std::vector<std::uint32_t> parts;
        for (std::uint32_t i = 0; i < given.size(); ++i) {
            if (draft_.size_of(given[i]) == 0) {
                continue;
            }
            parts.push_back(i);
            if (region(i) == kNone) {
                region(i) = static_cast<std::uint32_t>(result_.regions.size());
                const OrganIndex organ{static_cast<std::uint32_t>(number)};
                result_.regions.push_back({organ, materials_[given[i].material], 0});
            }
        }
        std::stable_sort(parts.begin(), parts.end(), [&](std::uint32_t a, std::uint32_t b) {
            return region(a) < region(b);
        });
        return parts;
    }

    void add_triangles(const DraftPart& part, std::uint32_t region) {
        if (part.copy != DraftPart::kNoCopy) {
            append_copy(draft_.copies[part.copy], mesh_);
        } else {
            const auto first =
                draft_.mesh.faces.begin() + static_cast<std::ptrdiff_t>(part.first_face);
            mesh_.faces.insert(
                mesh_.faces.end(), first, first + static_cast<std::ptrdiff_t>(part.face_count));
        }
        double sum = 0;
        for (std::size_t i = own_triangles_; i < mesh_.size(); ++i) {
            sum += area(mesh_[i]);
        }
        result_.regions[region].area += sum;
        result_.triangle_regions.resize(mesh_.size(), RegionIndex{region});
        own_triangles_ = static_cast<std::uint32_t>(mesh_.size());
    }

    /// Adds a part of an organ that has instances; its own triangles become a mesh with one
    /// instance.
    void add_instance(const DraftPart& part, std::uint32_t region) {
        Instance instance;
        if (part.copy != DraftPart::kNoCopy) {
            instance = draft_.copies[part.copy];
        } else {
            std::vector<Triangle> triangles;
            for (std::uint32_t i = 0; i < part.face_count; ++i) {
                const auto& [a, b, c] = draft_.mesh.faces[part.first_face + i];
                triangles.push_back({mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]});
            }
            instance.mesh = std::make_shared<const Mesh>(triangles);
        }
        instance_triangles_ += static_cast<std::uint32_t>(instance.mesh->size());
        result_.regions[region].area += areas_.of(instance);
        result_.instance_regions.push_back(RegionIndex{region});
        result_.instances.push_back(std::move(instance));
    }

    SceneDraft draft_;
    std::span<const MaterialId> materials_;  // by material name of the draft
    std::vector<bool> is_instance_;          // by copy of the draft
    DraftAssembly result_;
    Mesh mesh_;
    InstanceAreas areas_;
    std::vector<std::uint32_t> region_of_;  // by material, of the current organ
    // Their triangle numbers are relative until the end.
    std::vector<std::size_t> instanced_organs_;
    std::uint32_t own_triangles_ = 0, instance_triangles_ = 0;
};

}  // namespace

DraftAssembly assemble(SceneDraft draft, std::span<const MaterialId> materials) {
    return Assembler(std::move(draft), materials).run();
}

}  // namespace quasimc
