#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/function_ref.h"
#include "quasimc/error.h"
#include "quasimc/run.h"
#include "scene/build_scene.h"
#include "scene/lint.h"
#include "scene/overlap/known_overlaps.h"
#include "scene/scene_checks.h"

namespace quasimc {
namespace {

Fault fault_of(std::int64_t id, std::string problem, std::string why, std::string suggestion) {
    return {
        "organ " + std::to_string(id), std::move(problem), std::move(why), std::move(suggestion)};
}

Fault no_such_organ(std::int64_t id) {
    return fault_of(
        id, "the session has no such organ", "", "add it before you change, remove or read it");
}

Fault twice(std::int64_t id) {
    return fault_of(id, "is given twice", "ids must be unique", "");
}

/// Reports unknown ids and ids that appear twice.
/// @param has  whether the session has an organ
/// @param of_frame  ids of its frame
void check_known(
    std::span<const std::int64_t> ids,
    FunctionRef<bool(std::int64_t)> has,
    const std::unordered_set<std::int64_t>& of_frame) {
    Faults faults;
    std::unordered_set<std::int64_t> seen;
    for (const std::int64_t id : ids) {
        if (!seen.insert(id).second) {
            faults.add(twice(id));
        } else if (of_frame.contains(id)) {
            faults.add(fault_of(
                id, "belongs to the scene of the session",
                "only organs that were added to the session can be changed or removed",
                "change the scene"));
        } else if (!has(id)) {
            faults.add(no_such_organ(id));
        }
    }
    faults.throw_if_any();
}

std::int64_t largest_of(const std::vector<std::int64_t>& ids, std::int64_t least) {
    return ids.empty() ? least : std::max(least, *std::max_element(ids.begin(), ids.end()));
}

std::unordered_set<std::int64_t> set_of(const std::vector<std::int64_t>& ids) {
    return {ids.begin(), ids.end()};
}

}  // namespace

struct GrowthSession::State {
    explicit State(SceneBuilder first)
        : frame(std::move(first)),
          frame_ids(set_of(frame.organ_ids())),
          largest_id(largest_of(frame.organ_ids(), 0)) {}

    void forget_scene() {
        scene.reset();
        warnings.reset();
    }

    SceneBuilder frame;
    std::unordered_set<std::int64_t> frame_ids;
    std::map<std::uint64_t, OrganSpec> organs;             // in the order of insertion
    std::unordered_map<std::int64_t, std::uint64_t> keys;  // index of ids in `organs`
    std::uint64_t next = 0;
    std::int64_t largest_id = 0;
    std::shared_ptr<const Scene> scene;            // null after a change
    std::optional<std::vector<Warning>> warnings;  // of the scene, once requested
    KnownOverlaps overlaps;                        // of the previous scene
    std::size_t scene_builds = 0;
    Simulator simulator;
};

GrowthSession::GrowthSession(SceneBuilder frame)
    : state_(std::make_unique<State>(std::move(frame))) {}
GrowthSession::~GrowthSession() = default;
GrowthSession::GrowthSession(GrowthSession&& other) noexcept = default;
GrowthSession& GrowthSession::operator=(GrowthSession&& other) noexcept = default;

bool GrowthSession::has(std::int64_t id) const {
    return state_->keys.contains(id);
}

std::size_t GrowthSession::size() const {
    return state_->organs.size();
}

std::size_t GrowthSession::scene_builds() const {
    return state_->scene_builds;
}

std::size_t GrowthSession::tree_builds() const {
    return state_->simulator.builds();
}

void GrowthSession::set_frame(SceneBuilder frame) {
    const std::vector<std::int64_t> ids = frame.organ_ids();
    Faults faults;
    for (const std::int64_t id : ids) {
        if (has(id)) {
            faults.add(fault_of(
                id, "the session has an organ with this id", "ids must be unique",
                "give the organ of the scene another id"));
        }
    }
    faults.throw_if_any();
    state_->frame = std::move(frame);
    state_->frame_ids = set_of(ids);
    state_->largest_id = largest_of(ids, state_->largest_id);
    state_->forget_scene();
}

std::vector<std::int64_t> GrowthSession::add(std::vector<OrganSpec> organs) {
    std::int64_t largest = state_->largest_id;
    for (const OrganSpec& organ : organs) {
        largest = std::max(largest, organ.id.value_or(largest));
    }
    Faults faults;
    std::vector<std::int64_t> ids;
    std::unordered_set<std::int64_t> seen;
    for (const OrganSpec& organ : organs) {
        if (!organ.id) {
            largest = std::min(largest, kLastId - 1) + 1;
        }
        ids.push_back(organ.id.value_or(largest));
        const std::int64_t id = ids.back();
        if (id >= kLastId) {
            faults.add(fault_of(
                id, "the id is too large", "the largest id is " + std::to_string(kLastId - 1), ""));
        } else if (has(id)) {
            faults.add(fault_of(
                id, "the session has an organ with this id", "ids must be unique",
                "change it, or remove it first"));
        } else if (state_->frame_ids.contains(id)) {
            faults.add(fault_of(
                id, "the scene of the session has an organ with this id", "ids must be unique",
                "take another"));
        } else if (!seen.insert(id).second) {
            faults.add(twice(id));
        }
    }
    faults.throw_if_any();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        organs[i].id = ids[i];
    }
    state_->frame.check_organs(organs);
    state_->largest_id = largest;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        state_->keys.emplace(ids[i], state_->next);
        state_->organs.emplace(state_->next++, std::move(organs[i]));
    }
    state_->forget_scene();
    return ids;
}

