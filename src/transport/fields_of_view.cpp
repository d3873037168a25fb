#include "transport/fields_of_view.h"

#include <algorithm>

namespace quasimc {

FieldsOfView::FieldsOfView(const Scene& scene) {
    const bool any_narrow = std::any_of(
        scene.organs().begin(), scene.organs().end(),
        [](const Organ& organ) { return organ.least_cosine > 0; });
    for (std::size_t i = 0; any_narrow && i < scene.regions().size(); ++i) {
        const OrganIndex organ = scene.regions()[i].organ;
        least_cosine_.push_back(scene.organs()[organ.value].least_cosine);
    }
}

}  // namespace quasimc
