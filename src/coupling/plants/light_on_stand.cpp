#include "coupling/plants/light_on_stand.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "coupling/plants/plant_organs.h"
#include "quasimc/error.h"
#include "scene/build_scene.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

std::vector<std::string> stand_materials(const SceneBuilder& stand) {
    std::vector<std::string> names;
    for (const auto& [material, where] : SceneAccess::data(stand).materials) {
        names.push_back(material.name);
    }
    return names;
}

/// Reports materials that the stand lacks.
void check_stand_materials(
    const std::vector<std::string>& names, const LightOnStand::Options& options) {
    Faults faults;
    if (names.empty()) {
        faults.add(
            {"stand", "it has no materials", "the organs of the plant need one", "add a material"});
    }
    const auto check = [&](const std::string& where, const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            faults.add(
                {where, fmt::format("the stand has no material '{}'", name), "",
                 fmt::format("use {}", fmt::join(names, ", "))});
        }
    };
    for (const auto& [symbol, name] : options.materials) {
        check(fmt::format("material of the module {}", symbol), name);
    }
    if (!options.default_material.empty()) {
        check("default material", options.default_material);
    }
    faults.throw_if_any();
}

/// The first id after those of the stand.
std::int64_t id_after(const SceneBuilder& stand) {
    std::int64_t last = 0;
    for (const std::int64_t id : stand.organ_ids()) {
        last = std::max(last, id);
    }
    return last + 1;
}

/// Turns shapes with y up to z up. Coordinates are permuted as by Orientation.
void turn_to_z_up(OrganPart& part) {
    const Orientation from(UpAxis::y, {1, 0, 0});
    for (Vec3& vertex : part.triangles.vertices) {
        vertex = from.inward(vertex);
    }
    if (part.shared) {
        const std::array<Vec3, 3> rows = part.transform.rows;
        part.transform.rows = {rows[2], rows[0], rows[1]};
        part.transform.shift = from.inward(part.transform.shift);
    }
}

}  // namespace

LightOnStand::LightOnStand(SceneBuilder stand, LightOfScene light, Options options)
    : light_of_scene_(std::move(light)),
      options_(std::move(options)),
      material_names_(stand_materials(stand)),
      is_z_up_(SceneAccess::data(stand).orientation.up() == UpAxis::z),
      first_id_(id_after(stand)),
      session_(std::move(stand)),
      drawing_(options_.sides) {
    check_stand_materials(material_names_, options_);
}

LightOnStand::LightOnStand(SceneBuilder stand, StandLight light, Options options)
    : LightOnStand(
          std::move(stand),
          [light = std::move(light)](const Scene& /*scene*/) { return light; },
          std::move(options)) {}

Drawing* LightOnStand::query(const PlantQuery& query) {
    if (query.is_answered) {
        constexpr std::size_t kQueryModules = 2;  // '?' and 'E'
        const auto following = static_cast<std::int64_t>(query.module.index + kQueryModules);
        const bool asks = !query.parameters.empty() && query.parameters[0] >= 0;
        asked_.push_back({query.id, query.parameters.size(), asks, first_id_ + following});
    }
    return nullptr;  // all shapes go to drawing()
}

const std::string& LightOnStand::material_of(char symbol) const {
    const auto given = options_.materials.find(symbol);
    if (given != options_.materials.end()) {
        return given->second;
    }
    const auto named =
        std::find(material_names_.begin(), material_names_.end(), std::string_view(&symbol, 1));
    if (named != material_names_.end()) {
        return *named;
    }
    return options_.default_material.empty() ? material_names_.front() : options_.default_material;
}

std::vector<OrganSpec> LightOnStand::organs_of_pass(std::int64_t step) {
    std::map<std::int64_t, char> symbols;
    for (const DrawnOrgan& drawn : drawing_.organs()) {
        symbols.emplace(static_cast<std::int64_t>(drawn.module.index) + 1, drawn.module.symbol);
    }
    std::vector<OrganSpec> organs = plant_organs(drawing_, step);
    static_cast<void>(drawing_.take_organs());
    for (OrganSpec& organ : organs) {
        const std::string& material = material_of(symbols.at(*organ.id));
        for (OrganPart& part : organ.parts) {
            part.material = material;
            if (is_z_up_) {
                turn_to_z_up(part);
            }
        }
        organ.id = id_of(*organ.id);
    }
    return organs;
}

void LightOnStand::set_organs(std::vector<OrganSpec> organs) {
    // All are replaced, so that their order is that of the string; unchanged triangles keep the
    // acceleration structure.
    session_.remove(std::exchange(organs_, {}));
    organs_ = session_.add(std::move(organs));
}

void LightOnStand::compute(std::int64_t step) {
    scene_.reset();
    result_.reset();
    if (organs_.empty()) {
        return;
    }
    const std::shared_ptr<const Scene> scene = session_.scene();
    if (!light_) {
        light_ = light_of_scene_(*scene);
    }
    RunSpec spec = light_->spec;
    spec.seed += static_cast<std::uint64_t>(step);
    auto result =
        std::make_shared<const Result>(session_.run(light_->sources, spec, options_.control()));
    if (result->stop == StopReason::interrupted) {
        throw Stopped(StopReason::interrupted, "The light was stopped.");
    }
    scene_ = scene;
    result_ = std::move(result);
}

PlantAnswer LightOnStand::answer_to(const Asked& asked, std::size_t organ) const {
    PlantAnswer answer{asked.query, {}};
    for (std::size_t b = 0; b < std::min(asked.parameters, result_->bands); ++b) {
        const Estimate light = reported(result_->at(organ, options_.quantity, b));
        answer.values.emplace_back(static_cast<float>(light.mean));
    }
    return answer;
}

std::vector<PlantAnswer> LightOnStand::answers(std::int64_t step) {
    const std::vector<Asked> all = std::exchange(asked_, {});
    queried_.clear();
    set_organs(organs_of_pass(step));
    compute(step);
    pass_step_ = step;
    std::vector<PlantAnswer> answers;
    for (const Asked& asked : all) {
        queried_.push_back(scene_ ? scene_->names()->find_organ(asked.organ) : std::nullopt);
        if (asked.asks && queried_.back()) {
            answers.push_back(answer_to(asked, *queried_.back()));
        }
    }
    return answers;
}

std::vector<Warning> LightOnStand::warnings() {
    return scene_ ? session_.warnings() : std::vector<Warning>{};
}

}  // namespace quasimc
