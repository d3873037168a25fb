#include "scene/scene_draft.h"

#include <utility>

#include "base/checks.h"
#include "scene/scene_checks.h"

namespace quasimc {
namespace {

/// The mesh with its vertices in the order of use, as scenes need it.
std::shared_ptr<const Mesh> in_order(const std::shared_ptr<const Mesh>& mesh) {
    Mesh copy = *mesh;
    order_vertices(copy);
    return copy == *mesh ? mesh : std::make_shared<const Mesh>(std::move(copy));
}

}  // namespace

void SceneDraft::add(OrganSpec spec) {
    DraftOrgan& draft = given.emplace_back();
    locations += spec.where;
    draft.location_end = locations.size();
    draft.field_of_view_deg = spec.field_of_view_deg;
    draft.first_part = static_cast<std::uint32_t>(parts.size());
    draft.part_count = static_cast<std::uint32_t>(spec.parts.size());
    draft.has_id = spec.id.has_value();
    Organ& organ = organs.emplace_back();
    organ.id = spec.id.value_or(0);
    organ.name = std::move(spec.name);
    organ.labels = share(std::move(spec.labels));
    organ.measured = spec.measured;
    organ.least_cosine = least_cosine(spec.field_of_view_deg);
    for (OrganPart& added : spec.parts) {
        DraftPart part;
        part.material = number_of_material(std::move(added.material));
        part.first_face = static_cast<std::uint32_t>(mesh.faces.size());
        if (added.shared) {
            EXPECT(added.triangles.empty());
            SharedMesh& mesh_of_many = shared_[added.shared.get()];
            if (!mesh_of_many.given) {
                mesh_of_many = {added.shared, in_order(added.shared)};
            }
            part.copy = static_cast<std::uint32_t>(copies.size());
            copies.push_back({mesh_of_many.ordered, added.transform});
        } else if (mesh.empty()) {
            mesh = std::move(added.triangles);  // a scene of one mesh is not copied
        } else {
            mesh.append(added.triangles);
        }
        part.face_count = static_cast<std::uint32_t>(mesh.faces.size()) - part.first_face;
        parts.push_back(part);
    }
}

std::size_t SceneDraft::triangle_count() const {
    std::size_t count = mesh.faces.size();
    for (const Instance& copy : copies) {
        count += copy.mesh->size();
    }
    return count;
}

std::uint32_t SceneDraft::number_of_material(std::string name) {
    const auto [known, is_new] =
        material_numbers_.try_emplace(name, static_cast<std::uint32_t>(material_names.size()));
    if (is_new) {
        material_names.push_back(std::move(name));
    }
    return known->second;
}

SharedLabels SceneDraft::share(Labels labels) {
    if (labels.empty()) {
        return {};
    }
    const auto known = labels_.find(labels);
    return known != labels_.end()
               ? *known
               : *labels_.emplace(std::make_shared<const Labels>(std::move(labels))).first;
}

}  // namespace quasimc
