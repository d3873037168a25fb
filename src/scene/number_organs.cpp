#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/text.h"
#include "scene/scene_checks.h"
#include "scene/scene_draft.h"

namespace quasimc {
namespace {

/// Counts the ids of organs, from the first on.
class IdCounter {
  public:
    /// The id of the next organ: the given one, or the first free one.
    std::int64_t next(const SceneDraft& draft, std::size_t organ) {
        const std::int64_t id = draft.given[organ].has_id ? draft.organs[organ].id : free();
        largest_ = std::clamp(id, largest_, kLastId - 1);
        return id;
    }
    /// One more than the largest so far, at least 1.
    [[nodiscard]] std::int64_t free() const { return largest_ + 1; }

  private:
    std::int64_t largest_ = 0;
};

void add_repeated_ids(const SceneDraft& draft, OrganFaults& faults) {
    const std::vector<Organ>& organs = draft.organs;
    std::vector<std::uint32_t> order(organs.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return organs[a].id < organs[b].id;
    });
    std::uint32_t first = order.front();
    for (const std::uint32_t i : order) {
        if (i == first || organs[i].id != organs[first].id) {
            first = i;
            continue;
        }
        faults.add(
            draft, i,
            {"", fmt::format("id {} is used already", organs[i].id),
             "by " + location_of(draft, first), "ids must be unique in a scene"});
    }
}

bool has_utf8_names(const Organ& organ) {
    const auto is_good = [](const auto& label) {
        return is_utf8(label.first) && is_utf8(label.second);
    };
    return is_utf8(organ.name) && std::all_of(organ.labels.begin(), organ.labels.end(), is_good);
}

}  // namespace

std::int64_t number_organs(SceneDraft& draft, OrganFaults& faults) {
    IdCounter ids;
    bool ascending = true;
    for (std::size_t i = 0; i < draft.organs.size(); ++i) {
        Organ& organ = draft.organs[i];
        organ.id = ids.next(draft, i);
        if (organ.name.empty()) {
            organ.name = fmt::format("organ {}", organ.id);
        }
        if (organ.id >= kLastId) {
            faults.add(
                draft, i,
                {"", fmt::format("id {} is too large", organ.id),
                 fmt::format("the largest id is {}", kLastId - 1), ""});
        }
        if (!has_utf8_names(organ)) {
            faults.add(
                draft, i,
                {"", "its name or a label is not UTF-8", "results are written as UTF-8", ""});
        }
        ascending = ascending && (i == 0 || organ.id > draft.organs[i - 1].id);
    }
    if (!ascending) {
        add_repeated_ids(draft, faults);
    }
    return ids.free();
}

std::vector<std::int64_t> organ_ids(const SceneDraft& draft) {
    IdCounter counter;
    std::vector<std::int64_t> ids;
    ids.reserve(draft.organs.size());
    for (std::size_t i = 0; i < draft.organs.size(); ++i) {
        ids.push_back(counter.next(draft, i));
    }
    return ids;
}

}  // namespace quasimc
