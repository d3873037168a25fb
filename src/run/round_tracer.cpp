#include "run/round_tracer.h"

#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "base/memory_need.h"
#include "solvers/catalogue.h"

namespace quasimc {
namespace {

/// Sums of no paths yet.
Sums make_sums(const PreparedScene& prepared, const RunSpec& spec) {
    const auto regions = static_cast<double>(prepared.scene().regions().size());
    const auto bins = static_cast<double>(2 * (prepared.spectra().size() + prepared.bands()) + 1);
    return make_big(
        fmt::format(
            "the sums of {} regions, {} bands, {} spectra and {} replicates",
            prepared.scene().regions().size(), prepared.bands(), prepared.spectra().size(),
            spec.replicates),
        regions * bins * spec.replicates * sizeof(std::int64_t),
        [&] { return empty_sums(prepared, spec); });
}

}  // namespace

void RoundTracer::trace(const Round& round) {
    if (round.first == 0) {
        spec_.paths = round.count;
        solver_ = make_solver({prepared_, sampler_, spec_, executor_.stop()});
    }
    Sums sums = round.first == 0  ? make_sums(prepared_, spec_)
                : may_be_stopped_ ? *done_
                                  : std::move(*done_);
    solver_->solve(round, executor_, sums);
    done_ = std::move(sums);
}

}  // namespace quasimc
