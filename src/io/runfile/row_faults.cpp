#include "io/runfile/row_faults.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace quasimc {

void RowFaults::add(std::uint32_t line, std::string_view problem, std::string_view why) {
    const auto known = std::find_if(
        kinds_.begin(), kinds_.end(), [&](const Kind& kind) { return kind.problem == problem; });
    if (known != kinds_.end()) {
        ++known->more;
    } else {
        kinds_.push_back({problem, why, line});
    }
}

void RowFaults::report(Reporter& reporter) const {
    for (const Kind& kind : kinds_) {
        reporter.fault(
            kind.first, std::string(kind.problem), std::string(kind.why),
            kind.more > 0 ? fmt::format("{} more rows have this fault", kind.more) : "");
    }
}

}  // namespace quasimc
