#include "coupling/protocol/trailing_values.h"

#include <algorithm>

namespace quasimc {

void TrailingValues::remove(Pass& pass, NumberStyle style) {
    constexpr std::uint32_t kSurplus = 2;
    if (style != NumberStyle::fixed) {
        return;
    }
    is_mended_ = is_mended_ || std::any_of(
                                   pass.queries.begin(), pass.queries.end(),
                                   [](const Query& q) { return q.parameters.count == kSurplus; });
    if (is_mended_) {
        return;
    }
    for (Query& query : pass.queries) {
        query.parameters.count -= std::min(query.parameters.count, kSurplus);
    }
}

}  // namespace quasimc
