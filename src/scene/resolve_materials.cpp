// Checks the materials, and resolves the names of the organs' materials.

#include <unordered_map>

#include <fmt/format.h>

#include "base/text.h"
#include "scene/scene_checks.h"
#include "scene/scene_draft.h"

namespace quasimc {
namespace {

using GivenMaterials = std::span<const std::pair<MaterialSpec, std::string>>;
using MaterialNumbers = std::unordered_map<std::string_view, std::uint32_t>;

/// The number of each material; adds the faults of materials and names.
MaterialNumbers number_materials(GivenMaterials materials, std::size_t bands, Faults& faults) {
    MaterialNumbers numbers;
    for (std::uint32_t i = 0; i < materials.size(); ++i) {
        const auto& [spec, origin] = materials[i];
        const std::string where = location_of(spec, origin);
        check_material(spec, bands, where, faults);
        const auto [other, is_new] = numbers.try_emplace(spec.name, i);
        if (spec.name.empty()) {
            faults.add({where, "it has no name", "organs refer to materials by name", ""});
        } else if (!is_utf8(spec.name)) {
            faults.add({where, "its name is not UTF-8", "", ""});
        } else if (!is_new) {
            const std::string& first = materials[other->second].second;
            const std::string why =
                first.empty() ? "names must be unique" : "the first is at " + first;
            faults.add({where, "it is defined twice", why, ""});
        }
    }
    return numbers;
}

/// Collects names of missing materials; each is reported once, with the first organ that names it.
class Missing {
  public:
    void add(std::size_t organ, std::string_view material) {
        const auto [at, is_new] = row_of_.try_emplace(material, rows_.size());
        if (is_new) {
            rows_.push_back({organ, material});
        }
        ++rows_[at->second].parts;
    }

    void report(
        const SceneDraft& draft, std::span<const std::string_view> known, Faults& faults) const {
        for (const Row& row : rows_) {
            faults.add(
                {location_of(draft, row.first),
                 row.material.empty() ? "the material is missing"
                                      : fmt::format("material '{}' is not defined", row.material),
                 row.parts == 1 ? "organs refer to materials by name"
                                : fmt::format("{} parts of organs use it", row.parts),
                 known.empty() ? "define a material with that name"
                               : did_you_mean(row.material, known)});
        }
    }

  private:
    struct Row {
        std::size_t first;
        std::string_view material;
        std::size_t parts = 0;
    };
    std::vector<Row> rows_;
    std::unordered_map<std::string_view, std::size_t> row_of_;
};

}  // namespace

std::vector<MaterialId> resolve_materials(
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    const SceneDraft& draft,
    std::size_t bands,
    Faults& faults) {
    const MaterialNumbers numbers = number_materials(materials, bands, faults);
    std::vector<MaterialId> found;
    std::vector<bool> is_missing;
    for (const std::string& name : draft.material_names) {
        const auto material = numbers.find(name);
        is_missing.push_back(material == numbers.end());
        found.push_back({is_missing.back() ? 0 : material->second});
    }
    Missing missing;
    for (std::size_t i = 0; i < draft.organs.size(); ++i) {
        for (const DraftPart& part : draft.parts_of(i)) {
            if (is_missing[part.material]) {
                missing.add(i, draft.material_names[part.material]);
            }
        }
    }
    std::vector<std::string_view> known;
    for (const auto& [spec, origin] : materials) {
        known.push_back(spec.name);
    }
    missing.report(draft, known, faults);
    return found;
}

}  // namespace quasimc
