#include "quasimc/growth_session.h"

#include <algorithm>
#include <string>
#include <utility>

#include "quasimc/error.h"
#include "scene/known_overlaps.h"

namespace quasimc {
namespace {

InputError no_such_organ(std::int64_t id) {
    return InputError(
        {{"organ " + std::to_string(id), "the session has no such organ", "",
          "add it before it is changed, removed or asked for"}});
}

}  // namespace

GrowthSession::GrowthSession(SceneBuilder frame)
    : frame_(std::move(frame)), overlaps_(std::make_unique<KnownOverlaps>()) {}
GrowthSession::~GrowthSession() = default;
GrowthSession::GrowthSession(GrowthSession&& other) noexcept = default;
GrowthSession& GrowthSession::operator=(GrowthSession&& other) noexcept = default;

void GrowthSession::set_frame(SceneBuilder frame) {
    frame_ = std::move(frame);
    scene_.reset();
}

std::int64_t GrowthSession::add(OrganSpec organ) {
    const std::int64_t id = organ.id.value_or(largest_id_ + 1);
    if (has(id)) {
        throw InputError(
            {{"organ " + std::to_string(id), "the session has an organ of this id",
              "ids are unique", "change it, or remove it first"}});
    }
    organ.id = id;
    largest_id_ = std::max(largest_id_, id);
    places_.emplace(id, next_);
    organs_.emplace(next_++, std::move(organ));
    scene_.reset();
    return id;
}

void GrowthSession::change(OrganSpec organ) {
    const auto place = places_.find(organ.id.value_or(0));
    if (!organ.id || place == places_.end()) {
        throw no_such_organ(organ.id.value_or(0));
    }
    organs_.at(place->second) = std::move(organ);
    scene_.reset();
}

void GrowthSession::remove(std::int64_t id) {
    const auto place = places_.find(id);
    if (place == places_.end()) {
        throw no_such_organ(id);
    }
    organs_.erase(place->second);
    places_.erase(place);
    scene_.reset();
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
            throw no_such_organ(id);
        }
        result.push_back(place->second);
    }
    return result;
}

}  // namespace quasimc