std::int64_t GrowthSession::add(OrganSpec organ) {
    std::vector<OrganSpec> only;
    only.push_back(std::move(organ));
    return add(std::move(only)).front();
}

void GrowthSession::change(std::vector<OrganSpec> organs) {
    std::vector<std::int64_t> ids;
    for (const OrganSpec& organ : organs) {
        if (!organ.id) {
            throw InputError(
                {{"change", "an organ has no id", "the id selects the organ that is changed", ""}});
        }
        ids.push_back(*organ.id);
    }
    check_known(
        ids, [this](std::int64_t id) { return has(id); }, state_->frame_ids);
    state_->frame.check_organs(organs);
    for (std::size_t i = 0; i < organs.size(); ++i) {
        state_->organs.at(state_->keys.at(ids[i])) = std::move(organs[i]);
    }
    state_->forget_scene();
}

void GrowthSession::change(OrganSpec organ) {
    std::vector<OrganSpec> only;
    only.push_back(std::move(organ));
    change(std::move(only));
}

void GrowthSession::remove(std::span<const std::int64_t> ids) {
    check_known(
        ids, [this](std::int64_t id) { return has(id); }, state_->frame_ids);
    for (const std::int64_t id : ids) {
        const auto found = state_->keys.find(id);
        state_->organs.erase(found->second);
        state_->keys.erase(found);
    }
    state_->forget_scene();
}

void GrowthSession::remove(std::int64_t id) {
    remove(std::span(&id, 1));
}

std::shared_ptr<const Scene> GrowthSession::scene() {
    if (!state_->scene) {
        SceneBuilder builder = state_->frame;
        for (const auto& [key, organ] : state_->organs) {
            builder.add_organ(organ);
        }
        state_->scene =
            std::make_shared<const Scene>(build_after(std::move(builder), &state_->overlaps));
        ++state_->scene_builds;
    }
    return state_->scene;
}

const std::vector<Warning>& GrowthSession::warnings() {
    const std::shared_ptr<const Scene> now = scene();
    if (!state_->warnings) {
        state_->warnings = lint_geometry(*now);
    }
    return *state_->warnings;
}

Result GrowthSession::run(const Sources& sources, const RunSpec& spec, const RunControl& control) {
    return state_->simulator.run(*scene(), sources, spec, control);
}

std::vector<std::size_t> GrowthSession::indices_of(std::span<const std::int64_t> ids) {
    const std::shared_ptr<const Scene> now = scene();
    std::unordered_map<std::int64_t, std::size_t> indices;
    for (std::size_t i = 0; i < now->organs().size(); ++i) {
        indices.emplace(now->organs()[i].id, i);
    }
    std::vector<std::size_t> result;
    for (const std::int64_t id : ids) {
        const auto found = indices.find(id);
        if (found == indices.end()) {
            throw InputError({no_such_organ(id)});
        }
        result.push_back(found->second);
    }
    return result;
}

}  // namespace quasimc
