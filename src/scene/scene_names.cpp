#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>

#include <fmt/format.h>

#include "base/lazy.h"
#include "base/text.h"
#include "quasimc/error.h"
#include "quasimc/scene.h"

namespace quasimc {
namespace {

constexpr std::size_t kSeveral = static_cast<std::size_t>(-1);

/// Advice for an unknown name.
std::string suggestion(
    const char* what, std::string_view word, const std::vector<std::string_view>& names) {
    constexpr std::size_t kShown = 10;
    if (const std::string_view near = nearest_word(word, names); !near.empty()) {
        return fmt::format("did you mean '{}'?", near);
    }
    const std::size_t shown = std::min(names.size(), kShown);
    std::string text = fmt::format("{} are ", what);
    for (std::size_t i = 0; i < shown; ++i) {
        text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
    }
    return text + (shown < names.size() ? fmt::format(" and {} more", names.size() - shown) : "");
}

}  // namespace

struct SceneNames::Lookup {
    std::unordered_map<std::int64_t, std::size_t> ids;
    std::unordered_map<std::string_view, std::size_t> names;  // kSeveral: of several organs
};

struct SceneNames::LazyLookup : Lazy<Lookup> {};

SceneNames::SceneNames(std::vector<Band> bands, std::vector<Organ> organs)
    : bands_(std::move(bands)),
      organs_(std::move(organs)),
      lookup_(std::make_unique<const LazyLookup>()) {}
SceneNames::~SceneNames() = default;

const SceneNames::Lookup& SceneNames::lookup() const {
    return lookup_->get([this] {
        Lookup lookup;
        for (std::size_t i = 0; i < organs_.size(); ++i) {
            lookup.ids.emplace(organs_[i].id, i);
            if (const auto [same, is_new] = lookup.names.emplace(organs_[i].name, i); !is_new) {
                same->second = kSeveral;
            }
        }
        return lookup;
    });
}

std::optional<std::size_t> SceneNames::find_organ(std::int64_t id) const {
    const auto& ids = lookup().ids;
    const auto found = ids.find(id);
    return found == ids.end() ? std::nullopt : std::optional(found->second);
}

std::size_t SceneNames::organ_index(std::int64_t id) const {
    if (const auto found = find_organ(id)) {
        return *found;
    }
    throw InputError(
        {{fmt::format("organ {}", id), "no organ of the scene has this id", "",
          fmt::format("it has {} organs; Scene::organs() lists them", organs_.size())}});
}

std::size_t SceneNames::organ_index(std::string_view name) const {
    const auto& names = lookup().names;
    const auto found = names.find(name);
    if (found != names.end() && found->second != kSeveral) {
        return found->second;
    }
    const std::string where = fmt::format("organ '{}'", name);
    if (found != names.end()) {
        throw InputError({{where, "several organs have this name", "", "use the organ's id"}});
    }
    std::vector<std::string_view> known;
    for (const Organ& organ : organs_) {
        known.push_back(organ.name);
    }
    throw InputError(
        {{where, "no organ of the scene has this name", "", suggestion("organs", name, known)}});
}

std::size_t SceneNames::band_index(std::string_view name) const {
    std::vector<std::string_view> known;
    for (const Band& band : bands_) {
        if (band.name == name) {
            return known.size();
        }
        known.push_back(band.name);
    }
    throw InputError(
        {{fmt::format("band '{}'", name), "no band of the scene has this name", "",
          suggestion("bands", name, known)}});
}

}  // namespace quasimc
