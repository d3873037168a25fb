#include "quasimc/growth_session.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/function_ref.h"
#include "quasimc/error.h"
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
        id, "the session has no such organ", "",
        "add it before it is changed, removed or asked for");
}

Fault twice(std::int64_t id) {
    return fault_of(id, "is stated twice", "ids are unique", "");
}

/// Refuses ids of which the session has no organ, or which are stated twice.
/// @param has  whether the session has an organ. @param of_frame  ids of its frame
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
                id, "is an organ of the scene of the session",
                "organs that were added to the session can be changed and removed",
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

GrowthSession::GrowthSession(SceneBuilder frame)
    : frame_(std::move(frame)),
      frame_ids_(set_of(frame_.organ_ids())),
      largest_id_(largest_of(frame_.organ_ids(), 0)),
      overlaps_(std::make_unique<KnownOverlaps>()) {}
GrowthSession::~GrowthSession() = default;
GrowthSession::GrowthSession(GrowthSession&& other) noexcept = default;
GrowthSession& GrowthSession::operator=(GrowthSession&& other) noexcept = default;

void GrowthSession::forget_scene() {
    scene_.reset();
    warnings_.reset();
}

void GrowthSession::set_frame(SceneBuilder frame) {
    const std::vector<std::int64_t> ids = frame.organ_ids();
    Faults faults;
    for (const std::int64_t id : ids) {
        if (has(id)) {
            faults.add(fault_of(
                id, "the session has an organ of this id", "ids are unique",
                "give that of the scene another id"));
        }
    }
    faults.throw_if_any();
    frame_ = std::move(frame);
    frame_ids_ = set_of(ids);
    largest_id_ = largest_of(ids, largest_id_);
    forget_scene();
}

std::vector<std::int64_t> GrowthSession::add(std::vector<OrganSpec> organs) {
    std::int64_t largest = largest_id_;
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
                id, "the id is too large", "ids end at " + std::to_string(kLastId - 1), ""));
        } else if (has(id)) {
            faults.add(fault_of(
                id, "the session has an organ of this id", "ids are unique",
                "change it, or remove it first"));
        } else if (frame_ids_.contains(id)) {
            faults.add(fault_of(
                id, "the scene of the session has an organ of this id", "ids are unique",
                "take another"));
        } else if (!seen.insert(id).second) {
            faults.add(twice(id));
        }
    }
    faults.throw_if_any();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        organs[i].id = ids[i];
    }
    frame_.check_organs(organs);
    largest_id_ = largest;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        places_.emplace(ids[i], next_);
        organs_.emplace(next_++, std::move(organs[i]));
    }
    forget_scene();
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
                {{"change", "an organ has no id", "it tells which organ is changed", ""}});
        }
        ids.push_back(*organ.id);
    }
    check_known(
        ids, [this](std::int64_t id) { return has(id); }, frame_ids_);
    frame_.check_organs(organs);
    for (std::size_t i = 0; i < organs.size(); ++i) {
        organs_.at(places_.at(ids[i])) = std::move(organs[i]);
    }
    forget_scene();
}

void GrowthSession::change(OrganSpec organ) {
    std::vector<OrganSpec> only;
    only.push_back(std::move(organ));
    change(std::move(only));
}

void GrowthSession::remove(std::span<const std::int64_t> ids) {
    check_known(
        ids, [this](std::int64_t id) { return has(id); }, frame_ids_);
    for (const std::int64_t id : ids) {
        const auto place = places_.find(id);
        organs_.erase(place->second);
        places_.erase(place);
    }
    forget_scene();
}

void GrowthSession::remove(std::int64_t id) {
    remove(std::span(&id, 1));
}

std::shared_ptr<const Scene> GrowthSession::scene() {
    if (!scene_) {
        SceneBuilder builder = frame_;
        for (const auto& [place, organ] : organs_) {
            builder.add_organ(organ);
        }
        scene_ = std::make_shared<const Scene>(std::move(builder).build_after(overlaps_.get()));
        ++scene_builds_;
    }
    return scene_;
}

const std::vector<Warning>& GrowthSession::warnings() {
    const std::shared_ptr<const Scene> now = scene();
    if (!warnings_) {
        warnings_ = lint_geometry(*now);
    }
    return *warnings_;
}

Result GrowthSession::run(const Sources& sources, const RunSpec& spec, const RunControl& control) {
    return simulator_.run(*scene(), sources, spec, control);
}

std::vector<std::size_t> GrowthSession::places_of(std::span<const std::int64_t> ids) {
    const std::shared_ptr<const Scene> now = scene();
    std::unordered_map<std::int64_t, std::size_t> places;
    for (std::size_t i = 0; i < now->organs().size(); ++i) {
        places.emplace(now->organs()[i].id, i);
    }
    std::vector<std::size_t> result;
    for (const std::int64_t id : ids) {
        const auto place = places.find(id);
        if (place == places.end()) {
            throw InputError({no_such_organ(id)});
        }
        result.push_back(place->second);
    }
    return result;
}

}  // namespace quasimc
